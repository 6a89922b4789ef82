// What pictures and plots are made of, without a browser: scales, colours, figures with units, the unrolled gap.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {gapAt, unrolledScale} from '../../../compare/report/page/player/unrolled.js';
import {units} from '../../../compare/report/page/player/units.js';
import {colourScale, countUntil, gridPlaces, keyScale, logTicks, opened, openedCurve, thinned} from '../../../compare/report/page/scales.js';
import {scaleOfColours, shade} from '../../../compare/report/page/style.js';
import {heightFor} from '../../../compare/report/page/traces.js';

test('figures have three digits and the prefix that suits them', () => {
  assert.deepEqual([0, 1.2345e-3, 9.996e-4, -3e-6, 4.5e-10, 12].map(units.length), ['0 m', '1.23 mm', '1 mm', '−3 µm', '450 pm', '12 m']);
  assert.deepEqual([14050, 0.2].map(units.force), ['14.1 kN', '200 mN']);
  assert.equal(units.gap(4e-9, 1e-8), '0', 'finer than the page holds it');
  assert.equal(units.gap(-4e-6, 1e-8), '4 µm deep');
  assert.equal(units.rpm(100 * Math.PI), '3,000 rpm');
});

test('a colour scale goes from end to end, over decades by the logarithm', () => {
  const even = colourScale([1, 2, 3, null, 99], [0, 1, 2, 3], false);
  assert.ok(!even.log);
  assert.deepEqual(even.of(1), shade(0, even.palette));
  assert.deepEqual(even.of(3), shade(1, even.palette));
  const decades = colourScale([1, 10, 1000], [0, 1, 2], false);
  assert.ok(decades.log);
  assert.deepEqual(decades.of(10), shade(1 / 3, decades.palette));
  const signed = colourScale([-1, 4], [0, 1], true);
  assert.deepEqual(signed.of(0), [0xf7, 0xf7, 0xf7], '0 lies in the middle');
  assert.deepEqual(colourScale(['whip', 'rub', null], [0, 1], false).words, ['rub', 'whip']);
  assert.ok(colourScale([null], [0], false).of(0.5).every(Number.isFinite), 'nothing to show');
});

test('a palette is met at its colours and is even in between', () => {
  assert.deepEqual(shade(0.5, ['#000000', '#ff0000', '#ff00ff']), [255, 0, 0]);
  assert.deepEqual(shade(0.25, ['#000000', '#640000', '#ff00ff']), [50, 0, 0]);
  assert.deepEqual([shade(-1, ['#000000', '#ffffff']), shade(2, ['#000000', '#ffffff'])], [[0, 0, 0], [255, 255, 255]]);
  assert.deepEqual(scaleOfColours(['#000000', '#111111', '#222222']).map(([at]) => at), [0, 0.5, 1]);
});

test('even values of a key stand at themselves, others side by side under their names', () => {
  const even = keyScale({values: [10, 15, 20], even: true});
  assert.deepEqual([even.at(2), even.width, even.from, even.to], [20, 5, 7.5, 22.5]);
  const words = keyScale({values: ['a', 0.30000001, 'c'], even: false});
  assert.deepEqual(words.axis, {tickvals: [0, 1, 2], ticktext: ['a', '0.3', 'c']});
  assert.ok(keyScale({values: Array.from({length: 100}, (_, k) => k * k), even: false}).axis.tickvals.length <= 8);
});

test('in a grid the last key varies fastest', () => {
  assert.deepEqual(gridPlaces([{values: [1, 2, 3]}, {values: ['a', 'b']}]), [[0, 0, 1, 1, 2, 2], [0, 1, 0, 1, 0, 1]]);
  assert.deepEqual(gridPlaces([{values: [5, 6]}]), [[0, 1]]);
});

test('a logarithmic axis has a label at each decade, and between them if they are few', () => {
  assert.deepEqual(logTicks([60, 700, null]).ticktext, ['10', '20', '50', '100', '200', '500', '1,000', '2,000', '5,000']);
  assert.deepEqual(logTicks([1e-5, 2e-1, 0]).ticktext, [-5, -4, -3, -2, -1, 0].map((k) => `10<sup>${String(k).replace('-', '−')}</sup>`));
  assert.equal(logTicks([2e-5, 3e-5]).ticktext[1], '2·10<sup>−5</sup>');
  assert.deepEqual(logTicks([null]).tickvals, []);
});

test('counting until a value', () => {
  assert.deepEqual([0, 1, 1.5, 2, 3].map((v) => countUntil([1, 2, 2], v)), [0, 1, 1, 3, 3]);
  assert.equal(countUntil([], 1), 0);
});

test('a thinned line keeps its ends and every spike', () => {
  const t = Array.from({length: 10000}, (_, k) => k), y = t.map((k) => (k === 5003 ? 9 : k === 7001 ? -9 : Math.sin(k)));
  const line = thinned(t, y, 100);
  assert.ok(line.t.length <= 400);
  assert.ok(line.t.includes(0) && line.t.includes(9999) && line.t.includes(5003) && line.t.includes(7001));
  assert.ok(line.t.every((v, k) => k === 0 || v >= line.t[k - 1]), 'in order');
  assert.deepEqual(thinned([1, 2], [3, 4], 100), {t: [1, 2], y: [3, 4]});
});

// The value that a drawn line has at a time.
function drawnAt({t, y}, time) {
  const k = t.findIndex((v) => v >= time);
  return k === 0 || t[k] === time ? y[k] : y[k - 1] + (y[k] - y[k - 1]) * (time - t[k - 1]) / (t[k] - t[k - 1]);
}

test('a thinned line is at rest where the whole one is, however its samples lie', () => {
  // Nothing until a touch at 105 ms; then a knot at every step.
  const touched = Array.from({length: 40000}, (_, k) => k + 1), still = Array.from({length: 51}, (_, k) => k);
  const t = [...still.map((k) => 2.1e-3 * k), ...touched.map((k) => 0.105 + 1e-5 * k)];
  const y = [...still.map(() => 0), ...touched.map((k) => 1000 * (k % 3))];
  const line = thinned(t, y, 700);
  assert.ok(line.t.length <= 2800);
  for (const time of [0.02, 0.0979, 0.1, 0.1049, 0.105]) assert.equal(drawnAt(line, time), 0, `at ${time} s`);
  // A force that ends and stays away.
  const gone = thinned(t.map((time) => 0.505 - time).reverse(), [...y].reverse(), 700);
  for (const time of [0.4001, 0.41, 0.5]) assert.equal(drawnAt(gone, time), 0, `at ${time} s`);
  assert.equal(Math.max(...line.y), 2000);
});

test('a line is open where a record has no samples', () => {
  assert.deepEqual(opened({t: [0, 1, 2, 3], y: [5, 6, 7, 8]}, [[1, 3]]), {t: [0, 1, 2, 3], y: [5, 6, null, 8]});
  assert.deepEqual(opened({t: [0, 1], y: [5, 6]}), {t: [0, 1], y: [5, 6]});
});

test('a curve is open where a record has no samples', () => {
  assert.deepEqual(openedCurve([0, 1, 3, 4], [[1, 2], [3, 4], [5, 6], [7, 8]], [[1, 3]]), [[1, 2], [3, 4], [null, null], [5, 6], [7, 8]]);
  assert.deepEqual(openedCurve([0, 1], [[1, 2], [3, 4]], [[5, 6]]), [[1, 2], [3, 4]]);
  assert.deepEqual(openedCurve([0, 1], [[1, 2], [3, 4]]), [[1, 2], [3, 4]]);
});

test('the unrolled gap is that of two circles', () => {
  // Of radii 20 mm and 20.2 mm: the way from the rotor's surface to the ring's, along the ray from the ring's centre.
  const radius = 20e-3, clearance = 0.2e-3, pose = {gap: 3e-6, angle: 0.7}, delta = clearance - pose.gap;
  for (const theta of [0.7, 1.5, -2, 3]) {
    const phi = theta - pose.angle;
    const surface = delta * Math.cos(phi) + Math.sqrt(radius ** 2 - (delta * Math.sin(phi)) ** 2);
    assert.ok(Math.abs(gapAt(clearance, pose, theta) - (radius + clearance - surface)) < clearance ** 2 / radius, `${theta}`);
  }
  assert.ok(Math.abs(gapAt(clearance, pose, pose.angle) - pose.gap) < 1e-18, 'least where the rotor is');
});

test('the scale of the unrolled gap is logarithmic on both sides of contact', () => {
  const scale = unrolledScale({clearance: 0.5e-3, gap_tolerance: 30e-9}, 2e-6);
  assert.equal(scale.decades(0), 0);
  assert.equal(scale.decades(0.9 * scale.finest), 0, 'less is contact');
  assert.ok(Math.abs(scale.decades(1e-5) - 2) < 1e-12);
  assert.ok(Math.abs(scale.decades(-1e-6) + 1) < 1e-12);
  assert.ok(scale.deep && scale.decades(-2e-6) > -scale.below);
  assert.ok(scale.decades(2 * 0.5e-3) < scale.above);
  assert.ok(!unrolledScale({clearance: 0.5e-3, gap_tolerance: 30e-9}, 0).deep);
});

test('the first two runs set the height of a force plot, and another that leaves it says so', () => {
  globalThis.document = {};
  globalThis.getComputedStyle = () => ({getPropertyValue: () => '#123456'});
  const trace = (name, y) => ({name, y, line: {color: '#000000'}});
  const native = trace('native', [0, 100, null]), rigid = trace('rigid', [0, 90]);
  assert.deepEqual(heightFor([trace('cone', [0, 120]), rigid, native]), {});
  const {axis, notes} = heightFor([trace('cone', [0, 14050]), rigid, native]);
  assert.ok(axis.range[1] > 100 && axis.range[1] < 120);
  assert.equal(notes[0].text, 'cone reaches 14,100 N');
  const both = heightFor([trace('cone-default', [0, 149]), trace('coulomb', [0, 700]), rigid, native]).notes;
  assert.deepEqual(both.map(({text}) => text), ['cone-default reaches 149 N', 'coulomb reaches 700 N']);
});
