// The player's clock without a browser: where it stands, what slows it down, what its keys do.
import assert from 'node:assert/strict';
import {beforeEach, test} from 'node:test';
import {Clock} from '../../../compare/report/page/player/clock.js';

let clock, shown, frames;
beforeEach(() => {
  shown = [];
  frames = [];
  globalThis.requestAnimationFrame = (frame) => frames.push(frame);
  clock = new Clock(0, 2, (t) => shown.push(t), () => {});
  clock.hard = [0.5, 0.6, 1.5];
});
const press = (key, more = {}) => clock.key({key, preventDefault: () => {}, ...more});

test('stays within the run', () => {
  clock.seek(-1);
  clock.seek(7);
  assert.deepEqual(shown, [0, 2]);
});

test('is ten times slower within a twentieth of a second of film of an impact, and at full pace beyond a fifth', () => {
  clock.pace = 0.1;
  assert.ok(Math.abs(clock.paceAt(0.5) - 0.01) < 1e-12);
  assert.ok(Math.abs(clock.paceAt(0.5 + 0.05 * 0.1) - 0.01) < 1e-12);
  assert.equal(clock.paceAt(0.6 + 0.2 * 0.1 + 1e-9), 0.1);
  assert.equal(clock.paceAt(0.5 - 0.2 * 0.1 - 1e-9), 0.1);
  const between = clock.paceAt(0.6 + 0.1 * 0.1);
  assert.ok(between > 0.01 && between < 0.1);
  clock.slowing = false;
  assert.equal(clock.paceAt(0.5), 0.1);
  clock.hard = [];
  clock.slowing = true;
  assert.equal(clock.paceAt(0.5), 0.1, 'no impact at all');
});

test('goes to the impacts in turn, and not beyond them', () => {
  for (const key of ['PageDown', 'PageDown', 'PageDown', 'PageDown', 'PageUp', 'Home', 'PageUp', 'End']) press(key);
  assert.deepEqual(shown, [0.5, 0.6, 1.5, 0.6, 0, 2]);
});

test('steps by a frame of film, ten with shift; keys with control are the browser\'s', () => {
  press('ArrowRight');
  press('ArrowRight', {shiftKey: true});
  press('ArrowLeft');
  press('End', {ctrlKey: true});
  assert.deepEqual(shown.map((t) => Math.round(t * 25)), [1, 11, 10]);
});

test('plays at its pace, does not make up for what it missed, ends at the end and begins again', () => {
  clock.hard = [];
  clock.play();
  const at = (now) => frames.pop()(now);
  at(1000);
  at(1040);
  assert.ok(Math.abs(clock.t - 0.04) < 1e-12);
  at(9000);
  assert.ok(Math.abs(clock.t - 0.14) < 1e-12, 'a page in the background had no frames');
  clock.seek(1.99);
  at(9040);
  assert.equal(clock.t, 2);
  assert.ok(!clock.playing && frames.length === 0);
  clock.play();
  assert.equal(clock.t, 0);
});
