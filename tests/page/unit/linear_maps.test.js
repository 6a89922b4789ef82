// Maps of lasting rubs and of feedback, and the branches' and searches' keys, in the units that people read.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {feedbackMap, rubMap, shownUnit, withRubs} from '../../../compare/report/page/linear_maps.js';
import {searchOf} from '../../../compare/report/page/optimum.js';
import {pointsOf} from '../../../compare/report/page/player/run.js';

const turn = 2 * Math.PI;
const columns = (more) => ({attractors: ['rolling', null], rub_growth: [-1, null], rub_frequency: [turn, null], rub_force: [5, null], whip_growth: [1, null],
  whip_whirl: [-2 * turn, null], whip_force: [6, null], rolling_force: [7, null], free_orbit: [0.5, null], ...more});

test('a map of rubs has its keys by their usual names and its speeds in Hz', () => {
  const {kind, keys: [across, up], figures, columns: shown} = rubMap({across: {key: 'rotor.speed', unit: 'rad/s', values: [turn, 2 * turn]},
    up: {key: 'stator.mass', unit: 'kg', values: [3]}, columns: columns()});
  assert.equal(kind, 'grid');
  assert.deepEqual([across.name, across.unit, across.values, up.name, up.unit], ['spin speed', 'Hz', [1, 2], 'stator.mass', 'kg']);
  assert.equal(figures.length, shown.length);
  assert.ok(figures.every(({linear, meaning}) => linear && meaning));
  const of = (name) => { const k = figures.findIndex((one) => one.name === name); return [figures[k].unit, ...shown[k]]; };
  assert.deepEqual(of('linear: attractors'), ['', 'rolling', null]);
  assert.deepEqual(of('linear: rub, frequency'), ['Hz', 1, null]);
  assert.deepEqual(of('linear: whip, whirl'), ['Hz', -2, null]);
  assert.deepEqual(figures.filter(({signed}) => signed).map(({name}) => name), ['linear: rub, growth rate', 'linear: whip, growth rate']);
});

test('a sweep has them behind the figures of its runs, or none', () => {
  const map = {figures: [{name: 'mean_force'}], columns: [[1, 2]], keys: []};
  assert.equal(withRubs(map).figures.length, 1);
  const both = withRubs({...map, linear: columns()});
  assert.deepEqual([both.figures[0].name, both.figures[1].name, both.columns.length, both.columns[1]], ['mean_force', 'linear: attractors', 10, ['rolling', null]]);
});

test('a map of feedback has a row for each speed, k fastest', () => {
  const map = feedbackMap({speeds: [turn, 2 * turn], feedbacks: [0, 100], growth: [[-1, 2], [null, 3]], frequency: [[turn, 0], [null, 0]],
    normal_force: [[5, 6], [null, 7]], whip: [[false, true], [false, false]]});
  assert.deepEqual(map.keys.map(({name, values}) => [name, values]), [['spin speed', [1, 2]], ['feedback k', [0, 100]]]);
  assert.deepEqual(map.figures.map(({name}) => name), ['rub, growth rate', 'rub, normal force', 'rub, frequency', 'beside it']);
  assert.deepEqual(map.columns, [[-1, 2, null, 3], [5, 6, null, 7], [1, 0, null, 0], ['nothing', 'whip or rolling', 'nothing', 'nothing']]);
});

test('people read speeds in Hz and all else in SI', () => {
  assert.deepEqual([shownUnit('rad/s').name, shownUnit('N/m')], ['Hz', {name: 'N/m', perSi: 1}]);
});

test('a search has a column for each key and each constraint', () => {
  const evaluation = (values, figure, status = 'ok') => ({values, figure, constraints: figure === null ? [] : [2 * figure], feasible: status === 'ok', status});
  const search = searchOf({figure: 'force', best: 0, keys: [{name: 'speed', unit: 'rad/s', range: [0, turn]}, {name: 'k', unit: 'N/m', range: [1, 9]}],
    constraints: [{name: 'gap', text: 'gap >= 1'}], evaluations: [evaluation([turn, 3], 5), evaluation([0, 4], null, 'refused')]});
  assert.deepEqual([search.keys[0].unit, search.keys[0].range, search.values], ['Hz', [0, 1], [[1, 0], [3, 4]]]);
  assert.deepEqual([search.column, search.constraints[0].values, search.feasible, search.status], [[5, null], [10, null], [true, false], ['ok', 'refused']]);
});

test('an impact is drawn with its share of what friction can transfer', () => {
  const one = {t: [1], normal: [2e-3], friction: [-6e-4], before: [-1], after: [0.5], slip: [0.1]};
  assert.deepEqual(pointsOf(one, 0.3), {t: [1], before: [-1], after: [0.5], slip: [0.1], normal: [2], friction: [0.6], share: [-1]});
  assert.deepEqual(pointsOf(one, 0).share, [0], 'without friction');
});
