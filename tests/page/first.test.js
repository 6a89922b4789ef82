// The first screen of a report, on a wide screen, a small one, on paper and by keyboard.
import {after, before, test} from 'node:test';
import {assert, launch, open, rotorub, scene, state} from './support.js';

let browser;
before(async () => {
  rotorub(['compare', scene('bench_ring'), '--end', '0.16', '--twins', '0', '--no-video', '--quiet', '-o', '.'], [0, 1]);
  browser = await launch();
});
after(() => browser?.close());

test('answers in a sentence, MuJoCo alone first', async () => {
  const page = await open(browser, 'report.html');
  const sentence = (await page.locator('.sentence').first().textContent()).replace(/\s+/g, ' ');
  assert.match(sentence, /^MuJoCo alone: (no|averages only) \(.+\); with the corrected cone: .+; with the rigid law: yes\.$/);
  const rows = await page.locator('.answer tbody th').allTextContents();
  assert.match(rows[0], /^MuJoCo alone/);
  assert.match(rows[rows.length - 1], /rigid$/);
  // Sentence and picture are on the first screen.
  await page.waitForFunction(() => document.querySelector('.first .plot.drawn'));
  const bottom = await page.evaluate(() => document.querySelector('.first').getBoundingClientRect().bottom);
  assert.ok(bottom < 1000, `${bottom} px`);
  assert.deepEqual(page.said, []);
  await page.close();
});

test('the picture shows native and MuJoCo alone apart', async () => {
  const page = await open(browser, 'report.html');
  await page.waitForFunction(() => document.querySelector('.first .plot.drawn'));
  const apart = await page.evaluate(() => {
    const plot = document.querySelector('.first .plot');
    const gaps = plot.data.filter((trace) => trace.yaxis !== 'y2');
    const at = (trace, t) => trace.y[trace.x.findIndex((x) => x >= t)];
    const [from, to] = plot._fullLayout.xaxis.range;
    const all = Array.from({length: 200}, (_, k) => from + (to - from) * (k + 1) / 202);
    return {names: gaps.map((trace) => trace.name).sort(), most: Math.max(...all.map((t) => Math.abs(at(gaps[0], t) - at(gaps[1], t)))),
      impulses: plot.data.filter((trace) => trace.yaxis === 'y2').map((trace) => ({name: trace.name, mode: trace.mode,
        largest: Math.max(...trace.y.filter((y) => y !== null))})),
    };
  });
  assert.deepEqual(apart.names, ['cone', 'native']);
  // Impacts of both in one style, each with the impulse that it has.
  assert.deepEqual(apart.impulses.map(({name}) => name), ['native', 'cone']);
  for (const {name, mode, largest} of apart.impulses) {
    assert.equal(mode, 'lines+markers');
    assert.ok(largest > 0, name);
  }
  assert.ok(apart.most > 5, `${apart.most} um, a hundredth of the clearance`);
  assert.deepEqual((await state(page)).runs, ['native', 'cone']);
  await page.close();
});

test('a small screen has cards, folded parts, and a short page', async () => {
  const page = await open(browser, 'report.html', {width: 390, height: 844});
  const looks = await page.evaluate(() => ({height: document.documentElement.scrollHeight, width: document.documentElement.scrollWidth,
    open: document.querySelectorAll('details.later[open]').length, card: getComputedStyle(document.querySelector('.answer tbody tr')).display}));
  assert.ok(looks.height < 12200, `${looks.height} px`); // with the solrefs of the soft contacts
  assert.ok(looks.width <= 390);
  assert.equal(looks.open, 0);
  assert.equal(looks.card, 'block');
  await page.evaluate(() => { location.hash = 'scene-1-figures'; });
  await page.waitForFunction(() => document.getElementById('scene-1-figures').open);
  await page.close();
});

test('on paper: the answer, every table and every plot once, no player', async () => {
  const page = await open(browser, 'report.html');
  await page.emulateMedia({media: 'print'});
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  const shown = (selector) => page.evaluate((s) => [...document.querySelectorAll(s)].filter((e) => e.getBoundingClientRect().height > 0).length, selector);
  assert.equal(await shown('.player, .transport, .glossary'), 0);
  assert.equal(await shown('.plot.drawn'), await page.locator('.plot').count());
  const pdf = await page.pdf({format: 'A4'});
  const pages = (pdf.toString('latin1').match(/\/Type\s*\/Page\b/g) || []).length;
  assert.ok(pages <= 9, `${pages} pages`);
  await page.close();
});

test('plots, rig and tables are reached and used by keyboard', async () => {
  const page = await open(browser, 'report.html');
  const gap = page.locator('.plot[data-plot="gap"]');
  await gap.scrollIntoViewIfNeeded();
  await page.waitForFunction(() => document.querySelector('.plot[data-plot="gap"].drawn'));
  await gap.focus();
  assert.equal(await gap.getAttribute('aria-label'), 'plot: Gap');
  const {time, from, to} = await state(page);
  await page.keyboard.press('ArrowRight');
  assert.ok(Math.abs((await state(page)).time - time - 0.02 * (to - from)) < 1e-9);
  await page.keyboard.press('+');
  await page.waitForFunction((whole) => {
    const [a, b] = document.querySelector('.plot[data-plot="gap"]')._fullLayout.xaxis.range;
    return b - a < 0.6 * whole;
  }, to - from);
  assert.ok(await gap.evaluate((plot) => document.activeElement === plot), 'the plot keeps the focus');
  const rig = page.locator('canvas.rig').first();
  await rig.scrollIntoViewIfNeeded();
  await rig.focus();
  const look = () => rig.evaluate((canvas) => canvas.toDataURL());
  const still = await look(), at = (await state(page)).time;
  await page.keyboard.press('ArrowLeft');
  assert.notEqual(await look(), still);
  assert.equal((await state(page)).time, at, 'it turns, and time stands');
  await page.close();
});
