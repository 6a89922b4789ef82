// A run with two contacts in Chromium: a cross-section, a gap and plots of each.
import {after, before, test} from 'node:test';
import {assert, bring, launch, open, rotorub, seek, series, state, top} from './support.js';

let browser, page, rows;
before(async () => {
  rotorub(['run', `${top}/tests/compare/engine/two_catchers.toml`, '--quiet', '-o', 'two']);
  rotorub(['plot', 'two', '--quiet']);
  rows = series('two/series.csv');
  browser = await launch();
  page = await open(browser, 'two/plot.html');
});
after(() => browser?.close());

test('each contact has its picture, its gap and its readings, as its columns say', async () => {
  assert.equal(await page.locator('canvas.section').count(), 2);
  assert.equal(await page.locator('canvas.unrolled').count(), 2);
  assert.deepEqual(await page.locator('.contact-head').evaluateAll((all) => all.map((e) => e.firstChild.textContent.trim())),
    ['contact drive end', 'contact free end']);
  for (const row of [rows[160], rows[300], rows[1100]]) {
    await seek(page, Number(row.t));
    const shown = await state(page);
    const [other] = shown.others;
    assert.equal(other.name, 'free end');
    for (const [at, prefix, pose] of [[shown, '', shown.poses[0]], [other, 'contact2_', other.poses[0]]]) {
      const column = (name) => Number(row[prefix + name]);
      assert.ok(Math.abs(pose.gap - column('gap')) <= Math.max(31e-9, 0.0101 * Math.abs(column('gap'))), `${prefix}gap at ${row.t}`);
      assert.ok(Math.abs(pose.rotor[1] - column('rotor_y')) < 4e-6, `${prefix}rotor_y at ${row.t}`);
      assert.ok(Math.abs(pose.ring[1] - column('stator_y')) < 1.001e-6, `${prefix}stator_y at ${row.t}`);
      assert.equal(pose.mode, row[`${prefix}mode`]);
      assert.equal(at.sections[0].touching, pose.mode !== 'free');
      assert.ok(Math.abs(at.unrolled.points[0].gap - pose.gap) < 1e-15);
    }
    const heads = await page.locator('.contact-head .mode').allTextContents();
    assert.deepEqual(heads, [row.mode, row.contact2_mode]);
  }
  assert.notDeepEqual(rows.map((row) => row.mode), rows.map((row) => row.contact2_mode));
});

test('the two pictures show different places, and the speed of the shaft stands once', async () => {
  await seek(page, 0.005);
  const pictures = await page.evaluate(() => [...document.querySelectorAll('canvas.section')].map((c) => c.toDataURL()));
  assert.notEqual(pictures[0], pictures[1]);
  assert.equal(await page.locator('.readings dt', {hasText: /^spin$/}).count(), 1);
});

test('hard impacts of both are stopped at', async () => {
  const {hard} = await state(page);
  const first = (contact) => page.evaluate((k) => page.players[0].shown[0].contacts[k].impacts[0].t, contact);
  for (const contact of [0, 1]) {
    const t = await first(contact);
    assert.ok(hard.some((h) => Math.abs(h - t) < 1e-6), `the first of contact ${contact + 1} at ${t}`);
  }
});

test('plots of each contact stand side by side under its name and show its columns', async () => {
  const gaps = page.locator('.plot[data-plot="gap"]');
  assert.equal(await gaps.count(), 2);
  for (const [k, name, column] of [[0, 'drive end', 'gap'], [1, 'free end', 'contact2_gap']]) {
    assert.match(await gaps.nth(k).locator('xpath=..').textContent(), new RegExp(`Gap, contact ${name}`));
    await gaps.nth(k).evaluate((p) => p.scrollIntoView({block: 'center', behavior: 'instant'}));
    await page.waitForFunction((i) => document.querySelectorAll('.plot[data-plot="gap"]')[i].classList.contains('drawn'), k);
    const last = await gaps.nth(k).evaluate((p) => p.data[0].y.reduce((most, y) => Math.max(most, y), 0));
    const most = 1e6 * Math.max(...rows.map((row) => Number(row[column])));
    assert.ok(Math.abs(last - most) < 0.02 * most, `${last} is not ${most}`);
  }
  assert.equal(await page.locator('.plot[data-plot="spectrum"]').count(), 1);
  assert.equal(await page.locator('.plot[data-plot="impacts"]').count(), 2);
});

test('fits a phone, and says nothing', async () => {
  await bring(page, '.player');
  assert.deepEqual(page.said, []);
  const phone = await open(browser, 'two/plot.html', {width: 400, height: 800});
  assert.ok(await phone.evaluate(() => document.scrollingElement.scrollWidth) <= 400);
  await phone.close();
});
