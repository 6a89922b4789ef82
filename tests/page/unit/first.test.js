// The picture beneath the answer: which runs, and which part of the run.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {besideNative, impulseTrace, partingWindow} from '../../../compare/report/page/first.js';

const named = (...labels) => labels.map((label) => ({label}));

test('beside native stands MuJoCo alone, or the measured record', () => {
  assert.equal(besideNative(named('native', 'rigid', 'coulomb', 'cone')), 3);
  assert.equal(besideNative(named('native', 'rigid', 'cone', 'measured')), 3);
  assert.equal(besideNative(named('native', 'cone', 'measured'), ['cone']), 1);
  assert.equal(besideNative(named('native', 'rigid')), 1);
  assert.equal(besideNative(named('native')), 0);
});

// A run given by its gap and force over time.
const run = (gap, normal) => ({has: (name) => name === 'gap' || name === 'normal', value: (name, t) => (name === 'gap' ? gap(t) : normal(t))});
const whole = {from: 0, to: 1};
const native = run((t) => Math.max(0, 5e-4 * (1 - t / 0.2)), (t) => (t < 0.2 ? 0 : 100));

test('begins half a turn before the gaps part, and holds some turns', () => {
  const hops = run((t) => native.value('gap', t) + (t > 0.4 ? 1e-4 : 0), (t) => native.value('normal', t));
  const [from, to] = partingWindow(native, hops, whole, 5e-4, 100, 0.02);
  assert.ok(Math.abs(from - 0.39) < 1e-3, `${from}`);
  assert.ok(Math.abs(to - from - 0.07) < 1e-9, `${to}`);
  const late = run((t) => native.value('gap', t) + (t > 0.99 ? 1e-4 : 0), (t) => native.value('normal', t));
  assert.equal(partingWindow(native, late, whole, 5e-4, 100, 0.02)[1], 1);
});

test('where the gaps agree the forces decide', () => {
  const hard = run((t) => native.value('gap', t), (t) => (t > 0.7 ? 9000 : native.value('normal', t)));
  assert.ok(Math.abs(partingWindow(native, hard, whole, 5e-4, 100, 0.02)[0] - 0.69) < 1e-3);
});

test('two that agree, or never touch, have no picture', () => {
  assert.equal(partingWindow(native, native, whole, 5e-4, 100, 0.02), null);
  const free = run(() => 2e-4, () => 0), freer = run(() => 4e-4, () => 0);
  assert.equal(partingWindow(free, freer, whole, 5e-4, 0, 0.02), null);
});

test('every impact of the window is a stem of its impulse', () => {
  globalThis.document = {documentElement: {}};
  globalThis.getComputedStyle = () => ({getPropertyValue: () => '#123456'});
  const {x, y} = impulseTrace({label: 'native', points: {t: [0.1, 0.2, 0.3], normal: [4, 5, 6]}}, [0.15, 0.25]);
  assert.deepEqual([x, y], [[0.2, 0.2, null], [0, 5, null]]);
});
