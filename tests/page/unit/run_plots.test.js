// Which plots a scene's runs have.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {runPlots} from '../../../compare/report/page/run_plots.js';

const strikes = {t: [1, 2, 3]};
const side = (label, tracks, more = {}) => ({label, tracks: Object.fromEntries(tracks.map((name) => [name, {knots: 9}])), impacts: [strikes, strikes],
  whirl: {spectrum: {}, waterfall: {}, poincare: null}, ...more});
const contact = (name, more = {}) => ({name, touches: true, rubs: true, ...more});
const keysOf = (plots) => plots.map(({key}) => key);

test('a plot stands where a run has its data', () => {
  const scene = {contacts: [contact('')], sides: [side('native', ['rotor', 'gap', 'normal', 'torsion'])]};
  const keys = keysOf(runPlots(scene));
  for (const key of ['gap', 'friction_law', 'torsion', 'force_spread', 'spectrum', 'orbit']) assert.ok(keys.includes(key), key);
  for (const key of ['current', 'motor', 'residual', 'poincare', 'sample_force', 'measured_minus']) assert.ok(!keys.includes(key), key);
  const two = keysOf(runPlots({...scene, sides: [...scene.sides, side('cone', ['rotor', 'current', 'motor_torque', 'force'])]}));
  assert.ok(!two.includes('motor'), 'a machine without a motor');
  for (const key of ['current', 'actuator', 'residual', 'sample_force']) assert.ok(two.includes(key), key);
  assert.ok(keysOf(runPlots({...scene, motor: {x: [], y: []}, sides: [side('native', ['motor_torque'])]})).includes('motor'));
});

test('a constant and two impacts are no plot, and only the scenes of the paper have its figures', () => {
  const still = {...side('native', ['rotor', 'gap', 'gap_rate', 'spin_speed']), impacts: [{t: [1, 2]}]};
  still.tracks.spin_speed.knots = 2;
  const plots = runPlots({name: 'ring', contacts: [contact('')], sides: [still]});
  assert.deepEqual(keysOf(plots).filter((key) => /spin|impacts|law|normal_force/.test(key)), []);
  const textOf = (name) => runPlots({name, contacts: [contact('')], sides: [still]}).find(({key}) => key === 'gap_rate').text;
  assert.deepEqual([textOf('ring'), textOf('paper_sliding')].map((text) => text.includes('paper')), [false, true]);
});

test('without contact or friction there is no plot of it, without rows none at all', () => {
  const sides = [side('native', ['rotor'])];
  const free = keysOf(runPlots({contacts: [contact('', {touches: false, rubs: false})], sides}));
  assert.deepEqual(free.filter((key) => /gap|force|impact|law|relative/.test(key)), []);
  const smooth = keysOf(runPlots({contacts: [contact('', {rubs: false})], sides}));
  assert.ok(smooth.includes('normal_law') && !smooth.includes('friction_law'));
  assert.deepEqual(runPlots({contacts: [contact('')], sides: [side('native', [])]}), []);
});

test('a measured record adds plots, and decides on no other', () => {
  const sides = [side('native', ['rotor']), side('measured', ['rotor', 'torsion'], {measured: true})];
  const keys = keysOf(runPlots({contacts: [contact('')], sides}));
  assert.ok(keys.includes('measured_minus') && !keys.includes('torsion') && !keys.includes('residual'));
});

test('with several contacts each has its plots, and the run has its own once', () => {
  const plots = runPlots({contacts: [contact('drive end'), contact('free end')], sides: [side('native', ['rotor', 'spin_speed', 'gap', 'contact2_gap', 'contact2_rotor', 'contact2_control'])]});
  const places = (of) => plots.filter(({key}) => key === of).map(({contact: number, place}) => [number, place?.name]);
  for (const key of ['gap', 'impacts', 'relative']) assert.deepEqual(places(key), [[0, 'drive end'], [1, 'free end']], key);
  assert.deepEqual(places('spin'), [[0, undefined]]);
  assert.deepEqual(places('control'), [[1, 'free end']]);
});
