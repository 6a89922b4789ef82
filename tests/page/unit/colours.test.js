// One meaning, one colour: forces have in the player the colours that they have in films.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import {test} from 'node:test';

const read = (file) => fs.readFileSync(new URL(`../../../${file}`, import.meta.url), 'utf8');

test('forces have the colours of the films', () => {
  const films = read('renders/palette.h'), page = read('compare/report/page/player.css');
  for (const [film, name] of [['kNormal', '--normal-force'], ['kFriction', '--friction-force'], ['kControl', '--control']]) {
    const [, ...filmed] = films.match(new RegExp(`Color ${film}\\{([\\d.]+)F, ([\\d.]+)F, ([\\d.]+)F\\}`));
    const [, hex] = page.match(new RegExp(`${name}: #([0-9a-f]{6})`));
    const shown = [0, 2, 4].map((at) => Number.parseInt(hex.slice(at, at + 2), 16) / 255);
    shown.forEach((value, k) => {
      assert.ok(Math.abs(value - Number(filmed[k])) < 0.04, `${name}: ${shown} beside ${filmed}`);
    });
  }
});
