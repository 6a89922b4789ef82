// The maps of linear analyses as maps.js takes them, from the SI values of compare/modes/rub_map_text.h.

import {hz} from './factors.js';

// People read speeds in Hz.
export const shownUnit = (unit) => (unit === 'rad/s' ? {name: 'Hz', perSi: hz} : {name: unit, perSi: 1});

// A figure of a map: a word, or a value in `si`; signed: its colours part at 0.
const figure = (key, name, si, meaning, more = {}) => ({key, name, si, meaning, word: false, linear: true, signed: false, ...more});

const rubFigures = [
  figure('attractors', 'attractors', '', 'what is stable by its eigenvalues, and so may coexist', {word: true}),
  figure('rub_growth', 'rub, growth rate', '1/s', 'synchronous rub, of its least stable pair: below 0 it is stable', {signed: true}),
  figure('rub_frequency', 'rub, frequency', 'rad/s', 'synchronous rub, of that pair, seen from the turning frame'),
  figure('rub_force', 'rub, normal force', 'N', 'synchronous rub'),
  figure('whip_growth', 'whip, growth rate', '1/s', 'backward whip that slips, load left out: below 0 it is stable', {signed: true}),
  figure('whip_whirl', 'whip, whirl', 'rad/s', 'backward whip, its speed'),
  figure('whip_force', 'whip, normal force', 'N', 'backward whip'),
  figure('rolling_force', 'rolling, normal force', 'N', 'backward rolling at the spin\'s pace, load left out'),
  figure('free_orbit', 'free orbit', '', 'of the clearance, without contact'),
].map((one) => ({...one, name: `linear: ${one.name}`}));

const feedbackFigures = [
  figure('growth', 'rub, growth rate', '1/s', 'of its least stable pair: below 0 it is stable', {signed: true}),
  figure('normal_force', 'rub, normal force', 'N', 'of the forced rub'),
  figure('frequency', 'rub, frequency', 'rad/s', 'of that pair, seen from the turning frame'),
  figure('beside', 'beside it', '', 'what is stable beside the forced rub: the start decides', {word: true}),
];

// Figures without their keys, and their columns as people read them.
const shownFigures = (figures, columns) => ({
  figures: figures.map(({key, si, ...words}) => ({...words, unit: shownUnit(si).name})),
  columns: figures.map(({key, si}) => columns[key].map((value) => (typeof value === 'number' ? shownUnit(si).perSi * value : value)))});

const names = {'rotor.speed': 'spin speed', 'contact.friction': 'friction'};
function keyOf({key, unit, values}) {
  const {name, perSi} = shownUnit(unit);
  return {name: names[key] ?? key, unit: name, even: true, log: false, values: values.map((value) => perSi * value)};
}

// A grid, whose second key varies fastest.
export const rubMap = ({across, up, columns}) => ({kind: 'grid', keys: [across, up].map(keyOf), ...shownFigures(rubFigures, columns)});

export function feedbackMap({speeds, feedbacks, growth, normal_force, frequency, whip}) {
  const columns = {growth: growth.flat(), normal_force: normal_force.flat(), frequency: frequency.flat(),
    beside: whip.flat().map((is) => (is ? 'whip or rolling' : 'nothing'))};
  return {kind: 'grid', keys: [keyOf({key: 'rotor.speed', unit: 'rad/s', values: speeds}), keyOf({key: 'feedback k', unit: 'N s/m', values: feedbacks})],
    ...shownFigures(feedbackFigures, columns)};
}

// A sweep's map with the lasting rubs at its points, if it has them, behind the figures of its runs.
export function withRubs({linear, ...map}) {
  if (!linear) return map;
  const {figures, columns} = shownFigures(rubFigures, linear);
  return {...map, figures: [...map.figures, ...figures], columns: [...map.columns, ...columns]};
}
