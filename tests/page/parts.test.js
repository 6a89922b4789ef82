// The report's other parts in Chromium: contents list, names of figures and switches, the free rotor, results of other
// commands beside the comparison.
import fs from 'node:fs';
import path from 'node:path';
import {after, before, test} from 'node:test';
import {assert, folder, launch, open, rotorub, scene} from './support.js';

let browser, page;
before(async () => {
  fs.mkdirSync(path.join(folder, 'with/bench'), {recursive: true});
  fs.writeFileSync(path.join(folder, 'with/bench/bench.json'), rotorub(['bench', scene('bench_ring'), '--engines', 'native,mujoco',
    '--steps', '100us,50us,20us', '--tolerances', '1e-4,1e-6,1e-8', '--repeats', '1', '--end', '0.02', '--quiet', '--json']));
  rotorub(['check', scene('hard/grazing_miss'), scene('hard/attractor_rub'), '--quiet', '-o', 'with/hard']);
  fs.writeFileSync(path.join(folder, 'study.toml'), `scene = "${scene('bench_ring')}"\n[sample]\nkind = "grid"\n` +
    '[[vary]]\nkey = "rotor.speed"\nfrom = "20 Hz"\nto = "60 Hz"\ncount = 4\n[[vary]]\nkey = "contact.friction"\nvalues = [0.05, 0.2, 0.4]\n');
  rotorub(['sweep', 'study.toml', '--set', 'run.end=0.02', '--quiet', '-o', 'with/ring']);
  // Its commands name the scene by a path that is longer than a phone is wide.
  const deep = path.join(folder, 'a_folder_with_a_long_name'.repeat(4));
  fs.mkdirSync(deep);
  fs.copyFileSync(scene('bench_ring'), path.join(deep, 'bench_ring.toml'));
  rotorub(['compare', path.join(deep, 'bench_ring.toml'), scene('paper_magnetic'), '--end', '0.03', '--twins', '0', '--no-modes-ladder',
    '--no-video', '--quiet', '--with', 'with', '-o', '.'], [0, 1]);
  browser = await launch();
  page = await open(browser, 'report.html');
});
after(() => browser?.close());

// Scrolls to a plot and waits until plotly has drawn it.
async function drawn(selector) {
  await page.evaluate((s) => document.querySelector(s).scrollIntoView({block: 'center', behavior: 'instant'}), selector);
  await page.waitForFunction((s) => (document.querySelector(s)._fullData || []).length > 0, selector);
  return page.evaluate((s) => {
    const plot = document.querySelector(s), {xaxis, yaxis} = plot._fullLayout;
    return {x: xaxis.range, y: yaxis.range, lines: (plot.layout.shapes || []).map((l) => [l.type, l.x0, l.x1]),
      traces: plot._fullData.map((d) => ({name: d.name, x: [...(d.x || [])], y: [...(d.y || [])], visible: d.visible,
        dash: d.line?.dash, symbol: d.marker?.symbol, mode: d.mode, text: d.text}))};
  }, selector);
}

test('every link of the contents leads somewhere, by keyboard too', async () => {
  const links = await page.locator('nav.contents a').evaluateAll((all) => all.map((a) => {
    const to = document.getElementById(a.getAttribute('href').slice(1));
    return {href: a.getAttribute('href'), height: to ? to.getBoundingClientRect().height : 0, name: a.textContent};
  }));
  assert.ok(links.length > 15, `${links.length} links`);
  for (const {href, height} of links) assert.ok(height > 20, `${href} is ${height} px high`);
  assert.equal(new Set(links.map((l) => l.href)).size, links.length);
  for (const part of ['#scene-1', '#scene-2-rotor', '#precision', '#cases', '#maps']) assert.ok(links.some((l) => l.href === part), part);
  // Every section of its own is in the list.
  const ids = await page.evaluate(() => [...document.querySelectorAll('main [id]')].filter((e) => /SECTION|ARTICLE|DETAILS/.test(e.tagName) && !e.closest('svg')).map((e) => `#${e.id}`));
  for (const id of ids) assert.ok(links.some((l) => l.href === id), `${id} is in the contents`);
  const last = page.locator('nav.contents a[href="#scene-2-figures"]');
  await last.focus();
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => Math.abs(document.getElementById('scene-2-figures').getBoundingClientRect().top) < 120);
});

test('a plot is saved as a picture and as a table', async () => {
  const {traces} = await drawn('#scene-1-plots .plot[data-plot="gap"]');
  const saved = async (format) => {
    const button = page.locator('#scene-1-plots figure:has(.plot[data-plot="gap"]) .save button', {hasText: format});
    const [download] = await Promise.all([page.waitForEvent('download'), button.click()]);
    return {name: download.suggestedFilename(), text: fs.readFileSync(await download.path(), 'utf8')};
  };
  const table = await saved('CSV');
  assert.match(table.name, /^[a-z-]+\.csv$/);
  const [header, ...lines] = table.text.trim().split('\r\n');
  assert.equal(header, 'trace,x,y');
  assert.equal(lines.length, traces.reduce((sum, t) => sum + t.y.length, 0));
  const [name, x, y] = lines[0].split(',');
  assert.deepEqual([name, Number(x), Number(y)], [traces[0].name, traces[0].x[0], traces[0].y[0]]);
  assert.match((await saved('SVG')).text, /^<svg/);
});

test('a link leads to a time, a zoom and the runs shown, and the address follows them', async () => {
  const linked = await open(browser, 'report.html#scene-1?t=0.011&from=0.01&to=0.012&hide=cone');
  const shown = () => linked.evaluate(() => {
    const plots = document.getElementById('scene-1-plots');
    return {t: window.page.players[0].clock.t, hash: location.hash,
      off: [...plots.querySelectorAll('.legend-item[aria-pressed="false"]')].map((b) => b.dataset.side),
      range: plots.querySelector('.plot.drawn')?._fullLayout?.xaxis.range};
  });
  await linked.evaluate(() => document.querySelector('#scene-1-plots .plot').scrollIntoView({block: 'center', behavior: 'instant'}));
  await linked.waitForFunction(() => document.querySelector('#scene-1-plots .plot.drawn'));
  const first = await shown();
  assert.deepEqual([first.t, first.off], [0.011, ['cone']]);
  assert.ok(first.range[0] >= 0.0099 && first.range[1] <= 0.0121, first.range);
  await linked.locator('#scene-1-plots .legend-item[data-side="cone"]').click();
  await linked.evaluate(() => window.page.players[0].clock.seek(0.0105));
  await linked.waitForFunction(() => location.hash.startsWith('#scene-1?t=0.0105'));
  assert.ok(!(await shown()).hash.includes('hide'));
  assert.deepEqual(linked.said, []);
  await linked.close();
});

test('figures, pictures and switches have names and states', async () => {
  const nameless = await page.evaluate(() => {
    const named = (e) => e.getAttribute('aria-label') || e.textContent.trim() || e.title;
    return [
      ...[...document.querySelectorAll('.plot')].filter((p) => !p.closest('figure')?.querySelector('figcaption')).map((p) => p.dataset.plot || p.id),
      ...[...document.querySelectorAll('main canvas')].filter((c) => !c.getAttribute('aria-label')).map((c) => c.className),
      ...[...document.querySelectorAll('button, a, select')].filter((b) => !b.closest('.plot') && !named(b)).map((b) => b.outerHTML.slice(0, 80)),
      ...[...document.querySelectorAll('input')].filter((i) => !i.getAttribute('aria-label') && !i.closest('label')).map((i) => i.className),
      ...[...document.querySelectorAll('.legend-item, [data-window], .play, #theme')].filter((b) => !/true|false/.test(b.getAttribute('aria-pressed'))).map((b) => b.textContent),
    ];
  });
  assert.deepEqual(nameless, []);
  const theme = page.locator('#theme');
  assert.equal(await theme.getAttribute('aria-pressed'), 'false');
  await theme.click();
  assert.equal(await theme.getAttribute('aria-pressed'), 'true');
  await theme.click();
});

test('Campbell: both senses by colour and dash, 1x, 2x, torsion, critical speeds, the scene where it runs', async () => {
  const {x, y, lines, traces} = await drawn('#scene-2-rotor .plot[data-plot="campbell"]');
  const rotor = await page.evaluate('page.data.scenes[1].rotor.campbell');
  const of = (name) => traces.filter((t) => t.name === name);
  assert.ok(of('forward').length >= 2 && of('backward').length >= 2);
  assert.ok(of('forward').every((t) => t.dash === 'solid') && of('backward').every((t) => t.dash === 'dash'));
  for (const times of [1, 2]) {
    const [ray] = of(`${times}×`);
    assert.ok(Math.abs(ray.y[1] / ray.x[1] * 60 - times) < 1e-9, `${times}x`);
  }
  const shown = rotor.critical.filter((n) => n <= rotor.top);
  assert.deepEqual(of('critical speed')[0].x, shown);
  assert.ok(shown.every((n) => n >= x[0] && n <= x[1]));
  assert.ok(rotor.torsion.length > 0);
  assert.deepEqual(of('torsion').map((t) => t.y), rotor.torsion.map((f) => [f, f]));
  assert.ok(lines.some(([type, a, b]) => type === 'line' && a === rotor.running && b === rotor.running));
  // The marks of the operating point lie on the branches: linear between their points.
  const at = (t, n) => { const k = t.x.findIndex((v) => v >= n); return t.y[k - 1] + (n - t.x[k - 1]) / (t.x[k] - t.x[k - 1]) * (t.y[k] - t.y[k - 1]); };
  for (const sense of ['forward', 'backward']) {
    const [marks] = of(`${sense} at the scene's speed`), branches = of(sense).filter((t) => t.x[0] < rotor.running && t.x[t.x.length - 1] >= rotor.running);
    assert.equal(marks.x.length, branches.length);
    for (const f of marks.y) assert.ok(branches.some((t) => Math.abs(at(t, rotor.running) / f - 1) < 1e-3), `${sense} at ${f} Hz`);
    assert.equal(marks.symbol, sense === 'forward' ? 'circle' : 'diamond-open');
  }
  assert.ok(y[1] > Math.max(...shown) / 60);
});

test('whirl shapes at the speed of the scene; of a modal rotor a word instead', async () => {
  await drawn('#scene-2-rotor .plot[data-plot="whirl_shapes"]');
  const {notes, whirl} = await page.evaluate(() => ({whirl: window.page.data.scenes[1].rotor.shapes.whirl,
    notes: document.querySelector('#scene-2-rotor .plot[data-plot="whirl_shapes"]').layout.annotations}));
  assert.equal(whirl.length, 8);
  assert.deepEqual(notes.filter(({text}) => text).map(({text}) => text.split(',')[0]), whirl.map(({sense, number}) => `${sense} ${number}`));
  assert.equal(notes.filter(({showarrow}) => showarrow).length, 8, 'an arrow of its direction each');
  assert.equal(await page.locator('#scene-1-rotor .plot[data-plot="whirl_shapes"]').count(), 0);
  assert.match(await page.locator('#scene-1-rotor').textContent(), /No whirl shapes: the scene gives its modes/);
  assert.ok((await drawn('#scene-1-rotor .plot[data-plot="campbell"]')).traces.length > 4);
});

test('speed against error from a kept bench', async () => {
  const bench = JSON.parse(fs.readFileSync(path.join(folder, 'with/bench/bench.json'))).scenes[0];
  const {traces} = await drawn('[data-of="bench"][data-plot="precision"]');
  assert.equal(traces.length, bench.series.length);
  const verlet = bench.points.filter((p) => p.engine === 'native-verlet');
  const shown = traces.find((t) => t.name === 'native-verlet');
  assert.equal(shown.y.length, verlet.length);
  for (const [k, error] of shown.y.entries()) assert.ok(Math.abs(error / verlet[k].position_error - 1) < 1e-5);
  const event = traces.find((t) => t.name === 'native-event');
  assert.equal(event.x.length, 3, 'a series over the tolerances');
  assert.ok((await drawn('[data-of="bench"][data-plot="step"]')).traces.some((t) => t.name === 'native-verlet'));
});

test('hard cases from a kept check', async () => {
  const {cases} = JSON.parse(fs.readFileSync(path.join(folder, 'with/hard/check.json')));
  const cells = await page.locator('#cases tbody tr').evaluateAll((rows) => rows.flatMap((row) =>
    [...row.querySelectorAll('td')].map((td) => [row.querySelector('th').textContent, td.querySelector('.word').textContent])));
  const word = (outcome) => (outcome === 'violates' ? 'fails' : outcome);
  assert.deepEqual(cells, cases.map((one) => [one.scene, word(one.outcome)]));
  const reasons = await page.locator('#cases p.note').allTextContents();
  for (const {scene: name, engine, outcome} of cases)
    assert.equal(reasons.some((text) => text.startsWith(`${name}, ${engine}: `)), outcome !== 'pass', `${name} ${engine}`);
});

test('maps from a kept sweep, that change as on their own page', async () => {
  const {traces} = await drawn('#maps .plot');
  assert.equal(traces[0].x.length, 12);
  const lists = page.locator('#maps .axes select');
  assert.equal(await lists.count(), 2);
  const image = () => page.evaluate(() => document.querySelectorAll('#maps .plot')[1].layout.images[0].source);
  const first = await image();
  await page.locator('#maps select.figure').nth(1).selectOption({label: 'mean_force'});
  assert.notEqual(await image(), first);
  assert.deepEqual(page.said, []);
});

// Tables that are wider than their place.
const cutOff = (of) => of.evaluate(() => [...document.querySelectorAll('.scroll > table')].filter((t) => t.offsetParent &&
  t.scrollWidth > t.parentElement.clientWidth + 1).map((t) => `${t.textContent.trim().slice(0, 30)} ${t.scrollWidth} in ${t.parentElement.clientWidth}`));

test('no table is cut off', async () => assert.deepEqual(await cutOff(page), []));

test('prints with all of it', async () => {
  await page.emulateMedia({media: 'print'});
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  const left = await page.evaluate(() => [...document.querySelectorAll('.plot')].filter((p) => !p.querySelector('.main-svg')).map((p) => p.dataset.plot || p.id));
  assert.deepEqual(left, []);
  const out = await page.evaluate(() => [...document.querySelectorAll('.plot')].filter((p) => {
    const place = p.getBoundingClientRect(), picture = p.querySelector('.main-svg').getBoundingClientRect();
    return picture.right > place.right + 1 || picture.bottom > place.bottom + 1;
  }).map((p) => p.dataset.plot || p.id || 'map'));
  assert.deepEqual(out, []);
  assert.deepEqual(await cutOff(page), []);
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  await page.emulateMedia({media: 'screen'});
});

test('400 px are enough for all of it', async () => {
  const phone = await open(browser, 'report.html', {width: 400, height: 800});
  const out = await phone.evaluate(() => {
    const scrolled = (e) => e !== document.body && (/auto|scroll|hidden|clip/.test(getComputedStyle(e).overflowX) || scrolled(e.parentElement));
    return [...document.body.querySelectorAll('*')].filter((e) => e.getBoundingClientRect().right > innerWidth + 1 && !scrolled(e.parentElement))
      .map((e) => `${e.localName} ${e.className}, right edge ${Math.round(e.getBoundingClientRect().right)}: ${e.textContent.trim().slice(0, 60)}`);
  });
  assert.deepEqual(out, []);
  assert.ok(await phone.evaluate(() => document.scrollingElement.scrollWidth) <= 400);
  const cases = await phone.evaluate(() => { const t = document.querySelector('#cases table'); return [t.scrollWidth, t.parentElement.clientWidth]; });
  assert.ok(cases[0] <= cases[1] + 1, `hard cases are ${cases[0]} px wide in ${cases[1]}`);
  await phone.close();
});
