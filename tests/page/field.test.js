// The plots of rotor dynamics in Chromium: in the pages of a run-up, of modes and of a sweep.
import {after, before, test} from 'node:test';
import fs from 'node:fs';
import path from 'node:path';
import {assert, folder, launch, nightly, open, rotorub, scene} from './support.js';

let browser;
before(async () => { browser = await launch(); });
after(() => browser?.close());

// What a plot shows, once it is drawn.
async function drawn(page, key) {
  const selector = `.plot[data-plot="${key}"]`;
  await page.evaluate((s) => document.querySelector(s).closest('figure').scrollIntoView({block: 'center', behavior: 'instant'}), selector);
  await page.waitForFunction((s) => (document.querySelector(s)._fullData || []).length > 0, selector);
  return page.evaluate((s) => {
    const plot = document.querySelector(s);
    return {notes: (plot.layout.annotations || []).map((a) => a.text?.replace(/<[^>]*>/g, '')).filter((text) => text),
      traces: plot._fullData.map((d) => ({name: d.name, mode: d.mode, axis: d.yaxis, symbol: d.marker?.symbol, x: [...d.x], y: [...d.y]}))};
  }, selector);
}
const largest = ({x, y}) => y.reduce((best, value, k) => (value > best.y ? {x: x[k], y: value} : best), {x: 0, y: -Infinity});

test('a run-up goes through the peak of its Bode plot, a little later, and the dots follow the time', async () => {
  rotorub(['run', scene('run_up'), '-o', 'up', '-q']);
  rotorub(['plot', 'up', '-q']);
  const page = await open(browser, 'up/plot.html');
  const bode = await drawn(page, 'bode'), contact = bode.traces.find((t) => t.name === 'contact' && t.mode === 'lines' && t.axis === 'y');
  const critical = largest(contact).x;
  const orders = await drawn(page, 'orders'), once = orders.traces.filter((t) => t.name === 'native, 1×').find((t) => t.axis === 'y');
  const peak = largest(once);
  assert.ok(peak.x > critical && peak.x < 1.25 * critical, `${peak.x} rpm beside ${critical} rpm`);
  assert.ok(peak.y < largest(contact).y, 'it has no time to grow');

  const places = [], last = {};
  for (const t of [0.2, 0.5]) {
    await page.evaluate(`page.players[0].clock.seek(${t})`);
    for (const key of ['cascade', 'orders', 'orders_polar']) {
      await drawn(page, key);
      // On a busy machine the dot follows a few frames later.
      last[key] = await page.evaluate(([k, before]) => new Promise((answer) => {
        const look = (left) => {
          const dot = document.querySelector(`.plot[data-plot="${k}"] .cursor-dots b`);
          const at = dot && [dot.style.left, dot.style.top].join();
          if (left === 0 || (at && at !== before)) answer(at); else setTimeout(() => look(left - 1), 50);
        };
        look(40);
      }), [key, last[key]]);
      places.push(last[key]);
    }
  }
  // At 0.2 s the cascade has no row yet: eight turns about it do not fit into the run.
  assert.ok(places.slice(1).every(Boolean), `${places}`);
  assert.equal(new Set(places).size, places.length, `${places}`);

  const cascade = await drawn(page, 'cascade'), rows = cascade.traces.filter((t) => t.name !== 'foot');
  assert.ok(rows.length > 20);
  for (const row of rows) assert.ok(largest(row).x > 30 && largest(row).x < 80, `forward, at ${largest(row).x} Hz`);
  const orbit = await drawn(page, 'orbit');
  assert.deepEqual(orbit.notes, ['native: forward']);
  assert.ok(orbit.traces.some((t) => t.mode === 'markers' && t.symbol === 'diamond' && t.x.length >= 1));
  assert.deepEqual(page.said, []);
  await page.close();
});

test('the critical speed map crosses the critical speeds at the stiffness of the scene', async () => {
  rotorub(['modes', scene('run_up'), '-o', 'modes', '-q']);
  const critical = JSON.parse(rotorub(['modes', scene('run_up'), '--json'])).critical_speeds.map((w) => w * 30 / Math.PI);
  const page = await open(browser, 'modes/modes.html');
  const map = await drawn(page, 'stiffness');
  assert.ok(map.traces.length >= 4);
  assert.ok(critical.length >= 3);
  map.traces.slice(0, Math.min(4, critical.length)).forEach((curve, k) => {
    const at = curve.x.findIndex((x) => Math.abs(x / 2e7 - 1) < 1e-6);
    assert.ok(Math.abs(curve.y[at] / critical[k] - 1) < 1e-5, `${curve.y[at]} is not ${critical[k]}`);
  });
  const bode = await drawn(page, 'bode');
  assert.ok(bode.notes.some((note) => note.includes('AF 50')), `damping of 1 %: ${bode.notes}`);
  const ratios = await drawn(page, 'damping'), decrements = await drawn(page, 'decrement');
  assert.equal(decrements.traces.length, ratios.traces.length);
  for (const [k, {y}] of decrements.traces.entries()) {
    for (const [i, value] of y.entries()) {
      const zeta = ratios.traces[k].y[i] / 100;
      assert.ok(Math.abs(value - 2 * Math.PI * zeta / Math.sqrt(1 - zeta ** 2)) < 1e-9, `${value} of ${zeta}`);
    }
  }
  assert.deepEqual(page.said, []);
  await page.close();
});

test('the critical speed map of a ring has the ring alone, and the rotor held to it', nightly, async () => {
  rotorub(['modes', scene('bench_ring'), '-o', 'ring', '-q']);
  const page = await open(browser, 'ring/modes.html');
  const map = await drawn(page, 'stiffness'), alone = map.traces.find((t) => t.name === 'ring alone'), held = map.traces.filter((t) => t.name !== 'ring alone');
  const at = alone.x.findIndex((x) => Math.abs(x / 1e5 - 1) < 1e-6);
  assert.ok(Math.abs(alone.y[at] / (Math.sqrt(1e5 / 1) * 30 / Math.PI) - 1) < 1e-5, `${alone.y[at]} rpm of 1 kg on 0.1 N/µm`);
  assert.equal(held.length, 1, 'of one bending mode');
  held[0].y.forEach((n, k) => {
    const exact = Math.sqrt((2e5 + held[0].x[k]) / (2 + 1)) * 30 / Math.PI;
    assert.ok(Math.abs(n / exact - 1) < 1e-4, `${n} is not ${exact} rpm`);
  });
  assert.match(await page.locator('figure:has(.plot[data-plot="stiffness"]) figcaption').textContent(), /Critical speed map of the ring — .*a rub resonates/);
  assert.deepEqual(page.said, []);
  await page.close();
});

test('words and tables are painted before plotly is unpacked', async () => {
  const page = await browser.newPage({viewport: {width: 1200, height: 1000}});
  await page.addInitScript(() => {
    let plotly;
    Object.defineProperty(window, 'Plotly', {get: () => plotly, set(given) { plotly = given; window.plotlyAt = performance.now(); }});
  });
  await page.goto(`file://${path.join(folder, 'modes/modes.html')}`);
  await page.waitForFunction(() => document.querySelector('.plot .main-svg'));
  const {painted, plotly} = await page.evaluate(() => ({painted: performance.getEntriesByName('first-contentful-paint')[0].startTime, plotly: window.plotlyAt}));
  // Two seconds after its start the page goes on without the browser's word (page.js, painted).
  assert.ok(painted < plotly || plotly > 2000, `${painted} and ${plotly} ms`);
  await page.close();
});

test('a bifurcation diagram in the page of a sweep shows two motions side by side', async () => {
  fs.writeFileSync(path.join(folder, 'study.toml'), `scene = "${scene('bench_annular_elastic')}"
[sample]
kind = "list"
[[vary]]
key = "rotor.speed"
also = ["force[0].frequency"]
values = ["60 Hz", "80 Hz", "100 Hz", "125 Hz"]
[run]
integrator = "event"
end = "1 s"
`);
  rotorub(['sweep', 'study.toml', '-o', 'sweep', '--bifurcation', '-q']);
  const page = await open(browser, 'sweep/sweep.html');
  const diagram = await drawn(page, 'bifurcation'), of = (name) => diagram.traces.find((t) => t.name === name);
  const at = (trace, hertz) => trace.y[trace.x.findIndex((x) => Math.abs(x - hertz) < 1e-3)];
  assert.ok(Math.abs(at(of('upwards'), 60) - at(of('downwards'), 60)) < 1, 'one motion');
  assert.ok(Math.abs(at(of('upwards'), 100) - at(of('downwards'), 100)) > 20, 'two motions');
  assert.deepEqual(of('Lyapunov exponent').x.map(Math.round), [60, 80, 100, 125]);
  assert.deepEqual(page.said, []);
  await page.close();
});

test('the branches of periodic rubs have their fold on the page', async () => {
  rotorub(['modes', scene('bench_whip'), '--periodic', '--across', 'contact.friction=0.15:0.2:2', '-o', 'branches', '-q']);
  const page = await open(browser, 'branches/rub_branches.html');
  for (const plot of ['mean_force', 'amplitude', 'multiplier']) {
    const {traces} = await drawn(page, plot), fold = traces.find((t) => t.name === 'fold');
    assert.ok(Math.abs(fold.x[0] - 0.15510962) < 1e-6, `${fold.x}`);
    assert.ok(traces.filter((t) => t.mode === 'lines').length >= 2, 'a stable and an unstable part');
  }
  assert.deepEqual(page.said, []);
  await page.close();
});

test('a click on a point of a sweep shows how to run it, and then leads to its run', nightly, async () => {
  fs.writeFileSync(path.join(folder, 'points.toml'), `scene = "${scene('bench_ring')}"
[sample]
kind = "grid"
[[vary]]
key = "contact.friction"
from = 0.1
to = 0.3
count = 3
[[vary]]
key = "contact.restitution"
from = 0.2
to = 0.8
count = 2
[statistics]
by = ["contact.friction"]
[run]
integrator = "event"
end = "20 ms"
`);
  rotorub(['sweep', 'points.toml', '-o', 'points', '-q']);
  let page = await open(browser, 'points/sweep.html');
  // The cell in the middle at the top: friction 0.2, restitution 0.8.
  const click = async () => {
    const box = await page.evaluate(() => {
      const plot = document.querySelector('.map-set .plot');
      plot.scrollIntoView({block: 'center', behavior: 'instant'});
      const {xaxis, yaxis} = plot._fullLayout, place = plot.getBoundingClientRect();
      const [trace] = plot.data;
      return {x: place.left + xaxis._offset + xaxis.d2p(trace.x[3]), y: place.top + yaxis._offset + yaxis.d2p(trace.y[3])};
    });
    await page.mouse.move(box.x - 3, box.y);
    await page.mouse.move(box.x, box.y);
    await page.mouse.click(box.x, box.y);
    await page.waitForFunction(() => document.querySelector('.chosen-point p'));
  };
  await click();
  assert.equal(await page.locator('.chosen-point .command').textContent(), "rotorub sweep 'points.toml' -o 'points' --point 3");
  assert.match(await page.locator('.chosen-point').textContent(), /contact.friction 0.2 .*contact.restitution 0.8 .*status ok/);
  const lines = fs.readFileSync(path.join(folder, 'points/statistics.csv'), 'utf8').trim().split('\n').length;
  assert.equal(await page.locator('section', {has: page.locator('h2', {hasText: 'Statistics'})}).last().locator('tbody tr').count(), lines - 1);
  await page.close();
  rotorub(['sweep', 'points.toml', '-o', 'points', '--point', '3', '-q']);
  page = await open(browser, 'points/sweep.html');
  await page.locator('.chosen-point input').fill('9');
  await page.locator('.chosen-point input').press('Enter');
  assert.match(await page.locator('.chosen-point').textContent(), /Points are 0 to 5/);
  await click();
  await page.locator('.chosen-point a').click();
  await page.waitForFunction(() => document.title.includes('bench_ring') && document.querySelector('.player'));
  assert.match(page.url(), /points\/point-3\/plot.html$/);
  assert.deepEqual(page.said, []);
  await page.close();
});
