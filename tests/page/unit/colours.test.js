// One meaning, one colour: forces have in the player the colours that they have in films.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import {test} from 'node:test';
import {colourOfWord, colourScale} from '../../../compare/report/page/scales.js';

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

const states = ['no contact', 'synchronous rub', 'backward whip', 'rolling'];
const sets = Array.from({length: 15}, (_, k) => states.filter((_, bit) => (k + 1) & (1 << bit)).join(' + '));
const found = ['no contact', 'bouncing', 'resting', 'synchronous rub', 'forward rub', 'backward whip', 'rolling', 'unknown'];

test('a state has one colour in maps of runs and of eigenvalues, whatever else they hold', () => {
  const runs = ['bouncing', 'no contact', 'synchronous rub'], linear = ['no contact + rolling', 'none stable', 'synchronous rub'];
  const of = (column) => colourScale(column, column.map((_, k) => k)).of('synchronous rub');
  assert.deepEqual(of(runs), of(linear));
  assert.deepEqual(of(['synchronous rub']), of(linear));
});

test('no two states, nor two sets of them, look the same, nor like a run that failed', () => {
  const all = [...new Set([...found, ...sets, 'none stable'])].map((word) => [word, colourOfWord(word, [])]);
  const far = (a, b) => Math.hypot(...[1, 3, 5].map((at) => Number.parseInt(a.slice(at, at + 2), 16) - Number.parseInt(b.slice(at, at + 2), 16)));
  for (const [k, [word, colour]] of all.entries()) {
    for (const [other, beside] of all.slice(k + 1)) assert.ok(far(colour, beside) > 20, `${word} ${colour}, ${other} ${beside}`);
  }
});
