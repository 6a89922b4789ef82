// The first screen of a report, on a wide screen, a small one, on paper and by keyboard.
import {after, before, test} from 'node:test';
import {assert, eventually, launch, open, rotorub, scene, state} from './support.js';

let browser, page;
before(async () => {
  rotorub(['compare', scene('bench_ring'), '--end', '0.16', '--twins', '0', '--no-video', '--quiet', '-o', '.'], [0, 1]);
  browser = await launch();
  page = await open(browser, 'report.html');
});
after(() => browser?.close());

test('answers in a sentence, MuJoCo alone first', async () => {
  const sentence = (await page.locator('.sentence').first().textContent()).replace(/\s+/g, ' ');
  assert.match(sentence, /^MuJoCo alone: (no|averages only) \(.+\); with the corrected cone: .+; with the rigid law: yes\.$/);
  const rows = await page.locator('.answer tbody th').allTextContents();
  assert.match(rows[0], /^MuJoCo alone/);
  assert.match(rows[rows.length - 1], /\(rigid\)$/);
  // Sentence and picture are on the first screen.
  await page.waitForFunction(() => document.querySelector('.first .plot.drawn'));
  const bottom = await page.evaluate(() => document.querySelector('.first').getBoundingClientRect().bottom);
  assert.ok(bottom < 1000, `${bottom} px`);
});

test('the picture shows native and MuJoCo alone apart', async () => {
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
});

test('the pointer over the picture marks its instant there and in the plots and the player of the scene', async () => {
  await page.waitForFunction(() => document.querySelector('.first .plot .looked'));
  const area = await page.locator('.first .nsewdrag').first().boundingBox();
  await page.mouse.move(area.x + 0.5 * area.width, area.y + 20);
  const asked = await page.evaluate(() => { const [from, to] = document.querySelector('.first .plot')._fullLayout.xaxis.range; return 0.5 * (from + to); });
  const shown = () => page.evaluate(() => ({here: !document.querySelector('.first .looked').hidden, t: Number.parseFloat(document.querySelector('.transport .time').textContent)}));
  await eventually(async () => {
    const {here, t} = await shown();
    assert.ok(here && Math.abs(t - asked) < 5e-4, `${t} is not ${asked}`);
  });
  await page.mouse.move(2, 2);
  await eventually(async () => assert.equal((await shown()).here, false));
});

test('the verdicts have room at 1400 px', async () => {
  await page.setViewportSize({width: 1400, height: 1000});
  const wide = await page.evaluate(() => [...document.querySelectorAll('.answer')].map((e) => e.scrollWidth - e.clientWidth));
  assert.ok(wide.length > 0 && wide.every((over) => over <= 0), `${wide}`);
  await page.setViewportSize({width: 1200, height: 1000});
});

test('a wide page begins short: what decides nothing is folded, and a link or a button opens it', async () => {
  const wide = await open(browser, 'report.html', {width: 1280, folded: true});
  const looks = await wide.evaluate(() => ({height: document.documentElement.scrollHeight, open: document.querySelectorAll('.scene > details.later[open]').length,
    plots: [...document.querySelectorAll('.plots .plot')].filter((p) => p.offsetParent).length, all: document.querySelectorAll('.plots .plot').length}));
  assert.ok(looks.height < 6500, `${looks.height} px`);
  assert.deepEqual([looks.open, looks.plots], [0, 6]);
  await wide.evaluate(() => { location.hash = 'scene-1-figures'; });
  await wide.waitForFunction(() => document.getElementById('scene-1-figures').open);
  await wide.locator('.more-plots').click();
  assert.equal(await wide.evaluate(() => [...document.querySelectorAll('.plots .plot')].filter((p) => p.offsetParent).length), looks.all);
  await wide.close();
});

test('a small screen has cards, folded parts, and a short page on which nothing is cut off', async () => {
  const phone = await open(browser, 'report.html', {width: 390, height: 844, folded: true});
  const looks = await phone.evaluate(() => ({height: document.documentElement.scrollHeight, width: document.documentElement.scrollWidth,
    open: document.querySelectorAll('details.later[open]').length, card: getComputedStyle(document.querySelector('.answer tbody tr')).display}));
  assert.ok(looks.height < 12200, `${looks.height} px`); // with the solrefs of the soft contacts
  assert.ok(looks.width <= 390);
  assert.equal(looks.open, 0);
  assert.equal(looks.card, 'block');
  const wide = await phone.evaluate(() => [...document.querySelectorAll('.player canvas, .plot, .transport > *')].filter((e) => {
    const box = e.getBoundingClientRect();
    return box.width > 0 && (box.left < -0.5 || box.right > 390.5);
  }).map((e) => e.className));
  assert.deepEqual(wide, []);
  await phone.evaluate(() => { location.hash = 'scene-1-figures'; });
  await phone.waitForFunction(() => document.getElementById('scene-1-figures').open);
  await phone.close();
});

test('plots, rig and tables are reached and used by keyboard', async () => {
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
  assert.deepEqual(page.said, []);
});

test('on paper: the answer, every table and every plot once in its place, no player; and the screen comes back', async () => {
  const paper = await open(browser, 'report.html', {colorScheme: 'dark'});
  const background = () => paper.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const dark = await background();
  await paper.emulateMedia({media: 'print'});
  await paper.evaluate(() => dispatchEvent(new Event('beforeprint')));
  const looks = await paper.evaluate(() => {
    const plots = [...document.querySelectorAll('.plot')];
    const out = plots.filter((p) => {
      const place = p.getBoundingClientRect(), picture = p.querySelector('.main-svg').getBoundingClientRect();
      return picture.right > place.right + 1 || picture.bottom > place.bottom + 1;
    }).map((p) => p.dataset.plot);
    const boxes = [...document.querySelectorAll('.plot-grid figure')].map((f) => f.getBoundingClientRect());
    const over = boxes.some((a, i) => boxes.some((b, j) => j > i && a.left < b.right - 1 && b.left < a.right - 1 && a.top < b.bottom - 1 && b.top < a.bottom - 1));
    const shown = (selector) => [...document.querySelectorAll(selector)].filter((e) => e.getBoundingClientRect().height > 0).length;
    return {missing: plots.length - shown('.plot.drawn'), out, over, player: shown('.player, .transport, .glossary'), theme: document.documentElement.dataset.theme};
  });
  assert.deepEqual(looks, {missing: 0, out: [], over: false, player: 0, theme: 'light'});
  // The first page has the answer, not the title alone.
  assert.ok((await paper.pdf({format: 'A4', pageRanges: '1'})).length > 40000);
  const pdf = await paper.pdf({format: 'A4'});
  assert.equal(pdf.subarray(0, 5).toString(), '%PDF-');
  const pages = (pdf.toString('latin1').match(/\/Type\s*\/Page\b/g) || []).length;
  assert.ok(pages >= 3 && pages <= 9, `${pages} pages`);
  await paper.evaluate(() => dispatchEvent(new Event('afterprint')));
  await paper.emulateMedia({media: 'screen'});
  assert.equal(await background(), dark);
  assert.deepEqual(paper.said, []);
  await paper.close();
});
