// The plots of rotor dynamics without a browser: Bode and polar, decrement, orbits' sense and mark, run-ups, distributions.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {partsOf, places, rankLines} from '../../../compare/report/page/bifurcation.js';
import {beyondText, dampingScale, decrement, stretches} from '../../../compare/report/page/campbell.js';
import {lookAt, senseLines, senseWord, sweptSense} from '../../../compare/report/page/orbits.js';
import {Run} from '../../../compare/report/page/player/run.js';
import {alongCurve, letteredPeaks, placeOf, shownFirst} from '../../../compare/report/page/response.js';
import {amplitudes, between, withinTurn} from '../../../compare/report/page/runup.js';
import {exceedance, histogram, impulsesOf, measuredMinus, staircase, widthFor} from '../../../compare/report/page/spread.js';
import {tradeOf} from '../../../compare/report/page/trade.js';
import {inView, pathPoint} from '../../../compare/report/page/whirl_shapes.js';

const near = (a, b, words) => assert.ok(Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(b)), `${words}: ${a} is not ${b}`);
const turn = 2 * Math.PI;

test('the decrement is the logarithm of one swing over the next', () => {
  for (const zeta of [0.001, 0.05, 0.4, -0.02]) {
    // x = e^{-zeta w t} cos(w sqrt(1 - zeta^2) t), a period later.
    const period = turn / Math.sqrt(1 - zeta ** 2);
    near(decrement(100 * zeta), Math.log(1 / Math.exp(-zeta * period)), `${zeta}`);
  }
  assert.equal(decrement(100), null, 'it swings no more');
  assert.equal(decrement(0), 0);
});

test('a Campbell diagram is coloured by damping where it differs, and what grows or does not swing has no colour', () => {
  const piece = (sense, ...damping) => ({sense, damping});
  assert.equal(dampingScale([piece('forward', 1, 1), piece('backward', 1.001), piece('overdamped', 100), piece('forward', -5)]), null);
  const even = dampingScale([piece('forward', 0, 1), piece('backward', 2), piece('rigid', 400)]);
  assert.deepEqual([even.low, even.high, even.level(0), even.level(1), even.level(2), even.level(-1)], [0, 2, 0, 4, 7, 0]);
  const wide = dampingScale([piece('forward', 0.01, 10)]);
  assert.deepEqual([wide.log, wide.level(0.011), wide.level(0.4), wide.level(10)], [true, 0, 4, 7]);
  const {level} = even, curve = {speed: [0, 1, 2, 3, 4], damping: [0, 0, 2, 2, 0.1]};
  assert.deepEqual(stretches(curve, level), [{level: 0, places: [0, 1]}, {level: 4, places: [1, 2, null, 3, 4]}, {level: 7, places: [2, 3]}]);
});

test('the words say what lies beyond the diagram', () => {
  assert.equal(beyondText({top: 100, critical: [50], threshold: null}), '');
  assert.equal(beyondText({top: 100, critical: [50, 150.4, 200], threshold: 300}),
    'Beyond the diagram: 2 critical speeds, 150, 200 rpm. The threshold of stability, 300 rpm, lies beyond the diagram.');
});

test('a whirl shape in space turns with the spin if it is forward', () => {
  const turns = (sense, roundness) => Math.sign([0, 0.1].map((angle) => pathPoint({sense, roundness}, 2, angle)).reduce(([a, b], [c, d]) => a * d - b * c));
  assert.deepEqual([turns('forward', 1), turns('backward', 1), turns('backward', 0.2)], [1, -1, -1]);
  assert.ok(Math.abs(pathPoint({sense: 'forward', roundness: 0.5}, 2, Math.PI / 2)[1] - 1) < 1e-12);
  const [from, to] = [0, 1].map((z) => inView(z, 0, 0)[0]);
  assert.deepEqual([from, to], [0, 1], 'the shaft is one long');
});

// Half-axes a, b of an ellipse that goes round so often.
const ellipse = (a, b, sense, count = 200) => Array.from({length: count + 1}, (_, k) =>
  [3 + a * Math.cos(sense * turn * k / count), -1 + b * Math.sin(sense * turn * k / count)]);

test('an orbit goes with the spin or against it', () => {
  near(sweptSense(ellipse(5, 5, 1)), 1, 'a circle');
  near(sweptSense(ellipse(5, 0.1, -2)), -1, 'a thin ellipse, backward');
  near(sweptSense(ellipse(5, 0, 1)), 0, 'a line');
  const eight = Array.from({length: 401}, (_, k) => [Math.sin(turn * k / 400), Math.sin(2 * turn * k / 400)]);
  assert.ok(Math.abs(sweptSense(eight)) < 1e-9, 'a figure of eight goes either way');
  assert.deepEqual([[1, 50], [-1, 50], [1, -50], [-1, -50], [0.5, 50], [0.05, 50], [1, 0], [-1, 0]].map(([sense, spin]) => senseWord(sense, spin)),
    ['forward', 'backward', 'backward', 'forward', 'mostly forward', 'to and fro', 'from x to y', 'from y to x']);
});

test('of the senses of many runs those are named that differ', () => {
  const texts = (words) => senseLines(new Map(Object.entries(words))).map(({text}) => text);
  assert.deepEqual(texts({native: 'forward'}), ['native: forward']);
  assert.deepEqual(texts({native: 'forward', rigid: 'forward', cone: 'forward'}), ['all: forward']);
  assert.deepEqual(texts({native: 'forward', rigid: 'forward', cone: 'to and fro'}), ['cone: to and fro', '2 others: forward']);
  assert.deepEqual(texts({native: 'forward', cone: 'backward'}), ['cone: backward', 'native: forward']);
  assert.deepEqual(texts({}), []);
});

test('of many turns the last ones are looked at, closely enough for every passing of the mark', () => {
  const {from, to, steps} = lookAt(0, 10, 0.01);
  near(from, 10 - 0.24, 'from');
  assert.ok((to - from) / steps < 0.01 / 30);
  assert.deepEqual(lookAt(2, 3, 0), {from: 2, to: 3, steps: 400}, 'a rotor at rest');
});

// A track that is given by a function.
const track = (at, rate = () => 0) => ({at, rate, knots: 2, time: (k) => 10 * k, instants: (from, to) => [from, 0.5 * (from + to), to]});
const noImpacts = {t: [], normal: [], friction: [], before: [], after: [], slip: []};
const runOf = (tracks) => new Run({label: 'native', status: 'ok', impacts: [noImpacts]}, {clearance: 1e-3, gap_tolerance: 1e-9, ring_moves: false}, 0, tracks);

test('the mark of a 1x orbit stays where it is, that of 2x at 1x in one place, of 1/2x in two', () => {
  const orbit = (order) => runOf({spin: track((t) => turn * 5 * t), rotor: track((t, c) => [Math.cos, Math.sin][c](order * turn * 5 * t))});
  for (const [order, places] of [[1, 1], [2, 1], [0.5, 2]]) {
    const run = orbit(order), times = run.pulses(0.05, 2.05, 400);
    assert.equal(times.length, 10);
    times.forEach((t, k) => { near(t, 0.2 * (k + 1), 'when'); });
    const seen = new Set(times.map((t) => run.pair('rotor', t).map((x) => x.toFixed(6).replace('-0.000000', '0.000000')).join()));
    assert.equal(seen.size, places, `${order}×`);
  }
});

test('a polar plot has the mark to the right, and lags downwards', () => {
  const [x, y] = placeOf(2, -90);
  near(x + 1, 1, 'x');
  near(y, -2, 'y');
  assert.deepEqual(placeOf(null, 0), [null, null]);
  // A half circle in uneven steps: letters at even ways along it.
  const places = Array.from({length: 1001}, (_, k) => { const a = Math.PI * (k / 1000) ** 3; return [Math.cos(a), Math.sin(a)]; });
  const angles = alongCurve(places, 4).map((k) => Math.PI * (k / 1000) ** 3);
  angles.forEach((a, k) => { assert.ok(Math.abs(a - Math.PI * (k + 1) / 4) < 0.01, `${a}`); });
});

test('of peaks beside each other the highest is lettered, and none that is critically damped', () => {
  const peak = (speed, amplitude, factor = 10) => ({speed, amplitude, phase: 0, factor});
  const curve = (name, ...peaks) => ({name, plane: '', peaks});
  const curves = [curve('disc 1', peak(1000, 5), peak(3000, 1)), curve('contact', peak(1001, 7), peak(5000, 9, 2), peak(6000, 9, null))];
  assert.deepEqual(letteredPeaks(curves, 7000).map(({speed, curve: {name}}) => [speed, name]), [[1001, 'contact'], [3000, 'disc 1']]);
});

test('of many stations the contacts are shown first, and those that move most', () => {
  const curve = (name, most, plane = '') => ({name, plane, amplitude: [null, most, 0]});
  const few = [curve('bearing 1', 1), curve('disc 1', 9, 'x'), curve('disc 1', 9, 'y'), curve('contact', 2, 'x')];
  assert.deepEqual([...shownFirst(few)].map(({name, plane}) => name + plane), ['contactx', 'disc 1x']);
  const many = [...Array.from({length: 8}, (_, k) => curve(`disc ${k}`, k)), curve('contact a', 0), curve('contact b', 0)];
  assert.deepEqual([...shownFirst(many)].map(({name}) => name), ['contact a', 'contact b', 'disc 7', 'disc 6', 'disc 5']);
  const held = [...many, curve('magnetic bearing 1', 9), curve('sensor 1', 0)];
  assert.deepEqual([...shownFirst(held)].map(({name}) => name), ['contact a', 'contact b', 'sensor 1', 'magnetic bearing 1', 'disc 7']);
  assert.ok([...shownFirst(held.filter(({name}) => name !== 'sensor 1'))].some(({name}) => name === 'magnetic bearing 1'), 'it sees there');
});

test('cells of a cascade are amplitudes again', () => {
  const c = {levels: String.fromCharCode(0, 255, 0, 51), columns: 2, low: -2, high: 2};
  assert.deepEqual(amplitudes(c, 0).map(Math.round), [0, 1e8]);
  near(1e-6 * amplitudes(c, 1)[1], 10 ** (-2 + 0.2 * 4), 'a fifth of four decades');
});

test('between points of a run-up the cursor goes straight', () => {
  assert.deepEqual([-1, 0, 0.5, 1.5, 9].map((t) => between([0, 1, 2], [10, 20, 0], t)), [10, 10, 15, 10, 0]);
});

test('phases within a turn are open where they would jump, and where nothing moves', () => {
  assert.deepEqual(withinTurn([0, -180, -269, -271, -300, -450], [1, 1, 1, 1, 1, 1], 0), [0, -180, -269, null, 60, -90]);
  assert.deepEqual(withinTurn([0, -10, 90.5], [1, 0.001, 1], 0.01), [0, null, null]);
});

test('a histogram is the time between two values', () => {
  assert.deepEqual(histogram([0, 1, 2], [0, 0, 8], 4), {width: 2, share: [0.125, 0.125, 0.125, 0.125]});
  assert.deepEqual(histogram([0, 1], [5, 5], 4).share, [0, 0, 0, 1]);
  assert.equal(histogram([0, 1], [0, 0]), null);
  // Of a sine the time above 0 between two values is that of the arc sine.
  const t = Array.from({length: 20001}, (_, k) => k * 1e-4 * Math.PI), {share} = histogram(t, t.map((at) => (Math.sin(at) > 1e-12 ? Math.sin(at) : 0)), 10);
  share.forEach((part, k) => {
    const exact = (Math.asin(Math.min(1, (k + 1) / 10)) - Math.asin(k / 10)) / Math.PI;
    assert.ok(Math.abs(part - exact) < 2e-5, `${part} is not ${exact}`);
  });
});

test('so many impacts reach a value, and of many the law stays', () => {
  assert.deepEqual(exceedance([3, 1, 2, 2]), {value: [3, 2, 2, 1], count: [1, 2, 3, 4]});
  assert.deepEqual(exceedance([]), {value: [], count: []});
  const {value, count} = exceedance(Array.from({length: 10000}, (_, k) => 1 / Math.sqrt(10000 - k)), 60);
  assert.ok(count.length >= 40 && count.length <= 61 && count[0] === 1 && count[count.length - 1] === 10000, `${count}`);
  for (const [k, one] of value.entries()) near(one, 1 / Math.sqrt(count[k]), 'value');
});

test('a rub of a soft contact is no impact', () => {
  const held = (times, values) => ({knots: times.length, time: (k) => times[k], values: [values]});
  const tracks = {impacts: held([0.1, 0.5], [1, 1e-3]), normal: held([0, 0.1, 0.1001, 0.2, 0.2001, 0.5, 0.5001, 0.5002], [0, 0, 10, 10, 0, 0, 10, 0])};
  assert.deepEqual(impulsesOf({tracks, longestImpact: 2e-3}), [1e-3]);
  assert.deepEqual(impulsesOf({tracks, longestImpact: Infinity}), [1, 1e-3]);
  assert.deepEqual(impulsesOf({tracks: {}}), []);
});

test('what control trades is of the end of the run', () => {
  const rotor = {instants: () => [0.9, 1], length: (t) => (t === 0.9 ? 5e-3 : 1e-3)};
  const [point] = tradeOf([{scene: {name: 'one', summary: {settled: {from: 0.8}, mean_force: 7, control_force: null}}, runs: [{end: 1, tracks: {rotor}}]}]);
  assert.deepEqual(point, {name: 'one', orbit: 5, contact: 7, actuator: 0});
});

test('a histogram is drawn as stairs', () => {
  assert.deepEqual(staircase({width: 2, share: [5, 1]}), {x: [0, 0, 2, 2, 4, 4], y: [0, 5, 5, 1, 1, 0]});
});

test('a force that goes far beyond those of the first two runs does not flatten them', () => {
  const side = (label, reach) => ({label, stairs: {width: reach / 2, share: [1, 1]}});
  assert.deepEqual(widthFor([side('cone', 2000), side('coulomb', 250), side('rigid', 110), side('native', 100)]),
    {range: [0, 250], beyond: [{label: 'cone', most: 2000}]});
  assert.deepEqual(widthFor([side('rigid', 110), side('native', 100)]), {beyond: []});
  assert.deepEqual(widthFor([{label: 'native', stairs: null}]), {beyond: []});
});

test('a bifurcation diagram has every place of every value', () => {
  const drawn = places([{value: 1, x: [5], period: 1}, {value: 2, x: [3, 4], period: 2}, {value: 3, x: [], period: 0}, {value: 4, x: [1], period: 0}]);
  assert.deepEqual([drawn.x, drawn.y], [[1, 2, 2, 4], [5, 3, 4, 1]]);
  assert.deepEqual(drawn.text, ['1: a turn', '2: 2 turns', '2: 2 turns', '4: no period up to 16 turns']);
});

test('the places of a branch are joined by their rank along x', () => {
  const lines = rankLines([{value: 1, x: [5, 3]}, {value: 2, x: [4, 6]}, {value: 3, x: []}]);
  assert.deepEqual(lines, [[{x: 1, y: 3}, {x: 2, y: 4}], [{x: 1, y: 5}, {x: 2, y: 6}]]);
  assert.deepEqual(rankLines([{value: 1, x: []}]), []);
});

test('the stable and unstable parts of a branch touch each other', () => {
  const stable = {stable: true}, points = [stable, {stable: true}, {stable: false}, {stable: false}, {stable: true}];
  const parts = partsOf(points);
  assert.deepEqual(parts.map((part) => part.stable), [true, false, true]);
  assert.deepEqual(parts.map((part) => part.points.map((point) => points.indexOf(point))), [[0, 1], [1, 2, 3], [3, 4]]);
});

test('measured minus run is at the samples of the record, where both are', () => {
  const record = runOf({rotor: track((t) => 2e-6 * t)}), run = runOf({rotor: track((t) => 1e-6 * t)});
  record.within = (t) => t > 1;
  const {t, y} = measuredMinus(record, run, [0, 4]);
  assert.deepEqual(t, [2, 4]);
  y.forEach((value, k) => { near(value, t[k], 'um'); });
});
