// The units and the ends of sliders, and what they say as --set takes it, without a browser.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {changesOf, commandOf, slidersOf} from '../../../compare/report/page/what_if.js';

test('only what was moved is changed, with what goes along, in the slider’s unit', () => {
  const sliders = [{key: 'contact.friction', also: [], unit: ''}, {key: 'contact.clearance', also: [], unit: 'mm'},
    {key: 'rotor.speed', also: ['drive.speed', 'force[0].frequency'], unit: 'rpm'}];
  assert.deepEqual(changesOf(sliders, []), []);
  const changes = changesOf(sliders, [0, undefined, 3100]);
  assert.deepEqual(changes, ['contact.friction=0', 'rotor.speed=3100 rpm', 'drive.speed=3100 rpm', 'force[0].frequency=3100 rpm']);
  assert.equal(commandOf(changes.slice(0, 2)), ' --set "contact.friction=0" --set "rotor.speed=3100 rpm"');
});

test('sliders have the units that people use, and the ends of the schema or twice the value', () => {
  const free = {low: null, low_open: false, high: null}, positive = {...free, low: 0, low_open: true};
  const of = (unit, value, range) => {
    const [slider] = slidersOf([{key: 'k', also: [], meaning: 'm', unit, value, ...range}]);
    return [slider.value, slider.unit, slider.low, slider.high];
  };
  assert.deepEqual(of('1', 0.3, {...positive, low_open: false}), [0.3, '', 0, 0.6]);
  assert.deepEqual(of('m', 0.5e-3, positive), [0.5, 'mm', 0.125, 1]);
  assert.deepEqual(of('m', 20e-6, {...positive, low_open: false}), [20, 'um', 0, 40]);
  assert.deepEqual(of('1', 0.5, {low: 0, low_open: false, high: 1}), [0.5, '', 0, 1]);
  assert.deepEqual(of('rad/s', 100 * Math.PI, free), [3000, 'rpm', 750, 6000]);
  assert.deepEqual(of('s', 8e-3, positive), [8, 'ms', 2, 16]);
  assert.deepEqual(of('N', -10, free), [-10, 'N', -20, -2.5], 'the lower end is on the left');
});
