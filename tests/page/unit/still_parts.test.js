// The pages of sweep, optimise, modes and bench: their answers, cards and tables.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {modesCards, peaksOf} from '../../../compare/report/page/modes_parts.js';
import {failedParts, statisticsParts} from '../../../compare/report/page/map_parts.js';
import {bestSoFar, searchMap} from '../../../compare/report/page/optimum.js';
import {stillParts} from '../../../compare/report/page/still_parts.js';

const found = [{text: 'Whip everywhere.'}, {text: 'All ran.'}];
const page = (kind, parts = found) => ({kind, parts});
const textsOf = (parts) => parts.map(({text}) => text).filter(Boolean);

test('a sweep begins with its answer, and explains what its maps have', () => {
  const data = {page: page('sweep'), maps: [{every: 1, figures: [{}]}], linear_refused: '', statistics: null, texts: ['study', 'scene'],
    failed: [{status: 'diverged', reason: '<b>nowhere</b>', points: 3, first: 7}]};
  const [answer, maps, hint, sheets] = stillParts(data);
  assert.match(answer.parts[0].markup.text, /class="sentence">Whip everywhere\.</);
  assert.deepEqual([textsOf(answer.parts), maps], [['All ran.'], {maps: 0}]);
  assert.match(hint.text, /^Click a point/);
  assert.deepEqual(sheets.parts.map((part) => Object.keys(part)[0]), ['heading', 'columns', 'text', 'figures', 'summary', 'summary']);
  assert.deepEqual(sheets.parts[1].rows, [{cells: ['3', '7', 'diverged', '<b>nowhere</b>']}]);
  const more = stillParts({...data, maps: [{every: 3, figures: [{linear: true}]}], linear_refused: 'no ring', bifurcation: {}});
  assert.deepEqual(textsOf(more).map((text) => text.split(/[:.]/)[0]), ['Only one in 3 points is drawn; results',
    'Click a point, or enter its number, to see how to rerun it', 'Linear', 'Linear map']);
  assert.ok(more.some(({parts}) => parts?.some(({plots}) => plots === 'bifurcation')));
});

test('of many reasons the first fifty are listed, and of none nothing', () => {
  const failed = Array.from({length: 51}, (_, k) => ({status: 'diverged', reason: `reason ${k}`, points: 1, first: k}));
  const [, {rows}, {text}] = failedParts(failed);
  assert.deepEqual([rows.length, text], [50, 'The first fifty reasons; results.csv has all points.']);
  assert.deepEqual(failedParts([]), []);
});

test('statistics are a table in the units of the page, with bounds or why there are none', () => {
  const row = (more) => ({group: ['0.2'], figure: 'mean_force', unit: 'N', statistic: 'mean', estimate: [12.3456, null, null], points: 9, ...more});
  const of = (...rows) => statisticsParts({keys: ['contact.restitution'], confidence: 0.9, rows});
  const [, {columns, rows}, {text}] = of(row({}), row({figure: 'whirl', unit: 'rad/s', estimate: [2 * Math.PI, Math.PI, 4 * Math.PI]}),
    row({figure: 'attractor', unit: '', statistic: 'share rolling', estimate: [0.25, 0.1234, 0.5]}));
  assert.deepEqual(columns.map(({text: words, number}) => words + (number ? ' #' : '')),
    ['contact.restitution', 'figure', 'statistic', 'value #', 'from #', 'to #', 'points #']);
  assert.deepEqual(rows.map(({cells}) => cells), [['0.2', 'mean_force / N', 'mean', '12.35', '', '', '9'], ['0.2', 'whirl / Hz', 'mean', '1', '0.5', '2', '9'],
    ['0.2', 'attractor', 'share rolling', '25 %', '12.3 %', '50 %', '9']]);
  assert.match(text, /with a confidence of 90 %, if the points are independent\. The table is in statistics\.csv\./);
  assert.match(of(row({}))[2].text, /^Bounds need independent points/);
  assert.deepEqual(statisticsParts(null), []);
});

test('the map of lasting rubs has the share of each rub', () => {
  const column = ['no contact + rolling', 'synchronous rub', 'none stable', null];
  const [{cards}, {lead}] = stillParts({page: page('rub_map', []), maps: [{keys: [{name: 'a'}, {name: 'b'}], columns: [column]}], texts: ['']});
  assert.deepEqual(cards.map(({headline}) => headline), ['25 %', '0 %', '25 %', '25 %']);
  assert.match(lead, /over a and b, /);
});

test('the map of feedback counts the speeds at which it calms the rub', () => {
  const cardsOf = (first) => stillParts({page: page('feedback_map', []), texts: [''],
    maps: [{keys: [{values: [1, 2]}, {values: [first, 5]}], columns: [[-1, 2, null, 3]]}]})[0].cards.map(({headline}) => headline);
  assert.deepEqual(cardsOf(0), ['at 1 of 2 speeds', 'at 1 of 2 speeds']);
  assert.equal(cardsOf(1).length, 1, 'nothing is known without feedback');
});

test('a bench judges the levels of the headline, and has plots and text with each scene', () => {
  const level = (share, native) => ({clearance_share: share, native_is_fastest: native});
  const cardOf = (...levels) => stillParts({page: page('bench', [{id: 'scenes-1', parts: [{text: 'x'}]}, {id: 'engines'}]), machine: {}, texts: ['toml'],
    benches: [{scene: 'ring', levels, verdict: 'Why.'}]});
  const [{cards: [card]}, , scene, engines] = cardOf(level(1e-2, true), level(1e-5, true), level(1e-6, false), level(1e-3, null));
  assert.deepEqual([card.tone, card.text, card.link, engines.id], ['good', 'Why.', '#scenes-1', 'engines']);
  assert.deepEqual(scene.parts, [{plots: 'bench', index: 0}, {text: 'x'}, {summary: 'The scene\'s text', pre: 'toml'}]);
  assert.equal(cardOf(level(1e-5, false))[0].cards[0].tone, 'bad');
  assert.equal(cardOf(level(1e-5, null))[0].cards[0].tone, 'part');
});

const rotor = {campbell: {running: 954.93, critical: [830.42, 2000]}};
const rub = {attractors: ['no contact', 'backward whip'], rubs: [{stable: true}, {stable: false}]};
const speed = {speed: 250, response: null, rub: null, notes: []};
const summary = {speeds: [speed], critical: [{whirl: 'forward'}], unstable_ranges: [], stability_bound: null, rub_refused: null};
const cardsOf = (more, other = rotor) => modesCards({...other, found: {...summary, ...more}});
const words = ({title, tone, headline, text}) => [title, tone || '', headline, text].join(' | ');

test('the page of modes says how stable the rotor is, and how near the scene is to a critical speed', () => {
  const [at, critical, free] = cardsOf({}).map(words);
  assert.equal(at, 'The scene\'s speed |  | 954.93 rpm | The nearest undamped critical speed is 830.42 rpm, 13 % below.');
  assert.match(critical, /830\.42 rpm, 2000 rpm \| undamped; forward/);
  assert.match(free, /good \| stable at all speeds/);
  const [running, , unstable] = cardsOf({unstable_ranges: [[86.96, null]], stability_bound: 100}).map(words);
  assert.match(running, /bad \| 954\.93 rpm, unstable/);
  assert.match(unstable, /bad \| unstable above 830\.41 rpm/);
  assert.match(words(cardsOf({unstable_ranges: [[0, null]]})[2]), /unstable at rest/);
  assert.match(words(cardsOf({stability_bound: 100})[2]), /stable up to 954\.93 rpm/);
  const rest = {campbell: {running: 0, critical: []}};
  assert.match(words(cardsOf({}, rest)[0]), /0 rpm \| There is no critical speed/);
});

test('the page of modes says whether the closed loop of magnetic bearings is stable', () => {
  const loop = (peak, zone) => ({sensitivity: peak, frequency: 113.7, zone});
  const withLoop = (levitation) => cardsOf({speeds: [{...speed, levitation: {poles_refused: null, ...levitation}}]});
  const grows = withLoop({poles: [{real: 16.26, imaginary: 153.46}], loops: [loop(null, null)]}).map(words);
  assert.match(grows[0], /bad \| 954\.93 rpm, unstable/);
  assert.equal(grows[2], 'Closed loop | bad | unstable at 2387.3 rpm | A motion at 24.4 Hz grows at 16.3 1/s.');
  assert.ok(!grows.some((text) => text.includes('stable at all speeds')));
  const stable = withLoop({poles: [{real: -2, imaginary: 0}], loops: [loop(1.5, 'A'), loop(2.57, 'A')]}).map(words);
  assert.equal(stable[2], 'Magnetic bearings | good | stable, zone A | largest sensitivity 2.57 (8.2 dB) at 18.1 Hz, ISO 14839-3');
  assert.equal(stable[3], 'Free whirl | good | stable at all speeds | without integrators, filters, amplifiers and sampling');
  const unknown = withLoop({poles: null, poles_refused: 'a library commands them', loops: []}).map(words);
  assert.equal(unknown[2], 'Closed loop |  | stability unknown | The poles are unknown, because a library commands them.');
  assert.ok(!unknown.some((text) => text.includes('stable at all speeds')));
});

test('and how near it comes to each contact, and what a touch may lead to', () => {
  const near = {orbit: 264e-6, least_gap: 236e-6, vibration: 0, vibration_limit: 25.4e-6, refused: null, before_loss: null};
  const far = {...near, orbit: 619e-6, least_gap: -19e-6, vibration: 30e-6};
  const contacts = [{name: 'near', response: near, rub: null, rub_refused: 'no ring'}, {name: 'far', response: far, rub, rub_refused: null}];
  const [, , , first, second, note, refused, touched] = cardsOf({speeds: [{...speed, contacts, notes: ['where its law is not linear']}]}).map(words);
  assert.equal(first, 'Free orbit at contact "near", 2387.3 rpm |  | least gap 236 µm | 264 µm from the middle of the ring, clearance 500 µm');
  assert.equal(second, 'Free orbit at contact "far", 2387.3 rpm | bad | touches, 19 µm beyond | 619 µm from the middle of the ring, clearance 600 µm; ' +
    'vibration 30 µm peak to peak, beyond the 25.4 µm of API 617');
  assert.match(note, /of limited validity \| where its law is not linear/);
  assert.equal(refused, 'Stable motions at contact "near" |  | not analysed | no ring');
  assert.equal(touched, 'Stable motions at contact "far" | bad | no contact + backward whip | at 2387.3 rpm; 1 further lasting rub is unstable');
  const both = contacts.map((contact) => ({...contact, rub: null, rub_refused: '/home/me/rig.toml:88: control.fails_at: it fails'}));
  assert.deepEqual(cardsOf({speeds: [{...speed, contacts: both, notes: []}]}).slice(5).map(words),
    ['Stable motions |  | not analysed | control.fails_at: it fails'], 'a reason that applies to all is given once, without the file');
  const lost = cardsOf({speeds: [{...speed, response: {...far, before_loss: near}}]}).slice(3).map(({title}) => title);
  assert.deepEqual(lost, ['Free orbit, before the loss, 2387.3 rpm', 'Free orbit, after the loss, 2387.3 rpm']);
});

test('the tables of lasting rubs stand in front, with their contacts', () => {
  const sheets = (...rubs) => stillParts({page: page('modes', [{heading: 'Whirl'}, {id: 'rubs', parts: rubs}]), rotor: {...rotor, found: summary, bode: null}, loops: [],
    texts: ['']}).filter((part) => part.class === 'sheets').map(({parts}) => parts.map((part) => part.heading || Object.keys(part)[0]));
  assert.deepEqual(sheets({heading: 'contact a, the others open'}, {heading: 'whirl of both'}, {rows: []}, {heading: 'lasting rubs at 1'}, {rows: []}, {heading: 'the same driven'}),
    [['contact a, the others open', 'lasting rubs at 1', 'rows', 'the same driven'], ['Whirl', 'contact a, the others open', 'whirl of both', 'rows', 'summary']]);
  assert.deepEqual(sheets({text: 'refused'}), [['Whirl', 'text', 'summary']]);
});

test('of peaks at nearly one speed the table has the largest', () => {
  const peak = (at, amplitude) => ({speed: at, amplitude, factor: 10, margin: 0.2});
  const bode = {running: 1000, curves: [{name: 'disc', plane: 'x', peaks: [peak(1000, 5), peak(3000, 1)]}, {name: 'contact', plane: '', peaks: [peak(1010, 7)]}]};
  assert.deepEqual(peaksOf(bode).map(({name, speed: at}) => [name, at]), [['contact', 1010], ['disc, x', 3000]]);
  assert.deepEqual(peaksOf(null), []);
});

const search = {figure: 'force', unit: 'N', maximise: false, best: 3, keys: [{name: 'k', unit: 'N/m', range: [1, 9]}], values: [[1, 2, 3, 4]], column: [9, 3, null, 5],
  constraints: [{name: 'gap', unit: 'm', text: 'gap >= 1', values: [1, 0, null, 2]}], feasible: [true, false, false, true], status: ['ok', 'ok', 'refused', 'ok']};

test('an optimisation shows its best values, and how they were found', () => {
  const parts = stillParts({page: page('optimise', [{text: '4 evaluations, converged'}, {text: 'force is least at 3.'}]), search, texts: ['toml']});
  assert.match(parts[0].parts[0].markup.text, /force is least at 3\./);
  assert.deepEqual(parts[1].parts[0].rows.map(({cells}) => cells), [['k', '4 N/m', 'from 1 to 9 N/m'], ['force', '5 N', 'minimised'], ['gap', '2 m', 'gap >= 1']]);
  assert.deepEqual(parts[2].parts, [{plots: 'convergence'}]);
  const none = stillParts({page: page('optimise', [{text: 'none'}]), search: {...search, best: null, column: [null, null, null, null]}, texts: ['']});
  assert.ok(!none.some(({parts: inner}) => inner?.some(({plots, caption}) => plots || caption)));
});

test('the best value so far is of scenes that meet the constraints', () => {
  assert.deepEqual(bestSoFar(search), [9, 9, 9, 5]);
  assert.deepEqual(bestSoFar({...search, feasible: [false, true, false, true], maximise: true}), [null, 3, 3, 5]);
  const map = searchMap(search);
  assert.deepEqual([map.status, map.statuses, map.figures.map(({name}) => name)], [[0, 0, 1, 0], ['ok', 'refused'], ['force', 'gap', 'evaluation']]);
  assert.deepEqual(map.columns, [[9, 3, null, 5], [1, 0, null, 2], [0, 1, 2, 3]]);
});
