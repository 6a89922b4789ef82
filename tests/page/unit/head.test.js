// The head of every kind of page: what it is about, and the question that it answers.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {headOf} from '../../../compare/report/page/head.js';

const headingOf = (kind, more = {}) => headOf({page: {kind, names: 'ring'}, ...more}).heading;
const keys = [{name: 'rotor.speed'}, {name: 'contact.friction'}];

test('the heading of a study names its keys and its goal', () => {
  assert.equal(headingOf('sweep', {maps: [{keys}]}), 'What does ring do over rotor.speed and contact.friction?');
  const search = {keys, maximise: false, figure: 'mean_force'};
  assert.equal(headingOf('optimise', {search}), 'Which values of rotor.speed and contact.friction minimise mean_force?');
  assert.equal(headingOf('optimise', {search: {...search, maximise: true}}), 'Which values of rotor.speed and contact.friction maximise mean_force?');
});

test('a page of one run is headed by its scene, a report by its question, and its topic is how it compares', () => {
  assert.equal(headingOf('run'), 'ring');
  const {topic, note} = headOf({page: {kind: 'report', names: 'ring'}, mode: 'replay', versions: {MuJoCo: '2.2'}});
  assert.equal(topic, 'replay comparison');
  assert.match(note, /^MuJoCo 2\.2\. Assumptions/);
});

test('every command has a topic, a heading and a note', () => {
  for (const kind of ['bench', 'modes', 'rub_map', 'feedback_map', 'branches']) {
    const {topic, heading, note} = headOf({page: {kind, names: 'ring'}, hash: 'f00', theory: 'Timoshenko'});
    assert.ok(topic && heading.endsWith('?') && note.endsWith('.'), kind);
  }
});
