// Packed tracks as the page reads them: the format of compare/report/pack/track.h, written here once more.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {tracksAt, runOf} from '../../../compare/report/page/player/run.js';
import {Track} from '../../../compare/report/page/player/tracks.js';

// A column: differences, zigzag, seven bits a byte, the lowest first.
function column(numbers) {
  const bytes = [];
  numbers.forEach((number, k) => {
    const difference = number - (k > 0 ? numbers[k - 1] : 0);
    let rest = difference < 0 ? -2 * difference - 1 : 2 * difference;
    for (; rest >= 128; rest = Math.floor(rest / 128)) bytes.push(128 + rest % 128);
    bytes.push(rest);
  });
  return bytes;
}
const packed = (kind, columns, more) => ({kind, floored: false, knots: columns[0].length, components: 1, start: 0, tick: 1e-3, quantum: 0.5,
  rate_quantum: 2, data: Buffer.from(columns.flatMap(column)).toString('base64'), ...more});
const track = (...of) => new Track(packed(...of));

test('reads the bytes of a known column', () => {
  // 300, 299, 0: differences 300, -1, -299; zigzag 600, 1, 597; 600 = 4 * 128 + 88.
  const bytes = [0, 2, 2, 0xd8, 0x04, 0x01, 0xd5, 0x04];
  const known = new Track({...packed('linear', [[0, 1, 2], [0, 0, 0]]), data: Buffer.from(bytes).toString('base64')});
  known.unpack();
  assert.deepEqual([...known.ticks], [0, 1, 2]);
  assert.deepEqual([...known.values[0]], [150, 149.5, 0]);
});

test('tells ticks apart beyond 2^31', () => {
  const late = track('hold', [[0, 2 ** 40, 2 ** 40 + 1], [1, 2, 3]], {tick: 1e-9});
  assert.equal(late.at(2 ** 40 * 1e-9), 1);
  assert.equal(late.at((2 ** 40 + 1) * 1e-9), 1.5);
});

test('is straight, held or cubic between its knots, and stays at its ends', () => {
  const line = track('linear', [[10, 20], [2, 4]], {start: 1});
  assert.deepEqual([0, 1.01, 1.015, 1.02, 9].map((t) => line.at(t)), [1, 1, 1.5, 2, 2]);
  assert.equal(track('hold', [[0, 10], [2, 4]]).at(0.009), 1);
  // y = t^3 at 0 and 1 s: the cubic itself.
  const cubic = track('hermite', [[0, 1000], [0, 2], [0, 3]], {rate_quantum: 1});
  for (const t of [0.1, 0.25, 0.5, 0.9]) {
    assert.ok(Math.abs(cubic.at(t) - t ** 3) < 1e-12, `at ${t}`);
  }
});

test('a floored track never dips below both ends and 0', () => {
  const columns = [[0, 1000], [2, 2], [-8, 8]];
  assert.ok(track('hermite', columns).at(0.5) < 0);
  const floored = track('hermite', columns, {floored: true});
  assert.equal(floored.at(0.5), 0);
});

test('instants miss no knot, and show the tick before a jump', () => {
  const bounces = track('linear', [[0, 100, 130, 900], [0, 1, 0, 1]]);
  const times = bounces.instants(0, 0.9, 4);
  for (const t of [0.1, 0.13]) assert.ok(times.some((x) => Math.abs(x - t) < 1e-9), `${t}`);
  assert.ok(bounces.instants(0, 0.9, 4, true).some((x) => Math.abs(x - 0.129) < 1e-9));
  assert.ok(times.every((t, k) => k === 0 || t > times[k - 1]));
});

test('no knots are 0 everywhere', () => assert.equal(track('hold', [[], []]).at(1), 0));

// A scene with two contacts: what the run has of each, and what it has once.
const contact = {clearance: 2, gap_tolerance: 1e-9, ring_moves: false};
const place = (x) => packed('linear', [[0, 1000], [2 * x, 2 * x], [0, 0]], {components: 2});
const flat = (y) => packed('hermite', [[0, 1000], [2 * y, 2 * y], [0, 0]]);
const noImpacts = {t: [], normal: [], friction: [], before: [], after: [], slip: []};
const side = () => ({label: 'native', status: 'ok', impacts: [noImpacts, noImpacts],
  tracks: {rotor: place(1), contact2_rotor: place(-1), gap: flat(1), contact2_gap: flat(1), contact2_normal: flat(7), spin: flat(3)}});

test('a run has its own places at each contact', () => {
  const run = runOf(side(), {contacts: [contact, contact]});
  assert.equal(run.contacts.length, 2);
  const [first, second] = run.contacts.map((at) => at.pose(0.5));
  assert.deepEqual([first.angle, second.angle], [0, Math.PI]);
  assert.deepEqual([first.normal, second.normal], [null, 7], 'a force of the second alone');
  assert.deepEqual([first.spin, second.spin], [3, 3], 'one shaft');
});

test('nothing of the first contact stands in for what the second has not', () => {
  const tracks = {rotor: 1, gap: 2, normal: 3, spin: 4, contact2_gap: 5, contact3_gap: 6};
  assert.equal(tracksAt(tracks, 0), tracks);
  const second = tracksAt(tracks, 1);
  assert.equal(second.gap, 5);
  assert.equal(second.spin, 4);
  assert.ok(!('normal' in second) && !('rotor' in second));
});

test('impacts are counted up to a time', () => {
  const impacts = packed('hold', [[100, 200, 200], [2, 4, 8], [0, 0, 0]], {components: 2});
  const run = runOf({...side(), tracks: {...side().tracks, impacts}}, {contacts: [contact]});
  assert.deepEqual([0.05, 0.1, 0.2, 1].map((t) => run.impactsUntil(t)), [0, 1, 3, 3]);
  assert.equal(run.largestImpulse, 4);
  assert.equal(run.hardImpacts.length, 3);
});
