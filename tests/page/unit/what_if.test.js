// What sliders say, as --set takes it, without a browser.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {changesOf, commandOf} from '../../../compare/report/page/what_if.js';

test('only what was moved is changed, with what goes along, in the slider’s unit', () => {
  const sliders = [{key: 'contact.friction', also: [], unit: ''}, {key: 'contact.clearance', also: [], unit: 'mm'},
    {key: 'rotor.speed', also: ['drive.speed', 'force[0].frequency'], unit: 'rpm'}];
  assert.deepEqual(changesOf(sliders, []), []);
  const changes = changesOf(sliders, [0, undefined, 3100]);
  assert.deepEqual(changes, ['contact.friction=0', 'rotor.speed=3100 rpm', 'drive.speed=3100 rpm', 'force[0].frequency=3100 rpm']);
  assert.equal(commandOf(changes.slice(0, 2)), ' --set "contact.friction=0" --set "rotor.speed=3100 rpm"');
});
