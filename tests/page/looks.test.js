// How the page of a run looks: light and dark, without WebGL, and where the scene lacks parts.
import fs from 'node:fs';
import path from 'node:path';
import {after, before, test} from 'node:test';
import {assert, bring, eventually, folder, launch, nightly, open, rotorub, scene, seek, state} from './support.js';

let browser;
before(async () => {
  rotorub(['run', scene('bench_ring'), '--end', '0.05', '--quiet', '-o', 'ring']);
  rotorub(['run', scene('bench_billiard'), '--quiet', '-o', 'billiard']);
  fs.writeFileSync(path.join(folder, 'free.toml'), '[run]\nend = 0.05\n[rotor]\nspeed = "50 Hz"\n[rotor.modal]\n' +
    'mass = [2.0]\nstiffness = [2e5]\ndamping = [40.0]\ninertia = 1e-3\n[initial]\nx = [1e-4]\n');
  rotorub(['run', 'free.toml', '--quiet', '-o', 'free']);
  for (const run of ['ring', 'billiard', 'free']) rotorub(['plot', run, '--quiet']);
  browser = await launch();
});
after(() => browser?.close());

// How many colours a canvas shows, and its share of pixels that are not transparent.
const colours = (page, selector) => page.evaluate((s) => {
  const canvas = document.querySelector(s), {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
  const seen = new Set();
  let solid = 0;
  for (let k = 0; k < data.length; k += 4) {
    if (data[k + 3] === 0) continue;
    ++solid;
    seen.add((data[k] << 16) + (data[k + 1] << 8) + data[k + 2]);
  }
  return {count: seen.size, share: solid / (canvas.width * canvas.height)};
}, selector);

test('the rig is drawn in WebGL, and moves', async () => {
  const page = await open(browser, 'ring/plot.html');
  const {count, share} = await colours(page, 'canvas.rig');
  assert.ok(count > 200, `${count} colours`);
  assert.ok(share > 0.03 && share < 0.7, `${share} of the canvas`);
  const look = () => page.evaluate(() => document.querySelector('canvas.rig').toDataURL());
  await seek(page, 0.01);
  const before = await look();
  await seek(page, 0.014);
  assert.notEqual(await look(), before);
  await seek(page, 0.01);
  assert.equal(await look(), before, 'the same time is the same picture');
  await bring(page, 'canvas.rig');
  const box = await page.locator('canvas.rig').boundingBox();
  await page.mouse.move(box.x + 100, box.y + 100);
  await page.mouse.down();
  await page.mouse.move(box.x + 180, box.y + 100, {steps: 4});
  await page.mouse.up();
  assert.notEqual(await look(), before, 'a drag turns it');
  assert.deepEqual(page.said, []);
  await page.close();
});

test('answers in a sentence and cards, of which every figure stands in the summary', async () => {
  const page = await open(browser, 'ring/plot.html', {folded: true}), summary = JSON.parse(fs.readFileSync(path.join(folder, 'ring/summary.json')));
  assert.match(await page.locator('.sentence').textContent(), /^Does the rotor rub\? Yes, from 4\.060 ms: \d+ hard impacts, .+; mean normal force [\d.]+ N\.$/);
  const cards = await page.locator('.card').evaluateAll((all) => all.map((one) => [...one.children].map((e) => e.textContent)));
  assert.deepEqual(cards.map(([title]) => title), ['First touch', 'Mean normal force', 'Largest impact', 'Settles to', 'Margin to a critical speed']);
  assert.deepEqual([cards[0][1], cards[3][1]], ['4.06 ms', summary.settled.attractor]);
  assert.ok(Math.abs(Number.parseFloat(cards[1][1]) / summary.mean_force - 1) < 5e-3, cards[1][1]);
  assert.ok(await page.evaluate(() => document.querySelector('.cards').getBoundingClientRect().bottom < 500), 'on the first screen');
  const figures = await page.locator('#run-figures tbody tr').evaluateAll((rows) => Object.fromEntries(rows.map((row) => [row.cells[0].textContent, Number(row.cells[1].textContent)])));
  assert.ok(Math.abs(figures.impulse_total / summary.impulse_total - 1) < 1e-3);
  await page.close();
});

test('units change in cards, tables, readings and plots, and stay in the address', async () => {
  const kInch = 0.0254, kPound = 4.4482216152605;
  const looks = (page) => page.evaluate(() => {
    const plot = document.querySelector('.plot[data-plot="rotor_x"]'), [trace] = plot.data;
    return {card: document.querySelectorAll('.card-verdict')[1].textContent, most: Math.max(...trace.y), unit: plot.closest('figure').querySelector('.unit').textContent,
      impulse: [...document.querySelectorAll('#run-figures tr')].map((r) => [...r.cells].map((c) => c.textContent)).find(([name]) => name === 'impulse_total'),
      rotor: [...document.querySelectorAll('.readings div')].map((e) => e.textContent).find((words) => words.startsWith('rotor x'))};
  });
  const page = await open(browser, 'ring/plot.html');
  await bring(page, '.plot[data-plot="rotor_x"]');
  await page.waitForFunction(() => document.querySelector('.plot[data-plot="rotor_x"].drawn'));
  const si = await looks(page);
  await page.locator('#units').selectOption('mil');
  await eventually(async () => assert.equal((await looks(page)).unit, 'mil'));
  const mil = await looks(page);
  assert.ok(Math.abs(mil.most * 1e-3 * kInch / (si.most * 1e-6) - 1) < 1e-9);
  assert.ok(Math.abs(Number.parseFloat(mil.card) * kPound / Number.parseFloat(si.card) - 1) < 0.01, `${si.card} is ${mil.card}`);
  assert.match(mil.card, / lbf$/);
  assert.ok(Math.abs(Number(mil.impulse[1]) * kPound / Number(si.impulse[1]) - 1) < 1e-3);
  assert.deepEqual([si.impulse[2], mil.impulse[2]], ['N s', 'lbf s']);
  assert.match(mil.rotor, / mil, .+ mil$/);
  assert.match(page.url(), /\?units=mil/);
  await page.reload();
  await page.waitForFunction(() => document.querySelector('.plot .main-svg'));
  assert.equal((await looks(page).catch(() => ({}))).card ?? await page.locator('.card-verdict').nth(1).textContent(), mil.card);
  await page.locator('#units').selectOption('si');
  assert.equal(await page.locator('.card-verdict').nth(1).textContent(), si.card);
  assert.ok(!page.url().includes('units'));
  assert.deepEqual(page.said, []);
  await page.close();
});

test('the pointer over a plot marks its instant in the other plots and in the player', async () => {
  const page = await open(browser, 'ring/plot.html');
  await bring(page, '.plot[data-plot="gap"]');
  await page.waitForFunction(() => ['gap', 'gap_rate'].every((key) => document.querySelector(`.plot[data-plot="${key}"].drawn`)));
  const before = (await state(page)).time, drag = await page.locator('.plot[data-plot="gap"] .nsewdrag').first().boundingBox();
  await page.mouse.move(drag.x + 0.7 * drag.width, drag.y + 50);
  const looked = () => page.evaluate(() => {
    const plot = document.querySelector('.plot[data-plot="gap_rate"]'), line = plot.querySelector('.looked'), area = plot.querySelector('.nsewdrag').getBoundingClientRect();
    return line.hidden || !line.style.transform ? null : 0.05 * (line.getBoundingClientRect().left - area.left) / area.width;
  });
  await eventually(async () => assert.ok(Math.abs(await looked() - 0.035) < 0.0005));
  assert.ok(Math.abs(Number.parseFloat(await page.locator('.transport .time').textContent()) - 0.035) < 0.0005);
  assert.equal((await state(page)).time, before, 'the clock stays');
  await page.mouse.move(5, 5);
  await eventually(async () => assert.equal(await looked(), null));
  assert.equal(await page.locator('.transport .time').textContent(), `${before.toFixed(6)} s`);
  assert.deepEqual(page.said, []);
  await page.close();
});

test('without WebGL section and gap are there, and a word', nightly, async () => {
  const plain = await launch({webgl: false});
  const page = await open(plain, 'ring/plot.html');
  assert.equal((await state(page)).webgl, false);
  assert.match(await page.locator('.player-note').textContent(), /no WebGL/);
  assert.equal(await page.locator('canvas.rig').count(), 0);
  for (const part of ['canvas.section', 'canvas.unrolled']) assert.ok((await colours(page, part)).count > 5, part);
  await seek(page, 0.03);
  const s = await state(page);
  assert.deepEqual([s.sections[0].t, s.unrolled.t], [0.03, 0.03]);
  assert.deepEqual(page.said, []);
  await plain.close();
});

test('light and dark have colours of their own', nightly, async () => {
  const looks = [];
  for (const colorScheme of ['light', 'dark']) {
    const page = await open(browser, 'ring/plot.html', {colorScheme});
    looks.push(await page.evaluate(() => [getComputedStyle(document.body).backgroundColor,
      document.querySelector('canvas.section').toDataURL(), document.querySelector('canvas.rig').toDataURL()]));
    if (colorScheme === 'dark') {
      await page.locator('#theme').click();
      assert.equal(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), looks[0][0]);
      assert.equal(await page.evaluate(() => document.querySelector('canvas.section').toDataURL()), looks[0][1]);
    }
    await page.close();
  }
  for (const [k, light] of looks[0].entries()) assert.notEqual(light, looks[1][k]);
});

test('shows of a run what its scene has', async () => {
  const billiard = await open(browser, 'billiard/plot.html');
  assert.equal(await billiard.locator('.player-run').count(), 1);
  assert.equal(await billiard.evaluate('page.players[0].runs[0].has("ring")'), false);
  const parts = await billiard.evaluate('(({rig: {bearings, motor, discs}, contacts: [{actuators}]}) => ({bearings, motor, actuators, discs}))(page.data.scenes[0])');
  assert.deepEqual(parts, {bearings: [], motor: null, actuators: false, discs: []});
  const names = await billiard.locator('.readings dt').allTextContents();
  assert.ok(names.includes('gap') && !names.some((n) => /control|current|ring’s/.test(n)), names.join());
  assert.deepEqual(billiard.said, []);
  await billiard.close();
  const free = await open(browser, 'free/plot.html');
  assert.equal(await free.locator('canvas.section, canvas.unrolled').count(), 0);
  await seek(free, 0.02);
  assert.equal((await state(free)).rigs[0].t, 0.02);
  assert.equal((await state(free)).poses[0].gap, null);
  assert.deepEqual(free.said, []);
  await free.close();
});
