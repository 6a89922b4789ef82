// "What if" in Chromium: a slider moved, the run computed again in the page, beside what the program gives for it.
import fs from 'node:fs';
import path from 'node:path';
import {after, before, test} from 'node:test';
import {assert, folder, launch, open, rotorub, scene, seek, series, state} from './support.js';

let browser, page;
before(async () => {
  rotorub(['run', scene('bench_ring'), '--quiet', '-o', 'ring']);
  rotorub(['plot', 'ring', '--quiet']);
  browser = await launch();
  page = await open(browser, 'ring/plot.html');
});
after(() => browser?.close());

const slider = (on, key, k = 0) => on.locator('.scene').nth(k).locator('.sliders label', {hasText: key});
// Moves it as a reader does, by keys, and waits for the run; what it then says, as --set takes it.
async function move(on, key, presses, k = 0) {
  const place = on.locator('.scene').nth(k).locator('.what-if'), before = await place.getAttribute('data-computed');
  await slider(on, key, k).locator('input').focus();
  for (let n = 0; n < presses; ++n) await on.keyboard.press('ArrowRight');
  await on.waitForFunction(([at, old]) => document.querySelectorAll('.scene')[at].querySelector('.what-if').dataset.computed > (old || 0), [k, before]);
  assert.match(await place.locator('.told').textContent(), /^Computed in [\d.]+ s\. By the program: rotorub run/);
  return `${key}=${(await slider(on, key, k).locator('output').textContent()).trim()}`;
}

test('sliders stand at the values of the scene, in units as people read them, within the schema', async () => {
  const of = (key) => slider(page, key).evaluate((label) => {
    const {min, max, value} = label.querySelector('input');
    return [min, max, value].map(Number).concat(label.querySelector('output').textContent.trim());
  });
  const [ring] = JSON.parse(rotorub(['schema'])) ? [fs.readFileSync(scene('bench_ring'), 'utf8')] : [];
  const friction = Number(ring.match(/^friction = ([\d.]+)/m)[1]);
  assert.deepEqual(await of('contact.friction'), [0, 2 * friction, friction, `${friction}`]);
  assert.deepEqual((await of('contact.restitution')).slice(0, 2), [0, 1]);
  assert.match((await of('contact.clearance'))[3], / mm$/);
  assert.match((await of('rotor.speed'))[3], / rpm$/);
});

test('a slider moved: the run is computed here, as the program gives it, in player and plots', async () => {
  const said = await move(page, 'contact.friction', 40);
  rotorub(['run', scene('bench_ring'), '--set', said, '--quiet', '-o', 'changed']);
  const rows = series('changed/series.csv'), impacts = series('changed/impacts.csv');
  const before = series('ring/series.csv');
  for (const k of [200, 500, rows.length - 1]) {
    await seek(page, Number(rows[k].t));
    const shown = await state(page), [native, again] = shown.poses;
    assert.deepEqual(shown.runs, ['native', 'recomputed']);
    const near = (gap, row) => Math.abs(gap - Number(row.gap)) <= Math.max(31e-9, 0.0101 * Math.abs(Number(row.gap)));
    assert.ok(near(native.gap, before[k]), `native at ${rows[k].t}: ${native.gap}`);
    assert.ok(near(again.gap, rows[k]), `recomputed at ${rows[k].t}: ${again.gap} for ${rows[k].gap}`);
  }
  assert.notDeepEqual(rows.map((row) => row.gap), before.map((row) => row.gap), 'it is another run');
  const counted = impacts.filter((row) => Number(row.gap_rate_before) < -1e-4);
  assert.equal(await page.evaluate(() => page.players[0].runs[1].impacts.length), counted.length);
  for (const plot of ['gap', 'normal_force', 'spectrum', 'impacts']) {
    const names = await page.evaluate(async (key) => {
      const place = document.querySelector(`.plot[data-plot="${key}"]`);
      place.scrollIntoView({block: 'center', behavior: 'instant'});
      for (let n = 0; n < 100 && !place._fullData; ++n) await new Promise((go) => { setTimeout(go, 50); });
      return place._fullData.map((trace) => trace.name);
    }, plot);
    assert.ok(names.includes('native') && names.includes('recomputed'), `${plot}: ${names}`);
  }
  const marked = page.locator('.legend-item[data-side="recomputed"]');
  assert.equal((await marked.textContent()).trim(), 'native, recomputed here');
  assert.ok((await page.locator('.player-run select').nth(1).textContent()).includes('native, recomputed here'));
});

test('another clearance is drawn as such, beside the scene’s', async () => {
  await move(page, 'contact.clearance', 30);
  const [native, again] = await page.evaluate(() => page.players[0].runs.map((run) => run.clearance));
  assert.ok(again > 1.1 * native, `${again} beside ${native}`);
  const circles = await page.evaluate(async () => {
    const place = document.querySelector('.plot[data-plot="relative"]');
    place.scrollIntoView({block: 'center', behavior: 'instant'});
    // Drawn before, it is drawn again once it is in sight.
    for (let n = 0; n < 100 && !(place.layout?.shapes.length > 1); ++n) await new Promise((go) => { setTimeout(go, 50); });
    return place.layout.shapes.map((shape) => 1e-6 * shape.x1);
  });
  assert.deepEqual(circles.map((r) => r.toPrecision(6)), [native, again].map((r) => r.toPrecision(6)));
});

test('put back, it is the run of the scene', async () => {
  await page.locator('.put-back').click();
  await page.waitForFunction(() => /^Computed/.test(document.querySelector('.told').textContent));
  const rows = series('ring/series.csv'), row = rows[rows.length - 1];
  await seek(page, Number(row.t));
  const [native, again] = (await state(page)).poses;
  assert.equal(again.gap, native.gap, 'the same tracks, packed by the same code');
  assert.deepEqual(page.said, []);
});

test('in a comparison every scene has its own', async () => {
  rotorub(['compare', scene('bench_ring'), scene('paper_sliding'), '--end', '0.12', '--twins', '0', '--no-modes-ladder', '--no-video',
    '--quiet', '-o', 'both'], [0, 1]);
  const both = await open(browser, 'both/report.html');
  assert.equal(await both.locator('.what-if').count(), 2);
  await move(both, 'controller.preload', 30, 1);
  assert.ok(!(await state(both, 0)).runs.includes('recomputed'));
  assert.deepEqual((await state(both, 1)).runs, ['native', 'recomputed']);
  assert.deepEqual(both.said, []);
});

test('a program without the module writes pages without sliders, and says nothing of it', async () => {
  fs.mkdirSync(path.join(folder, 'alone/bin'), {recursive: true});
  fs.copyFileSync(process.env.ROTORUB_BINARY || path.join(path.dirname(scene('')), '../build/bin/rotorub'), path.join(folder, 'alone/bin/rotorub'));
  fs.chmodSync(path.join(folder, 'alone/bin/rotorub'), 0o755);
  const {execFileSync} = await import('node:child_process');
  execFileSync(path.join(folder, 'alone/bin/rotorub'), ['plot', 'ring', '--quiet', '-o', 'plain.html'], {cwd: folder});
  const plain = await open(browser, 'plain.html');
  assert.equal(await plain.locator('.what-if, #native-module').count(), 0);
  assert.deepEqual(plain.said, []);
});

test('the report of the two scenes of the paper holds the module in less than 6 MB', async () => {
  rotorub(['compare', scene('paper_sliding'), scene('paper_passive'), '--quiet', '-o', 'paper'], [0, 1]);
  const {size} = fs.statSync(path.join(folder, 'paper/report.html'));
  assert.ok(size < 6e6, `${size} bytes`);
  const report = await open(browser, 'paper/report.html');
  assert.equal(await report.locator('.scene .sliders').count(), 2);
  assert.deepEqual(report.said, []);
  await report.close();
});
