// The report in Chromium: two scenes, four runs each.
import {after, before, test} from 'node:test';
import {assert, bring, eventually, launch, open, rotorub, scene, seek, series, state} from './support.js';

let browser, page;
before(async () => {
  rotorub(['compare', scene('bench_ring'), scene('paper_magnetic'), '--end', '0.12', '--twins', '0', '--no-modes-ladder',
    '--no-video', '--quiet', '-o', '.'], [0, 1]);
  browser = await launch();
  page = await open(browser, 'report.html');
});
after(() => browser?.close());

const near = (a, b, within, words) => assert.ok(Math.abs(a - b) <= within, `${words || ''} ${a} is not ${b} within ${within}`);

test('is silent: no error, no warning, no request', async () => {
  await page.evaluate(() => window.scrollTo(0, document.body.scrollHeight));
  await page.waitForTimeout(500);
  assert.deepEqual(page.said, []);
});

test('draws every plot when a reader comes to it', async () => {
  const count = await page.locator('.plot[data-plot]').count();
  assert.ok(count > 20, `${count} plots`);
  for (let k = 0; k < count; ++k) {
    const plot = page.locator('.plot[data-plot]').nth(k);
    await plot.evaluate((p) => p.scrollIntoView({block: 'center', behavior: 'instant'}));
    const has = await plot.evaluate((p) => new Promise((answer) => {
      const look = (left) => {
        const marks = p.querySelectorAll('.scatterlayer path.js-line[d], .scatterlayer path.point');
        // A waterfall is a picture of its cells.
        const pictures = p.querySelectorAll('.imagelayer image');
        const drawn = p.classList.contains('drawn') && ([...marks].some((m) => (m.getAttribute('d') || '').length > 4) ||
          [...pictures].some((m) => (m.getAttribute('xlink:href') || m.getAttribute('href') || '').length > 500));
        if (drawn || left === 0) answer(drawn); else setTimeout(() => look(left - 1), 50);
      };
      look(1200);
    }));
    assert.ok(has, await plot.getAttribute('data-plot'));
  }
});

// Every picture and every plot near the screen shows the same time, each asked for itself.
async function shownTimes(k) {
  const s = await state(page, k);
  const times = [s.time, ...s.rigs.map((r) => r.t), ...s.sections.map((r) => r.t), s.unrolled.t];
  const cursors = await page.evaluate((i) => {
    const scene = document.querySelectorAll('.scene')[i];
    return [...scene.querySelectorAll('.plot.drawn[data-over="time"], .plot.drawn[data-over="impacts"]')].filter((p) => {
      const box = p.getBoundingClientRect();
      return box.bottom > 0 && box.top < innerHeight;
    }).map((p) => {
      // From pixels alone: where the line is between the first and the last tick of the axis.
      const line = p.querySelector('.cursor').getBoundingClientRect(), axis = p._fullLayout.xaxis;
      const drag = p.querySelector('.nsewdrag').getBoundingClientRect();
      const [from, to] = axis.range;
      return {t: from + (line.left - drag.left) / drag.width * (to - from), pixel: (to - from) / drag.width, hidden: p.querySelector('.cursor').hidden};
    });
  }, k);
  return {times, cursors};
}

test('a click in a plot seeks, and all follow', async () => {
  await bring(page, '.plot[data-plot="gap"]');
  const plot = page.locator('.scene').nth(0).locator('.plot[data-plot="gap"] .nsewdrag').first();
  // On a busy machine the plot may still move while it is clicked.
  const drag = await eventually(async () => {
    const box = await plot.boundingBox();
    await page.mouse.click(box.x + 0.4 * box.width, box.y + 0.5 * box.height);
    await page.waitForTimeout(500);
    near((await state(page, 0)).time, 0.4 * 0.12, 0.12 / box.width, 'time');
    return box;
  });
  const {times, cursors} = await shownTimes(0);
  for (const t of times) near(t, 0.4 * 0.12, 0.12 / drag.width, 'picture');
  assert.equal(new Set(times.map((t) => t.toFixed(12))).size, 1);
  assert.ok(cursors.length >= 3);
  for (const c of cursors) near(c.t, times[0], 1.5 * c.pixel, 'cursor');
});

test('the slider seeks', async () => {
  await page.locator('.scene').nth(0).locator('.seek').evaluate((s) => { s.value = 0.05; s.dispatchEvent(new Event('input')); });
  const {times, cursors} = await shownTimes(0);
  for (const t of times) near(t, 0.05, 1e-12);
  for (const c of cursors) near(c.t, 0.05, 1.5 * c.pixel);
});

// From pixels and ranges of the axes alone: where the dots are.
test('dots show where the runs are on their orbits', async () => {
  const {from, to} = await page.evaluate('page.data.scenes[1].windows[2]');
  await bring(page, '.plot[data-plot="relative"]', 1);
  for (const t of [from + 0.2 * (to - from), from + 0.9 * (to - from)]) {
    await seek(page, t, 1);
    await page.waitForFunction((time) => ['orbit', 'relative'].every((key) =>
      Number(document.querySelectorAll(`.plot[data-plot="${key}"]`)[1].dataset.cursor) === time), t);
    for (const key of ['orbit', 'relative']) {
      const dots = await page.evaluate((name) => {
        const plot = document.querySelectorAll(`.plot[data-plot="${name}"]`)[1], drag = plot.querySelector('.nsewdrag').getBoundingClientRect();
        const {xaxis, yaxis} = plot._fullLayout, at = (share, [a, b]) => a + share * (b - a);
        return [...plot.querySelectorAll('.cursor-dots b')].map((dot) => {
          const box = dot.getBoundingClientRect();
          return {side: dot.dataset.side, x: at((box.left + box.width / 2 - drag.left) / drag.width, xaxis.range),
            y: at((drag.bottom - box.top - box.height / 2) / drag.height, yaxis.range), pixel: (xaxis.range[1] - xaxis.range[0]) / drag.width};
        });
      }, key);
      assert.ok(dots.length >= 2, `${dots.length} dots`);
      for (const dot of dots) {
        const pose = await page.evaluate(([side, time]) => page.players[1].runs.find((run) => run.label === side).pose(time), [dot.side, t]);
        const ring = key === 'orbit' ? [0, 0] : pose.ring;
        near(dot.x, 1e6 * (pose.rotor[0] - ring[0]), 1.5 * dot.pixel, `${key} ${dot.side} x`);
        near(dot.y, 1e6 * (pose.rotor[1] - ring[1]), 1.5 * dot.pixel, `${key} ${dot.side} y`);
      }
    }
  }
});

// What the page shows against the files of the run, at their rows: the promise of packed_run.h, end to end.
test('shows what the series say', async () => {
  for (const [k, name] of ['bench_ring', 'paper_magnetic'].entries()) {
    await bring(page, '.player', k);
    for (const [place, label] of ['native', 'cone'].entries()) {
      await page.locator('.scene').nth(k).locator('.player select').nth(place).selectOption({label});
      const rows = series(`${name}/${label}/series.csv`);
      const poses = await page.evaluate(([i, p, times]) => times.map((t) => page.players[i].shown[p].pose(t)),
        [k, place, rows.map((row) => Number(row.t))]);
      const control = (row) => Math.hypot(row.control_x, row.control_y);
      const [mean, meanControl] = [(row) => Math.abs(row.normal_force), control].map((of) => {
        const forces = rows.map(of).filter((f) => f > 0);
        return forces.reduce((sum, f) => sum + f, 0) / Math.max(1, forces.length);
      });
      rows.forEach((row, i) => {
        const pose = poses[i], gap = Number(row.gap), gapOff = Math.max(31e-9, 0.0101 * Math.abs(gap));
        near(pose.gap, gap, gapOff, `${label} gap at ${row.t}`);
        // The rotor's place in the ring follows the gap, and so both tolerances add up.
        ['x', 'y'].forEach((axis, c) => {
          near(pose.ring[c], row[`stator_${axis}`], 1.001e-6, 'ring');
          near(pose.rotor[c], row[`rotor_${axis}`], 2.1e-6 + gapOff, 'rotor');
        });
        assert.equal(pose.mode, row.mode);
        near(pose.spin, row.spin_angle, 2.001e-3, 'spin');
        // 1 % of the mean of the dense rows, which these few tell no better than to a factor.
        near(pose.normal, row.normal_force, 0.0101 * Math.max(row.normal_force, 3 * mean), `force at ${row.t}`);
        if (pose.control) near(pose.control[0], row.control_x, 0.0101 * Math.max(control(row), 3 * meanControl), `control at ${row.t}`);
      });
      await seek(page, rows[500].t, k);
      near((await state(page, k)).poses[place].gap, poses[500].gap, 0, 'what is shown');
    }
  }
});

test('plays, slower at impacts, and pauses', async () => {
  await bring(page, '.player', 1);
  let s = await state(page, 1);
  const [hard] = s.hard;
  await seek(page, hard, 1);
  s = await state(page, 1);
  near(s.pace_here, s.pace / 10, 1e-9 * s.pace, 'pace at an impact');
  await seek(page, 0, 1);
  s = await state(page, 1);
  assert.equal(s.pace_here, s.pace, 'far from impacts');
  const play = page.locator('.scene').nth(1).locator('.play');
  await play.click();
  assert.equal(await play.getAttribute('aria-pressed'), 'true');
  await page.waitForFunction('page.players[1].state().time > 0');
  assert.ok((await state(page, 1)).playing);
  await play.click();
  const paused = await state(page, 1);
  assert.ok(!paused.playing);
  await page.waitForTimeout(100);
  assert.equal((await state(page, 1)).time, paused.time);
  const {times} = await shownTimes(1);
  assert.equal(new Set(times).size, 1, 'the last frame is whole');
});

test('obeys the keys of a player', async () => {
  await page.locator('.scene').nth(0).locator('.player').focus();
  const press = async (key) => { await page.keyboard.press(key); return state(page); };
  assert.equal((await press('Home')).time, 0);
  const one = (await press('ArrowRight')).time;
  assert.ok(one > 0);
  near((await press('Shift+ArrowRight')).time, 11 * one, 1e-9);
  near((await press('ArrowLeft')).time, 10 * one, 1e-9);
  assert.equal((await press('End')).time, 0.12);
  await press('Home');
  const {hard} = await state(page);
  assert.equal((await press('PageDown')).time, hard[0]);
  assert.equal((await press('PageDown')).time, hard[1]);
  assert.equal((await press('PageUp')).time, hard[0]);
  assert.ok((await press('Space')).playing);
  assert.ok(!(await press('Space')).playing);
});

test('a drag zooms all plots over time, from the data', async () => {
  await bring(page, '.plot[data-plot="gap"]');
  const gap = page.locator('.scene').nth(0).locator('.plot[data-plot="gap"]');
  const box = await gap.locator('.nsewdrag').first().boundingBox();
  await page.mouse.move(box.x + 0.5 * box.width, box.y + 60);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.6 * box.width, box.y + 62, {steps: 8});
  await page.mouse.up();
  await page.waitForFunction(() => document.querySelector('.plot[data-plot="gap"]')._fullLayout.xaxis.range[0] > 0.05);
  const looks = await page.evaluate(() => ['gap', 'gap_rate'].map((key) => {
    const plot = document.querySelector(`.plot[data-plot="${key}"]`);
    return {range: plot._fullLayout.xaxis.range, points: plot.data.find((d) => d.name === 'native').x.length,
      simplify: plot._fullData[0].line.simplify};
  }));
  assert.ok(looks[0].points > 60, `${looks[0].points} points of the gap in 12 ms`);
  for (const look of looks) {
    near(look.range[0], 0.06, 0.0003);
    near(look.range[1], 0.072, 0.0003);
    assert.equal(look.simplify, false);
  }
  await page.locator('.scene').nth(0).locator('[data-window="0"]').click();
  const whole = await gap.evaluate((p) => p._fullLayout.xaxis.range);
  assert.deepEqual(whole, [0, 0.12]);
});

test('hides a run', async () => {
  const button = page.locator('.scene').nth(0).locator('.legend-item[data-side="cone"]');
  const visible = () => page.evaluate(() => [...document.querySelectorAll('.plot.drawn')].filter((p) => p.data && p.stale === false && p.closest('.scene')
    && p.closest('.scene').dataset.scene === '0').flatMap((p) => p.data.filter((d) => d.name === 'cone').map((d) => d.visible)));
  await button.click();
  assert.equal(await button.getAttribute('aria-pressed'), 'false');
  await eventually(async () => assert.deepEqual([...new Set(await visible())], ['legendonly']));
  await button.click();
  await eventually(async () => assert.deepEqual([...new Set(await visible())], [true]));
});

test('the waterfall is of the first run shown, and the spectrum has every run', async () => {
  const scene = page.locator('.scene').nth(0), native = scene.locator('.legend-item[data-side="native"]');
  await bring(page, '[data-plot="waterfall"]');
  const of = () => scene.locator('[data-plot="waterfall"]').evaluate((p) => ({name: p.layout.annotations[0].text, picture: p.layout.images[0].source}));
  const first = await eventually(of);
  assert.equal(first.name, 'native');
  const others = ['rigid', 'coulomb', 'cone'].map((side) => scene.locator(`.legend-item[data-side="${side}"]`));
  await native.click();
  assert.equal((await of()).name, 'rigid');
  for (const button of others) await button.click();
  const last = await of();
  assert.equal(last.name, 'cone-coulomb');
  assert.notEqual(last.picture, first.picture);
  for (const button of [native, ...others]) await button.click();
  assert.deepEqual(await of(), first);
  await bring(page, '[data-plot="spectrum"]');
  const peaks = await scene.locator('[data-plot="spectrum"]').evaluate((p) => p.data.map((d) => [d.name, d.x[d.y.indexOf(Math.max(...d.y))]]));
  assert.deepEqual(peaks.map(([name]) => name).sort(), ['cone', 'cone-coulomb', 'cone-default', 'coulomb', 'native', 'rigid']);
  const spin = await page.evaluate(() => page.data.scenes[0].spin);
  for (const [name, at] of peaks) assert.ok(Math.abs(at - spin) < 0.3 * spin, `${name} whirls forward at ${at} Hz, the spin is ${spin} Hz`);
});

test('shows any two runs, to common scales', async () => {
  await bring(page, '.player');
  const selects = page.locator('.scene').nth(0).locator('.player select');
  await selects.nth(0).selectOption({label: 'coulomb'});
  await selects.nth(1).selectOption({label: 'native'});
  assert.deepEqual((await state(page)).runs, ['coulomb', 'native']);
  let compared = 0;
  for (let k = 0; k < 14; ++k) {
    await seek(page, 0.02 + 0.007 * k);
    const s = await state(page), arrows = s.sections.map((x) => x.arrows.find((a) => a.name === 'normal'));
    for (const [i, arrow] of arrows.entries()) {
      if (!arrow) continue;
      near(arrow.newtons, s.poses[i].normal, 1e-12);
      assert.equal(arrow.clipped, arrow.newtons > s.scales.force * (1 + 1e-9));
    }
    if (!arrows[0] || !arrows[1] || arrows[0].clipped || arrows[1].clipped) continue;
    near(arrows[0].pixels / arrows[0].newtons, arrows[1].pixels / arrows[1].newtons, 1e-9);
    ++compared;
  }
  assert.ok(compared > 2, `${compared} pairs of arrows`);
  assert.ok((await state(page)).sections[0].outline);
  await page.locator('.scene').nth(0).locator('.transport .outline').uncheck();
  assert.ok(!(await state(page)).sections[0].outline);
});

test('a bounce of 3 um is seen', async () => {
  const at = await page.evaluate(`(() => {
    const run = page.players[0].runs[0], gap = run.tracks.gap;
    for (let t = 0.001; t < 0.12; t += 1e-5) if (gap.at(t) > 2e-6 && gap.at(t) < 4e-6) return t;
    return null;
  })()`);
  await page.locator('.scene').nth(0).locator('.player select').nth(0).selectOption({label: 'native'});
  await seek(page, at);
  const {points, line} = (await state(page)).unrolled;
  const native = points.find((p) => p.run === 'native');
  assert.ok(native.gap > 2e-6 && native.gap < 4e-6);
  assert.ok(line - native.y > 40, `${line - native.y} px above the ring`);
});

test('scenes have clocks of their own', async () => {
  await seek(page, 0.03, 0);
  await seek(page, 0.11, 1);
  assert.deepEqual([(await state(page, 0)).time, (await state(page, 1)).time], [0.03, 0.11]);
  assert.ok((await state(page, 1)).poses[0].current, 'the second has magnets');
  assert.equal((await state(page, 0)).poses[0].current, null);
});

test('a plot that comes back to the screen is at the time of now', async () => {
  await bring(page, '.plot[data-plot="gap"]', 0);
  await page.waitForFunction(() => Number(document.querySelector('.plot[data-plot="gap"]').dataset.cursor) === page.players[0].clock.t);
  await bring(page, '.plots', 1);
  await seek(page, 0.077, 0);
  await bring(page, '.plot[data-plot="gap"]', 0);
  await page.waitForFunction(() => Number(document.querySelector('.plot[data-plot="gap"]').dataset.cursor) === 0.077);
  await eventually(async () => {
    for (const c of (await shownTimes(0)).cursors) near(c.t, 0.077, 1.5 * c.pixel);
  });
});
