// The page of `rotorub modes` of a machine in magnetic bearings, in Chromium: closed loop, zones, step, unbalance, the latter in one plot.
import {after, before, test} from 'node:test';
import {assert, launch, open, rotorub, scene} from './support.js';

let browser, page, loop, text;
before(async () => {
  text = String(rotorub(['modes', scene('relevitation'), '-o', 'loop']));
  loop = JSON.parse(rotorub(['modes', scene('relevitation'), '--json'])).speeds[0].levitation;
  browser = await launch();
  page = await open(browser, 'loop/modes.html');
});
after(() => browser?.close());

const near = (a, b, share, words) => assert.ok(Math.abs(a - b) <= share * Math.abs(b), `${words}: ${a} is not ${b}`);
const names = () => loop.loops.map(({bearing, axis}) => `bearing ${bearing} ${axis}`);

async function drawn(key) {
  const selector = `.plot[data-plot="${key}"]`;
  await page.evaluate((s) => document.querySelector(s).scrollIntoView({block: 'center', behavior: 'instant'}), selector);
  await page.waitForFunction((s) => (document.querySelector(s)._fullData || []).length > 0, selector);
  return page.evaluate((s) => {
    const plot = document.querySelector(s);
    return {shapes: plot.layout.shapes, notes: (plot.layout.annotations || []).map((a) => a.text),
      traces: plot._fullData.map((d) => ({name: d.name, mode: d.mode, x: [...d.x], y: [...d.y], symbol: d.marker?.symbol}))};
  }, selector);
}
const lines = ({traces}) => traces.filter((t) => t.mode === 'lines');

test('sensitivities with the four zones, and their peaks on the curves', async () => {
  const plot = await drawn('sensitivity');
  assert.deepEqual(plot.notes.map((note) => note.replace(/<\/?b>/g, '')), ['A', 'B', 'C', 'D']);
  const limits = plot.shapes.filter((s) => s.type === 'line').map((s) => s.y0);
  for (const [k, decibels] of [9.5, 12, 14].entries()) assert.ok(Math.abs(limits[k] - decibels) < 0.06, `${limits[k]} dB`);
  assert.deepEqual(lines(plot).map((t) => t.name), names());
  for (const [k, curve] of lines(plot).entries()) {
    const {sensitivity, frequency} = loop.loops[k], peak = 20 * Math.log10(sensitivity), most = Math.max(...curve.y);
    near(most, peak, 1e-4, curve.name);
    near(curve.x[curve.y.indexOf(most)], frequency / (2 * Math.PI), 1e-4, 'at Hz');
  }
});

test('the step of force, its most, when it has settled and what stays', async () => {
  const plot = await drawn('step');
  assert.deepEqual(lines(plot).map((t) => t.name), names());
  for (const [k, curve] of lines(plot).entries()) {
    const {largest, largest_at: at, settling_time: settled} = loop.loops[k].step;
    near(Math.max(...curve.y), 1e6 * largest, 1e-5, curve.name);
    near(curve.x[curve.y.indexOf(Math.max(...curve.y))], 1e3 * at, 1e-5, 'at ms');
    // The drawn line leaves the band no more after the diamond, and is at its edge there.
    const mark = plot.traces.find((t) => t.name === curve.name && t.symbol === 'diamond-open');
    near(mark.x[0], 1e3 * settled, 1e-5, 'settled');
    near(Math.abs(mark.y[0]), 0.02e6 * largest, 1e-4, 'at the edge');
    assert.ok(curve.x[curve.x.length - 1] > mark.x[0]);
    assert.ok(curve.y.every((y, i) => curve.x[i] < mark.x[0] || Math.abs(y) <= 0.02e6 * largest * 1.0001));
  }
});

test('Bode is the one plot of the unbalance response, with what the terminal says at the speed of the scene', async () => {
  assert.equal(await page.locator('.plot[data-plot="unbalance"]').count(), 0);
  const {shapes, traces} = await drawn('bode'), running = shapes.find((s) => s.line.dash === 'dot').x0;
  const curve = (name) => traces.find((t) => t.name === name && t.mode === 'lines');
  const at = curve('sensor 1').x.findIndex((n) => Math.abs(n / running - 1) < 1e-6);
  for (const {bearing, unbalance} of loop.loops) near(2 * curve(`sensor ${bearing}`).y[at], 1e6 * unbalance, 1e-4, `sensor ${bearing}`);
  near(curve('limit of API 617').y[at], 12.7, 1e-4, 'half of 25.4 µm');
});

// Every cell of the page's tables is printed by the terminal, in the same order.
test('the tables have the figures of the terminal', async () => {
  const loops = page.locator('.sheets > section', {has: page.locator('h2', {hasText: /^closed loop of the magnetic bearings/})});
  const rows = await loops.locator('tbody tr').evaluateAll((all) => all.map((row) => [...row.cells].map((c) => c.textContent)));
  assert.ok(rows.length >= loop.loops.length * 3 + 10, `${rows.length} rows`);
  const printed = text.slice(text.indexOf('closed loop of the magnetic bearings')).split('\n').map((line) => line.trim().split(/\s+/));
  let from = 0;
  for (const row of rows) {
    const at = printed.findIndex((line, k) => k >= from && line.join(' ') === row.join(' '));
    assert.ok(at >= 0, `${row} is printed`);
    from = at + 1;
  }
});

test('is silent, and no table is cut off', async () => {
  assert.deepEqual(page.said, []);
  const cut = await page.evaluate(() => [...document.querySelectorAll('.sheets .scroll > table')].filter((t) => t.scrollWidth > t.parentElement.clientWidth + 1)
    .map((t) => t.textContent.trim().slice(0, 40)));
  assert.deepEqual(cut, []);
});
