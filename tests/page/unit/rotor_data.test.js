// What the plots of the free rotor are made of: pieces of whirl, phases, shapes, maps and loops from SI values.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {amplitudesAndPhases, atSpeeds, curvesOf, loopsOf, piecesOf, responseOf, rotorOf, senseOf, stiffnessOf, through, whirlsOf} from
  '../../../compare/report/page/rotor_data.js';

const near = (a, b, words) => assert.ok(Math.abs(a - b) <= 1e-9 * Math.max(1, Math.abs(b)), `${words}: ${a} is not ${b}`);
const rpm = 30 / Math.PI, hz = 0.5 / Math.PI;

test('a whirl has a sense, relative to the spin', () => {
  assert.deepEqual([senseOf([5, 0], 1), senseOf([-5, 0], 1), senseOf([-5, 0], -1), senseOf([5, 0], 0), senseOf([0, 1], 1), senseOf([0, 0], 1)],
    ['forward', 'backward', 'forward', 'forward', 'overdamped', 'rigid']);
});

test('a branch is cut where its sense changes, and each piece starts at the last point of the one before', () => {
  const [first, second, ...rest] = piecesOf({speed: [0, 10, 20, 30], modes: [[-5, 1e-11], [-4, -0.01], [3, 0.02], [4, 0.02]]});
  assert.equal(rest.length, 0);
  assert.deepEqual([first.sense, first.frequency.map((f) => f / hz), first.damping], ['backward', [5, 4], [0, -1]], 'round-off is no damping');
  assert.deepEqual([second.sense, second.speed.map((n) => Math.round(n / rpm)), second.damping], ['forward', [10, 20, 30], [-1, 2, 2]]);
});

test('a phase continues beyond half a turn, past speeds without a steady motion', () => {
  const at = (degrees) => [1e-6 * Math.cos(degrees * Math.PI / 180), 1e-6 * Math.sin(degrees * Math.PI / 180)];
  const {amplitude, phase} = amplitudesAndPhases([at(-10), at(-170), [null, null], at(-200), at(-350)]);
  assert.equal(amplitude[2], null);
  near(amplitude[0], 1, 'µm');
  [-10, -170, null, -200, -350].forEach((expected, k) => { if (expected === null) assert.equal(phase[k], null); else near(phase[k], expected, 'degrees'); });
});

test('values between speeds lie on straight lines, and beyond the ends stay', () => {
  const values = [[0, 0], [2, 4], [null, null]], from = [10, 20, 30];
  assert.deepEqual(atSpeeds(values, from, [5, 10, 15, 20, 25, 35]), [[0, 0], [0, 0], [1, 2], [2, 4], [null, null], [null, null]]);
});

const probe = (name, deflection, peaks = []) => ({name, plane: '', deflection, peaks});
const response = {speed: [100, 200], forces: false, before: null, limit: null, contacts: [{name: 'a', clearance: 4e-4}, {name: 'b', clearance: 3e-4}],
  probes: [probe('disc', [[1e-6, 0], [0, -2e-6]], [{speed: 150, deflection: [0, -3e-6], amplification: 8, margin: 0.2}])]};

test('a response has amplitudes, phases, peaks and the contact that is touched first', () => {
  const bode = responseOf(response, -100);
  near(bode.running, 100 * rpm, 'rpm');
  assert.deepEqual([bode.clearance_of, Math.round(bode.clearance)], ['least clearance, at contact b', 300]);
  const [{amplitude, phase, peaks: [peak]}] = bode.curves;
  assert.deepEqual([amplitude.map(Math.round), phase.map(Math.round)], [[1, 2], [0, -90]]);
  assert.deepEqual([Math.round(peak.speed / rpm), Math.round(peak.amplitude), Math.round(peak.phase), peak.factor, peak.margin], [150, 3, -90, 8, 0.2]);
  assert.equal(responseOf({...response, contacts: [{name: '', clearance: 3e-4}]}, 1).clearance_of, 'clearance at the contact');
  assert.equal(responseOf({...response, contacts: []}, 1).clearance, null);
  assert.deepEqual(responseOf({...response, limit: [4e-6, 2e-6]}, 1).limit.map((one) => Math.round(10 * one)), [20, 10], 'half of peak to peak');
  assert.equal(responseOf(null, 1), null);
});

test('before and after the loss of a blade stand side by side at the same speeds', () => {
  const before = {speed: [100, 150, 200], probes: [probe('disc', [[1e-6, 0], [2e-6, 0], [3e-6, 0]])]};
  const {curves} = responseOf({...response, before}, 100);
  assert.deepEqual(curves.map(({name}) => name), ['disc, before the loss', 'disc, after the loss']);
  assert.deepEqual(curves[0].amplitude.map(Math.round), [1, 3]);
});

test('each sense counts its own whirls, of which the first are shown', () => {
  const shape = (frequency) => ({mode: [frequency, 0], roundness: 1, shape: [0, 1]});
  const shown = whirlsOf([-1, 1, -2, 2, -3, 3].map(shape), 100, 2);
  assert.deepEqual(shown.map(({sense, number}) => `${sense} ${number}`), ['backward 1', 'forward 1', 'backward 2', 'forward 2']);
});

test('a map has a curve for each critical speed, open where there is none', () => {
  assert.deepEqual(curvesOf([[1 / rpm], [1 / rpm, 3 / rpm], []]).map((curve) => curve.map((n) => n && Math.round(n))), [[1, 1, null], [null, 3, null]]);
  const map = stiffnessOf({of: 'ring', contact: 'left', stiffness: [1, 2], own: 1, critical: [[1], [1]], ring: [[2], [3]]});
  assert.deepEqual([map.title, map.of, map.ring.length], ['Critical speed map of the ring, left', 'stiffness of the ring\'s spring', 1]);
  assert.equal(stiffnessOf({of: 'bearings', contact: '', stiffness: [], own: 1, critical: [], ring: []}).title, 'Critical speed map');
});

const found = {critical_speeds: [90], stability_threshold: null, torsion: [{frequency: 6}], mode_shapes: null};
const rotor = {found, running: -100, top: 200, branches: [{speed: [0, 200], modes: [[5, 0], [6, 0]]}], operating: [[-5, 0.01]], whirl_shapes: [], shaft: null, response: null};

test('a rotor in modal form has a diagram alone', () => {
  const {campbell, shapes, bode, stiffness} = rotorOf(rotor);
  assert.deepEqual([shapes, bode, stiffness], [null, null, []]);
  near(campbell.running, 100 * rpm, 'rpm');
  near(campbell.torsion[0], 6 * hz, 'Hz');
  assert.deepEqual(campbell.operating.map(({sense, damping}) => [sense, damping]), [['forward', 1]], 'with a spin in the negative direction');
  assert.equal(campbell.threshold, null);
  near(rotorOf({...rotor, found: {...found, stability_threshold: 50}}).campbell.threshold, 50 * rpm, 'rpm');
  assert.deepEqual(rotorOf({refusal: 'no modes'}), {refusal: 'no modes'});
});

test('a shaft has mode shapes of one height, and discs as large as their inertia', () => {
  const modes = (frequency) => [{frequency, shape: [0.1, -0.5, 0.2]}], x = modes(10);
  const shapes = (same_planes) => rotorOf({...rotor, found: {...found, mode_shapes: {z: [0, 0.1, 0.2], stations: [{kind: 'disc', name: 'd', z: 0.1}], same_planes, x, y: modes(5)}},
    shaft: {sections: [{from: 0, to: 0.2, diameter: 0.01, end_diameter: 0.02}], discs: [{z: 0.1, mass: 2, Jp: 0.01}, {z: 0.1, mass: 2, Jp: 0}]}}).shapes;
  assert.deepEqual(shapes(true).modes.map(({plane, number, shape}) => [plane, number, shape]), [['x', 1, [0.2, -1, 0.4]]]);
  assert.deepEqual(shapes(false).modes.map(({plane}) => plane), ['x', 'y']);
  assert.deepEqual(shapes(true).discs.map(({radius}) => radius), [100, null]);
  assert.deepEqual(shapes(true).sections[0], {from: 0, to: 200, diameter: 10, end_diameter: 20});
});

test('a curve passes through its peak', () => {
  const curve = {x: [1, 3], y: [10, 20]};
  assert.deepEqual(through(curve, [2, 30]), {x: [1, 2, 3], y: [10, 30, 20]});
  assert.deepEqual(through(curve, [3, 20]), curve);
  assert.deepEqual(through(curve, [4, 5]), {x: [1, 3, 4], y: [10, 20, 5]});
});

test('a loop has its sensitivity in decibels, its step, and from when on it stays within its band', () => {
  const step = {largest: 2e-6, largest_at: 0.002, settling_time: 0.003, steady: 1e-6, overshoot: 1};
  const loops = [{bearing: 2, axis: 'y', sensitivity: 10, frequency: 20, step}], curves = [{sensitivity: [{x: [10, 30], y: [1, 1]}], step: [{x: [0, 0.004], y: [0, 1e-6]}]}];
  const [{title, sensitivity: [s], step: [y]}, ...rest] = loopsOf({speeds: [{speed: 1, levitation: null}, {speed: 314.159265, levitation: {loops, sample_time: 1e-4}}]}, curves);
  assert.equal(rest.length, 0);
  assert.equal(title, 'closed loop of the magnetic bearings at 314.159 rad/s, sampled every 0.0001 s');
  assert.deepEqual([s.name, s.y, s.peak[1]], ['bearing 2 y', [0, 20, 0], 20]);
  assert.deepEqual([y.t.map((t) => Math.round(t)), y.y.map((v) => Math.round(v)), y.steady], [[0, 2, 4], [0, 2, 1], 1]);
  near(y.settled[1], 1.02, 'the edge of the band, on the side of the curve');
  const [{step: [to]}] = loopsOf({speeds: [{speed: 1, levitation: {loops: [{...loops[0], step: {...step, steady: 0, overshoot: null}}], sample_time: 0}}]}, curves);
  near(to.settled[1], 0.04, 'of the peak where the deflection returns');
});
