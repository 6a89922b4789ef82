// How the page of a run looks: light and dark, without WebGL, and where the scene lacks parts.
import fs from 'node:fs';
import path from 'node:path';
import {after, before, test} from 'node:test';
import {assert, bring, folder, launch, nightly, open, rotorub, scene, seek, state} from './support.js';

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
