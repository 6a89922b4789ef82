// A measured run in the report: its section, its line in the plots, its place in the player.
import {after, before, test} from 'node:test';
import fs from 'node:fs';
import path from 'node:path';
import {assert, bring, eventually, folder, launch, nightly, open, rotorub, scene, seek, series, state} from './support.js';

const kShift = 0.125;      // s, added to the scene's times
const kHole = [0.02, 0.03];  // s, of the scene: nothing is recorded
let browser, page, rows;

// Of a run's series a record: another clock, a hole, and the columns asked for.
function record(file, columns) {
  const lines = rows.filter((row) => row.t > 0.002).map((row) => {
    const open = row.t > kHole[0] && row.t < kHole[1];
    return [1e3 * (Number(row.t) + kShift), ...columns.map(([, name, factor]) => (open ? '' : factor * row[name]))].join(',');
  });
  fs.writeFileSync(path.join(folder, file), `${[`t [ms],${columns.map(([head]) => head).join(',')}`, ...lines].join('\n')}\n`);
}

before(async () => {
  rotorub(['run', scene('bench_ring'), '--integrator', 'event', '--end', '0.06', '--set', 'run.output_step=50us', '-o', 'rig', '-q']);
  rows = series('rig/series.csv');
  const rotor = [['rotor_x [um]', 'rotor_x', 1e6], ['rotor_y [um]', 'rotor_y', 1e6]];
  record('whole.csv', [...rotor, ['ring_x [um]', 'stator_x', 1e6], ['ring_y [um]', 'stator_y', 1e6], ['gap [um]', 'gap', 1e6],
    ['force [N]', 'normal_force', 1]]);
  record('rotor.csv', rotor);
  record('gap.csv', [['gap [um]', 'gap', 1e6]]);
  for (const name of nightly.skip ? ['whole'] : ['whole', 'rotor', 'gap']) {
    rotorub(['compare', scene('bench_ring'), '--end', '0.06', '--twins', '0', '--no-modes-ladder', '--no-video', '--quiet',
      '--measured', `${name}.csv`, '-o', name], [0, 1]);
  }
  browser = await launch();
  page = await open(browser, 'whole/report.html');
});
after(() => browser?.close());

const trace = (p, key, name) => p.evaluate(([k, n]) => {
  const plot = document.querySelector(`.plot[data-plot="${k}"]`);
  const found = plot.data.find((t) => t.name === n);
  return found && {x: Array.from(found.x), y: Array.from(found.y)};
}, [key, name]);
async function drawn(p, key) {
  await bring(p, `.plot[data-plot="${key}"]`);
  await p.waitForFunction((k) => document.querySelector(`.plot[data-plot="${k}"]`).classList.contains('drawn'), key);
}
async function choose(p, label) {
  const place = p.locator('.player-run').nth(1);
  await place.locator('select').selectOption({label});
  return place;
}

test('has figures and residuals of every run, and a place in the contents', async () => {
  const section = page.locator('#scene-1-measured');
  assert.equal(await section.count(), 1);
  assert.match(await section.textContent(), /shift -125\.0000\d\d ms/);
  const heads = await section.locator('table').first().locator('th').allTextContents();
  for (const label of ['measured', 'native', 'rigid', 'coulomb', 'cone']) assert.ok(heads.includes(label), label);
  const rotorX = section.locator('table').nth(1).locator('tr', {hasText: 'rotor_x'});
  const runs = 6;
  assert.equal(await rotorX.locator('td').count(), 4 + runs);
  assert.equal(await page.locator('a[href="#scene-1-measured"]').count(), 1);
});

test('lies on the native run in every plot that it has data for, and is open where nothing was recorded', async () => {
  for (const key of ['gap', 'rotor_x', 'sample_force', 'orbit', 'relative', 'spectrum', 'residual']) {
    await drawn(page, key);
    assert.ok(await trace(page, key, 'measured'), key);
  }
  for (const key of ['gap_rate', 'spin']) {
    await drawn(page, key);
    assert.ok(!await trace(page, key, 'measured'), `${key} is not measured`);
  }
  const line = await trace(page, 'rotor_x', 'measured');
  let compared = 0;
  line.x.forEach((t, k) => {
    assert.ok(line.y[k] === null || !(t > kHole[0] + 1e-4 && t < kHole[1] - 1e-4), `a value in the hole, at ${t}`);
    const row = rows.find((r) => Math.abs(r.t - t) < 2e-6);
    if (line.y[k] === null || !row) return;
    // Places in a page are held to 1 um.
    assert.ok(Math.abs(line.y[k] - 1e6 * row.rotor_x) < 1.1, `${t}: ${line.y[k]} is not ${1e6 * row.rotor_x}`);
    ++compared;
  });
  assert.ok(compared > 20, `${compared} compared`);
  assert.ok(line.y.some((y) => y === null), 'the hole is open');
});

test('is a run of the player, with what its record has', async () => {
  await page.evaluate(() => window.scrollTo(0, 0));
  const place = await choose(page, 'measured');
  const row = rows.find((r) => Math.abs(r.t - 0.04) < 1e-6);
  await bring(page, '.player');
  await seek(page, 0.04);
  const s = await eventually(async () => {
    const now = await state(page);
    assert.equal(now.sections[1].rotor, true);
    return now;
  });
  assert.deepEqual(s.runs, ['native', 'measured']);
  const pose = s.poses[1];
  for (const [k, name] of ['rotor_x', 'rotor_y'].entries()) assert.ok(Math.abs(pose.rotor[k] - row[name]) < 1.1e-6, name);
  assert.equal(pose.spin, null);
  assert.equal(pose.mode, null);
  assert.ok(pose.force > 0);
  assert.equal(s.sections[1].rotor, true);
  assert.equal(s.sections[1].ring, true);
  assert.deepEqual(s.sections[1].arrows, [], 'no direction of a force is measured');
  assert.equal(s.rigs[1].stations, 0, 'no shaft is made up');
  const words = await place.locator('.readings').textContent();
  assert.match(words, /force, a sample/);
  assert.doesNotMatch(words, /spin|gap rate/);
  assert.match(await page.locator('.player-note').first().textContent(), /not measured, and not drawn: the shaft’s shape|not measured, and not drawn: the shaft's shape/);
});

test('shows nothing where nothing was recorded', async () => {
  const place = page.locator('.player-run').nth(1);
  for (const t of [0.025, 0.001]) {
    await seek(page, t);
    await eventually(async () => assert.equal(await place.locator('.mode').textContent(), 'no samples here'));
    assert.equal(await place.locator('.readings div').count(), 0);
    assert.ok(!(await state(page)).sections[1].rotor);
  }
});

test('without ring and gap draws neither', nightly, async () => {
  const other = await open(browser, 'rotor/report.html');
  await choose(other, 'measured');
  await bring(other, '.player');
  await seek(other, 0.04);
  const s = await state(other);
  assert.equal(s.sections[1].rotor, true);
  assert.equal(s.sections[1].ring, false);
  assert.equal(s.poses[1].gap, null);
  assert.deepEqual(s.unrolled.points.map((p) => p.run), ['native']);
  assert.match(await other.locator('.player-note').first().textContent(), /ring, gap/);
  await drawn(other, 'relative');
  assert.ok(!await trace(other, 'relative', 'measured'));
  await drawn(other, 'orbit');
  assert.deepEqual(other.said, []);
  await other.close();
});

test('without a rotor is in the plots alone, and says so', nightly, async () => {
  const other = await open(browser, 'gap/report.html');
  const labels = await other.locator('.player-run').first().locator('option').allTextContents();
  assert.ok(!labels.includes('measured'), labels.join());
  assert.match(await other.locator('.player-note').first().textContent(), /no rotor_x with its rotor_y/);
  await drawn(other, 'gap');
  assert.ok(await trace(other, 'gap', 'measured'));
  assert.deepEqual(other.said, []);
  await other.close();
});

test('can be put away, and is silent', async () => {
  await page.evaluate(() => document.querySelector('.legend-item[data-side="measured"]').click());
  await drawn(page, 'gap');
  const visible = () => page.evaluate(() => document.querySelector('.plot[data-plot="gap"]').data.find((t) => t.name === 'measured').visible);
  await eventually(async () => assert.equal(await visible(), 'legendonly'));
  assert.deepEqual(page.said, []);
});
