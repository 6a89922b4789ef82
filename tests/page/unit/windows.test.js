// To which parts of a run the page zooms, and what it says of a record that is not a whole run.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {absentOf} from '../../../compare/report/page/player/run.js';
import {windowsOf} from '../../../compare/report/page/windows.js';

const of = (scene) => windowsOf({end: 1, speed: 20 * Math.PI, ...scene}).map(({name, from, to}) => [name, Number(from.toFixed(9)), Number(to.toFixed(9))]);

test('the whole run, from a tenth of a turn before the first touch to a turn after it, and the last two turns', () => {
  assert.deepEqual(of({sides: [{first_touch: 0.5}, {first_touch: 0.4}, {first_touch: null}, {}]}),
    [['whole run', 0, 1], ['first touch', 0.39, 0.5], ['last turns', 0.8, 1]]);
  assert.deepEqual(of({sides: [{first_touch: null}]}), [['whole run', 0, 1], ['last turns', 0.8, 1]], 'without a contact');
  assert.deepEqual(of({speed: 0, sides: []}).at(-1), ['last turns', 0.9, 1], 'a rotor at rest');
  assert.deepEqual(of({speed: -1, sides: []}).at(-1), ['last turns', 0, 1], 'a run shorter than a turn');
});

test('a record says what it lacks to be drawn', () => {
  const contact = {touches: true, ring_moves: true};
  assert.match(absentOf({ring: 1}, contact), /in the plots alone/);
  assert.match(absentOf({rotor: 1, ring: 1}, contact), /the angle of spin, gap, speed\.$/);
  assert.match(absentOf({rotor: 1}, {touches: false, ring_moves: false}), /the angle of spin, speed\.$/);
  assert.match(absentOf({rotor: 1, ring: 1, gap: 1, spin_speed: 1}, contact), /the angle of spin\.$/);
});
