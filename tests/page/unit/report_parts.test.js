// The parts of a report and of a run's page, from what page.cc writes.
import assert from 'node:assert/strict';
import {test} from 'node:test';
import {html, withCode} from '../../../compare/report/page/html.js';
import {reportParts} from '../../../compare/report/page/report_parts.js';
import {nearestCritical, runParts} from '../../../compare/report/page/run_parts.js';

const side = {label: 'native', status: 'ok', message: '', end: 0.06, engine: 'native', integrator: 'event', contact: 'rigid', step: 0, steps: 9, rows: 3, impacts_written: 1,
  tracks: {}, whirl: {}, distribution: [{}]};
const scene = {name: '<b>ring', hash: 'f00', step: 1e-5, end: 0.06, text: 'x = 1', contacts: [{name: ''}], windows: [{name: 'whole run'}],
  sides: [side, {...side, label: 'cone', engine: 'mujoco'}], what_if: null, rotor: {refusal: 'none'}, films: [], no_films: 'off.', setting: '',
  found: {twins: 2, differences: {cone: {impacts: [{native: {t: 0.01, normal_impulse: 2e-3}, other: null}]}}},
  parts: [
    {id: 'answer', parts: [{text: 'MuJoCo alone: no (gap: 0)', tone: 'bad', toned: 'no'}, {text: 'with the rigid law: yes', tone: 'good', toned: 'yes'},
      {columns: [{text: 'off by the step'}], rows: []}, {text: 'One.', mark: '>'}, {text: 'Two.'}]},
    {id: 'figures', parts: [{columns: [{text: 'figure'}, {text: 'cone'}, {text: 'what it means'}], rows: [
      {cells: ['force', {text: '2', beside: '+3 %', tone: 'bad'}, 'mean'], mark: '*'}, {cells: ['steps', '9', 'count']}]}]},
    {id: 'differences', parts: [{columns: [{text: 'figure'}], rows: [{cells: ['force']}, {cells: ['peak'], mark: '?'}]}, {text: 'never part'}]},
    {text: 'shadow: none'},
    {id: 'verdicts', parts: [{text: 'OUTSIDE cone is off', tone: 'bad', toned: 'OUTSIDE'}, {text: 'why', mark: '-'}, {text: 'within rigid agrees', tone: 'good', toned: 'within'}]}]};
const data = {scenes: [scene], mode: 'lockstep', tolerance: 0.01, trade: null, versions: {rotorub: '0.2', MuJoCo: '2.2'},
  benches: [], cases: [{text: 'all pass'}], sweeps: []};
const partsOf = (given) => {
  const parts = reportParts(given);
  return {parts, scene: parts.find(({id}) => id === 'scene-1').parts, of: (id) => parts.find((part) => part.id === id)};
};
const detailsOf = (parts, name) => parts.find(({id}) => id === `scene-1-${name}`);

test('the answer is one sentence with its tones, then the table, and the notes in one paragraph', () => {
  const [answer] = partsOf(data).of('verdicts').parts, [head, table, notes] = answer.parts;
  assert.match(head.markup.text, /<a href="#scene-1">&lt;b&gt;ring<\/a>/);
  const sentence = head.markup.text.match(/<p class="sentence">(.*?)<\/p>/)[1];
  assert.equal(sentence, '<b>MuJoCo alone</b>: <b class="bad">no</b> (gap: 0); <b>with the rigid law</b>: <b class="good">yes</b>.');
  assert.equal(table.class, 'cards-when-small');
  assert.match(notes.text, /^One\. Two\. Each column shows/);
});

test('judged figures stand with their differences, and all figures with their meanings', () => {
  const {scene: parts} = partsOf(data), judged = parts.find(({caption}) => /^The judged figures/.test(caption));
  assert.deepEqual(judged.columns.map(({text}) => text), ['figure', 'cone']);
  assert.deepEqual(judged.rows.map(({cells}) => cells), [['force', {text: '2', beside: '+3 %', tone: 'bad'}]]);
  assert.deepEqual(detailsOf(parts, 'figures').parts[0].rows.map(({cells}) => cells), [['force', '2', 'mean'], ['steps', '9', 'count']]);
  assert.ok(parts.some(({text}) => text === 'shadow: none'));
});

test('differences that cannot be split are folded', () => {
  const [, table, folded, note] = detailsOf(partsOf(data).scene, 'differences').parts;
  assert.deepEqual(table.rows.map(({cells}) => cells[0]), ['force']);
  assert.match(folded.details, /^1 difference that cannot/);
  assert.deepEqual(folded.parts[0].rows.map(({cells}) => cells[0]), ['peak']);
  assert.equal(note.text, 'never part');
});

test('without differences there is no section on where they come from', () => {
  const other = (parts) => ({...data, scenes: [{...scene, parts: scene.parts.map((part) => (part.id === 'differences' ? {id: 'differences', parts} : part))}]});
  assert.equal(detailsOf(partsOf(other([{columns: [{text: 'figure'}], rows: []}])).scene, 'differences'), undefined);
  assert.equal(detailsOf(partsOf(other([{text: 'nothing to split'}])).scene, 'differences'), undefined);
  const {parts} = detailsOf(partsOf(other([{columns: [{text: 'figure'}], rows: [{cells: ['peak'], mark: '?'}]}])).scene, 'differences');
  assert.equal(parts.length, 2, 'no empty table above those that cannot be split');
});

test('each verdict has its reasons', () => {
  const [{markup}] = partsOf(data).scene;
  assert.match(markup.text, /<details class="verdict later bad"><summary><h3><span class="mark">OUTSIDE<\/span> {2}cone is off<\/h3><\/summary>\s*<ul><li>why<\/li><\/ul>/);
  assert.match(markup.text, /<section class="verdict good"><h3><span class="mark">within<\/span> {2}rigid agrees<\/h3><\/section>/);
});

test('the first impacts of every run, and the conditions', () => {
  const {scene: parts} = partsOf(data), [table] = detailsOf(parts, 'impacts').parts;
  assert.deepEqual(table.columns.map(({text}) => text), ['#', 'native', 'cone']);
  assert.deepEqual(table.rows[0].cells, ['1', {text: '10.0000', beside: '2'}, '–']);
  const {facts} = detailsOf(parts, 'conditions').parts[0];
  assert.deepEqual(facts.slice(2, 6), [['scene hash', 'f00'], ['step', '10 µs'], ['tolerance', '1 %'],
    ['repeated runs', '2 of native, from starts a few units in the last place apart']]);
  assert.deepEqual(facts[7], ['cone', 'mujoco, integrator event, contact rigid, ok']);
});

test('results of other commands stand where there are any', () => {
  const idsOf = (given) => partsOf(given).parts.map(({id}) => id).filter(Boolean);
  assert.deepEqual(idsOf(data), ['verdicts', 'scene-1', 'cases', 'glossary']);
  const sweeps = [{name: 'ring', answer: ['No contact.']}], benches = [{scene: 'whip', machine: 'here', reference: {source: 'itself'}, engines: [], series: [], points: []}];
  assert.deepEqual(idsOf({...data, sweeps, benches}).slice(2), ['cases', 'maps', 'precision', 'glossary']);
  const {of} = partsOf({...data, sweeps, benches});
  assert.deepEqual(of('maps').parts, [{heading: 'ring'}, {text: 'No contact.'}, {maps: 0}]);
  assert.deepEqual(of('precision').parts.slice(0, 2), [{heading: 'whip'}, {text: 'Measured on here; reference: itself.'}]);
});

test('a resync has its onsets in the place of the judged figures', () => {
  const parts = [...scene.parts.filter(({id}) => id !== 'differences'), {id: 'resync', parts: [{rows: [], columns: []}]}];
  const resync = partsOf({...data, mode: 'resync', scenes: [{...scene, parts}]});
  assert.ok(resync.scene.some((part) => part.parts?.[0].heading === 'Contact by contact'));
  assert.ok(!resync.scene.some(({caption}) => /^The judged/.test(caption)));
  assert.equal(detailsOf(resync.scene, 'differences'), undefined);
  assert.match(resync.parts[1].markup.text, /sums of impulse and duration/);
});

test('the page of one run has its engine, its end and its facts', () => {
  const told = [{text: 'rubs: yes, from 5 ms'}, {text: 'warning: the step is long'}, {columns: [{text: 'figure'}, {text: 'value'}], rows: []}];
  const summary = {first_touch: 0.005, mean_force: 12, contact_fraction: 0.5, peak_impulse: 2e-3, hard_impacts: 1, settled: {attractor: 'bouncing'}};
  const one = {...scene, parts: told, found: summary, contacts: [{name: '', touches: true, clearance: 1e-3}], sides: [side]};
  const [answer, run, words] = runParts({scenes: [one], versions: data.versions});
  assert.match(answer.parts[0].markup.text, /<b>Does the rotor rub\?<\/b> Yes, from 5 ms\.<\/p>/);
  assert.deepEqual(answer.parts[1].cards.map(({headline}) => headline), ['5 ms', '12 N', '2 mN s', 'bouncing']);
  assert.equal(answer.parts[2].text, 'warning: the step is long');
  assert.equal(run.title, 'native, integrator event, contact rigid');
  assert.equal(run.conditions, '60 ms simulated');
  const early = {...one, sides: [{...side, status: 'penetration', message: 'the step is too long', end: 0.0125}]};
  const [, ended] = runParts({scenes: [early], versions: data.versions});
  assert.deepEqual([ended.conditions, ended.tone], ['ended at 12.5 ms of 60 ms: penetration, the step is too long', 'bad']);
  assert.deepEqual(run.parts.find(({id}) => id === 'run-conditions').parts[0].facts.map(([name]) => name), ['rotorub', 'scene hash', 'run', 'steps', 'rows', 'rows in impacts.csv']);
  assert.equal(words.id, 'glossary');
});

test('the margin is to the nearest critical speed, and a rotor without whirl has none', () => {
  assert.deepEqual(nearestCritical({campbell: {running: 1000, critical: [400, 1250]}}), {speed: 1250, share: 0.25, above: true});
  assert.equal(nearestCritical({refusal: 'none'}), null);
});

test('a value in markup is escaped, markup is not, and nothing is left out', () => {
  assert.equal(html`<i title="${'"<'}">${[html`<b>${'&'}</b>`, 0, null, false, undefined]}</i>`.text, '<i title="&quot;&lt;"><b>&amp;</b>0</i>');
});

test('words between backticks are code, and a single backtick is itself', () => {
  assert.equal(html`${withCode('run `rotorub tune <a>` now')}`.text, 'run <code>rotorub tune &lt;a&gt;</code> now');
  assert.deepEqual(withCode('a ` b'), ['a ` b']);
});
