// Which plots a page has.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {whirlParts, withPlots} from '../../../compare/report/page/plot_words.js';
import {benchOf} from '../../../compare/report/page/precision.js';

const campbell = {top: 900, running: 600, critical: [], threshold: null};
const placesOf = ({plots}) => plots.map(({data}) => data);

test('a plot stands where its data is', () => {
  const scene = (...families) => ({engines: families.map(([family]) => ({engine: family, family})), series: families.map(([family]) => ({engine: family, setting: ''})),
    points: families.map(([family, limit]) => ({engine: family, setting: '', step: 1e-5, position_error: 1e-6, limit_error: limit, wall_ms: null, outcome: 'ok'}))});
  const [{plots}, text, {parts: [second]}] = withPlots([{plots: 'bench', index: 0}, {text: 'between'}, {parts: [{plots: 'bench', index: 1}]}],
    {benches: [scene(['mujoco', 1e-6]), scene(['native', 1e-6], ['mujoco', null])]});
  assert.deepEqual(placesOf({plots}), ['precision', 'step', 'limit'].map((plot) => ({of: 'bench', plot, index: 0})));
  assert.deepEqual(text, {text: 'between'});
  assert.deepEqual(placesOf(second), ['precision', 'step'].map((plot) => ({of: 'bench', plot, index: 1})));
});

test('a bench has the points of each series that have an error', () => {
  const at = {engine: 'event', wall_ms: {median: 3, low: 2, high: 4}, limit_error: null, outcome: 'ok'}, off = {...at, engine: 'rigid', setting: 'Euler'};
  const {series: [event, rigid]} = benchOf({clearance: 5e-4, engines: [{engine: 'event', family: 'native'}], series: [{engine: 'event', setting: '', order: null},
    {engine: 'rigid', setting: 'Euler', order: 1}], points: [{...at, step: null, setting: 'tolerance 1e-6', position_error: 1e-7},
    {...at, step: null, setting: 'tolerance 1e-8', position_error: 1e-9}, {...off, step: 1e-4, position_error: 7e-7}, {...off, step: 1e-3, position_error: null}]});
  assert.deepEqual(event.points.map(({label, error, ms, limit, step}) => [label, error, ms, limit, step]),
    [['tolerance 1e-6', 1e-7, 3, 0, 0], ['tolerance 1e-8', 1e-9, 3, 0, 0]], 'tolerances are one series');
  assert.deepEqual([rigid.points.map(({label}) => label), rigid.family, event.family, rigid.order], [['Euler, 100 µs'], 'peer', 'native', 1]);
});

test('of the free rotor those that its scene allows', () => {
  const rotor = {campbell, bode: null, shapes: null, stiffness: [{title: 'map', words: 'how'}]};
  const plotsOf = (shown) => withPlots([{plots: 'rotor'}], {rotor: shown})[0];
  assert.deepEqual(placesOf(plotsOf(rotor)), [{of: 'rotor', plot: 'campbell'}, {of: 'rotor', plot: 'damping'}, {of: 'rotor', plot: 'decrement'},
    {of: 'rotor', plot: 'stiffness', index: 0}]);
  const all = plotsOf({...rotor, bode: {forces: true, limit: null}, shapes: {}});
  assert.deepEqual(placesOf(all).map(({plot}) => plot), ['campbell', 'damping', 'decrement', 'bode', 'polar', 'stiffness', 'whirl_shapes', 'shapes']);
  const [bode] = all.plots.filter(({data}) => data.plot === 'bode');
  assert.match(bode.text, /count as the unbalance/);
  assert.doesNotMatch(bode.text, /API 617/);
});

test('the figures of a set of maps are a table', () => {
  const figures = [{name: 'force', unit: 'N', meaning: 'how hard'}];
  assert.deepEqual(withPlots([{figures: 0}, {maps: 0}], {maps: [{figures}]}), [{heading: 'Figures'},
    {class: 'cards-when-small', columns: [{text: 'name'}, {text: 'unit here'}, {text: 'meaning'}], rows: [{cells: ['force', 'N', 'how hard']}]}, {maps: 0}]);
});

test('a bifurcation diagram says how its values begin', () => {
  const [{plots}] = withPlots([{plots: 'bifurcation'}], {bifurcation: {note: 'Each value begins where the one before it ended.'}});
  assert.deepEqual(placesOf({plots}), [{of: 'bifurcation', plot: 'bifurcation'}]);
  assert.match(plots[0].text, /which is chaos\. Each value begins/);
});

test('a run says why it lacks a diagram or shapes', () => {
  assert.deepEqual(whirlParts({rotor: {refusal: 'no modes'}}), [{text: 'No Campbell diagram: no modes'}]);
  const [{plots}, note] = whirlParts({rotor: {campbell, bode: null, shapes: null}});
  assert.deepEqual(plots.map(({data}) => data), [{over: 'rotor', plot: 'campbell'}, {over: 'rotor', plot: 'decrement'}]);
  assert.match(note.text, /^No whirl shapes: the scene gives its modes/);
});
