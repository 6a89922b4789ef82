// The pages of maps: of a sweep, of lasting rubs, of branches of periodic rubs, and of feedback that stabilises rubs.
import {answerOf, scenesText, sheetsOf} from './answer.js';
import {shownUnit} from './linear_maps.js';
import {short} from './style.js';

const note = (text) => ({text});

const numbered = (columns, first) => columns.map((text, k) => ({text, ...(k >= first ? {number: true} : {})}));

// The rows of statistics.csv as a table.
export function statisticsParts(statistics) {
  if (!statistics) return [];
  const {keys, confidence, rows} = statistics, percent = (share) => `${short(100 * share)} %`;
  const cellsOf = ({group, figure, unit, statistic, estimate, points}) => {
    const {name, perSi} = shownUnit(unit), words = statistic.startsWith('share ') ? percent : (value) => short(perSi * value, 4);
    return [...group, figure + (name && ` / ${name}`), statistic, ...estimate.map((value) => (value === null ? '' : words(value))), String(points)];
  };
  const hasBounds = rows.some(({estimate: [, low, high]}) => low !== null || high !== null);
  return [{heading: 'Statistics'}, {columns: numbered([...keys, 'figure', 'statistic', 'value', 'from', 'to', 'points'], keys.length + 2),
    rows: rows.map((row) => ({cells: cellsOf(row)}))}, note(`${hasBounds ? `The value lies between from and to with a confidence of ${percent(confidence)}, if the points ` +
    'are independent.' : 'Bounds need independent points, as kind = "random" draws them.'} The table is in statistics.csv.`)];
}

// The points that failed, by their reason.
const listed = 50;
export const failedParts = (failed) => (failed.length ? [{heading: 'Points that failed'},
  {columns: ['points', 'first', 'status', 'reason'].map((text, k) => ({text, ...(k < 2 ? {number: true} : {})})),
    rows: failed.slice(0, listed).map(({points, first, status, reason}) => ({cells: [String(points), String(first), status, reason]}))},
  note(`${failed.length > listed ? 'The first fifty reasons; results.csv' : 'results.csv'} has all points.`)] : []);

export function sweepParts({page, maps: [{every, figures}], linear_refused: refused, bifurcation, statistics, failed, texts: [study, scene]}) {
  const tables = [...statisticsParts(statistics), ...failedParts(failed)];
  return [answerOf(page.parts),
    ...(every > 1 ? [note(`Only one in ${every} points is drawn; results.csv has all of them.`)] : []),
    ...(bifurcation ? [{class: 'plots', parts: [{plots: 'bifurcation'}]}] : []),
    {maps: 0}, note('Click a point, or enter its number, to see how to rerun it.'),
    ...(figures.some(({linear}) => linear) ? [note('Linear: the lasting rubs that exist, and whether they are stable by their eigenvalues, ' +
      'without any run. The spin is held, and each load acts for ever.')] : []),
    ...(refused ? [note(`Linear map: ${refused}.`)] : []),
    sheetsOf([...tables.map((part) => (part.rows ? {...part, class: 'cards-when-small'} : part)), {figures: 0}, {summary: 'The study', pre: study}, {summary: 'The scene', pre: scene}])];
}

const mapParts = (cards, lead, {page, texts: [scene]}) => [{cards}, {lead}, {maps: 0}, sheetsOf([...page.parts, {figures: 0}, scenesText(scene)])];

export function rubMapParts(data) {
  const [{keys, columns: [attractors]}] = data.maps;
  const card = (title, text, isSo) => ({title, headline: `${short(100 * attractors.filter(isSo).length / attractors.length)} %`, text});
  const has = (state) => (word) => word?.split(' + ').includes(state);
  return mapParts([
    card('Synchronous rub stable', 'The rotor slides round in step with its load.', has('synchronous rub')),
    card('Backward whip stable', 'The rotor slides round against the spin.', has('backward whip')),
    card('Rolling possible', 'Once there, the rotor rolls round against the spin, and the contact force is high.', has('rolling')),
    card('Nothing stable but rolling', 'A rotor that does not roll keeps bouncing.', (word) => word === 'none stable' || word === 'rolling')],
  `Steady rubs of rotor and ring over ${keys.map(({name}) => name).join(' and ')}, each judged by the eigenvalues of its small perturbations ` +
    'with contact kept. The spin is held, and where it changes each load keeps its ratio to it. Where several are stable, the start decides; ' +
    'where only rolling is, a rotor that does not roll bounces. A stable rub may still be out of reach: these maps know nothing of impacts.', data);
}

export const branchesParts = ({page, branches: {across}, texts: [scene]}) => [
  {lead: `Motions of rotor and ring that repeat, with all impacts, slip and sticking, followed over ${across.key} by continuation. ` +
    'Each is a solution of the event-driven model up to round-off. Runs settle only to stable ones.'},
  {class: 'plots', parts: [{plots: 'branches'}]}, sheetsOf([...page.parts, scenesText(scene)])];

export function feedbackMapParts(data) {
  const [{keys: [speeds, feedbacks], columns: [growth]}] = data.maps, each = feedbacks.values.length, all = speeds.values.length;
  const count = (isSo) => `at ${speeds.values.filter((_, k) => isSo(growth.slice(k * each, (k + 1) * each))).length} of ${all} speeds`;
  const calm = (value) => value !== null && value < 0;
  return mapParts([
    {title: 'Some k makes the forced rub stable', headline: count((row) => row.some(calm)),
      ...(speeds.values.some((_, k) => !growth.slice(k * each, (k + 1) * each).some(calm)) ?
        {text: 'At the other speeds no such rub lasts, or no k stabilises it.'} : {text: ''})},
    ...(feedbacks.values[0] === 0 ? [{title: 'It is stable without feedback', headline: count(([first]) => calm(first)),
      text: 'There feedback only makes it decay faster.'}] : [])],
  'The forced rub of the scene\'s friction with the force u = -k e_z x q\' on the ring, q\' the ring\'s velocity, in its closed loop, over spin ' +
    'speed and k: judged by the eigenvalues of its small perturbations with contact kept. The rule is the k under which it decays fastest.', data);
}
