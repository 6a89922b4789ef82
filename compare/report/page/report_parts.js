// The parts of a report for layout.js, from what page.cc writes.
import {milli} from './factors.js';
import {glossary} from './glossary.js';
import {html, withCode} from './html.js';
import {liveOf} from './live_frame.js';
import {units} from './player/units.js';
import {whirlParts, withPlots} from './plot_words.js';
import {short} from './style.js';

const text = (words) => ({text: words});
const percent = (share) => `${short(100 * share)} %`;

// ---------------------------------------------------------------- the answer

const bold = ({text: words, tone, toned}) => {
  const [question, ...rest] = words.split(': '), after = rest.join(': ').slice(toned.length);
  return html`<b>${question}</b>: <b class="${tone}">${toned}</b>${after}`;
};
const sentenceOf = (clauses) => html`<p class="sentence">${clauses.map((clause, k) => html`${k > 0 && '; '}${bold(clause)}`)}.</p>`;

const errorsWords = (columns) => (columns.some(({text: words}) => words.startsWith('off by')) ?
  'Each column shows the judged figure with the largest error of that kind, among those that converge as the step shrinks. The error of the ' +
  'contact model remains as the step goes to 0, the error of the step vanishes with it, and the bending modes left out change both sides.' : '');

function answerOf({name, setting}, index, {answer}) {
  const at = answer.findIndex(({rows}) => rows), table = answer[at];
  const notes = answer.slice(at + 1).map((part) => part.text);
  return {class: 'answer', parts: [
    {markup: html`<h2><a href="#scene-${index + 1}">${name}</a></h2>${sentenceOf(answer.slice(0, at))}
      <figure class="first"><figcaption></figcaption><div class="plot" data-of="first" data-index="${index}"></div></figure>`},
    {...table, caption: 'Each contact model, and why', class: 'cards-when-small'},
    text([...notes, errorsWords(table.columns)].join(' ')),
    ...(setting ? [{markup: html`<p class="setting"><b>Setting to use</b> ${withCode(setting)}</p>`}] : []),
  ]};
}

const lead = ({mode, tolerance}) => html`<p class="lead">The native model solves the scene's contact law: rigid (unilateral contact,
  Poisson's impact, Coulomb friction) or compliant. MuJoCo runs the same scene with each contact model that
  supports this law; <a href="#glossary">glossary</a>. <b>Averages only</b>: ${mode === 'resync' ?
    `the sums of impulse and duration over all contacts agree within ${percent(tolerance)}; single contacts do not.` :
    `the averages (forces, lasting contact, work, speeds) agree within ${percent(tolerance)}; a figure of single moments (largest impact or
  impulse, hard impacts, rms gap rate) does not. Repeated runs start a few units in the last place apart. If they
  scatter, a difference has a confidence interval; if the interval contains the tolerance, the figure is undecidable and does not count.`}</p>`;

const trade = {class: 'trade', id: 'trades', contents: 'What control trades', parts: [{markup: html`<h2>What control trades</h2>
  <p>The contact's mean normal force and the actuators' rms force over the run, over the size of the rotor's orbit at the end of the run, for the native
  run of each scene. A wider orbit allows a softer contact; a small orbit costs force.</p>
  <figure class="square"><figcaption><b>Forces</b> <span class="unit">N</span> over the orbit — dot: mean normal force of the contact;
  square: rms force of the actuators; a line joins the two of one scene</figcaption><div class="plot" data-of="trade" data-plot="trade"></div></figure>`}]};

// ---------------------------------------------------------------- one scene

// A toned sentence begins a verdict; the untoned ones after it are its reasons.
function verdictsOf(parts) {
  const verdicts = [];
  for (const part of parts) {
    if (part.tone) verdicts.push({...part, reasons: []}); else verdicts[verdicts.length - 1].reasons.push(part.text);
  }
  const headline = ({text: words, toned}) => html`<h3><span class="mark">${toned}</span> ${words.slice(toned.length)}</h3>`;
  return html`<div class="verdicts">${verdicts.map((verdict) => (verdict.reasons.length ? html`
    <details class="verdict later ${verdict.tone}"><summary>${headline(verdict)}</summary>
      <ul>${verdict.reasons.map((reason) => html`<li>${reason}</li>`)}</ul></details>` : html`
    <section class="verdict ${verdict.tone}">${headline(verdict)}</section>`))}</div>`;
}

const withoutDifference = (cell) => (cell.beside ? cell.text : cell);

// The judged figures with their differences from native, and all figures with what they mean.
const judgedOf = ({columns, rows}) => ({caption: 'The judged figures, and how far from native', class: 'key', columns: columns.slice(0, -1),
  rows: rows.filter(({mark}) => mark).map((row) => ({...row, cells: row.cells.slice(0, -1)}))});
const allOf = ({columns, rows}) => ({columns, class: 'all', rows: rows.map((row) => ({...row, cells: row.cells.map(withoutDifference)}))});

const resyncWords = 'An onset is the first impulse after a flight of at least 10 steps; its contact lasts until half-way through the next ' +
  'such flight. The worst onset of each figure is judged. Differences are shares: of the impulse of the contact, or of the largest impact where that is ' +
  'more; of the largest impulse; of the time until half-way through the next flight; of the fastest approach. The plots, and the figures of whole runs ' +
  'below, are of runs that each close their own loop: a chaotic motion may part for no fault of the contact.';

const splitWords = html`<p>Every difference is split in two. The <b>contact model</b>'s part remains when the step goes to 0 (Richardson extrapolation over
  dt, dt/2 and dt/4 on both sides); the <b>step</b>'s part vanishes with it. Figures that do not converge monotonically cannot be split, and
  are folded below.</p>`;
// Null without differences, as for a scene without contact.
function splitOf(parts) {
  const table = parts.find(({rows}) => rows?.length), notes = parts.filter(({rows}) => !rows);
  if (!table) return null;
  const isSplit = ({mark}) => !mark, [split, left] = [table.rows.filter(isSplit), table.rows.filter((row) => !isSplit(row))];
  const folded = {details: `${left.length} difference${left.length > 1 ? 's' : ''} that cannot be split between contact model and step`, class: 'folded',
    parts: [{...table, rows: left}]};
  return [{markup: splitWords}, ...(split.length ? [{...table, rows: split}] : []), ...(left.length ? [folded] : []), ...notes];
}

const ladderWords = html`<p>Both sides keep the same modes, so their agreement says nothing about the modes left out. The native model alone, with more and
  more of them: <b>converged</b>, the last changes are within the tolerance or the spread of repeated runs; <b>trend</b>, they shrink, and what
  is left beyond the last count is estimated; <b>no limit seen</b>, they do not.</p>`;

const measuredWords = 'Every run is taken at the record\'s samples, and a force is averaged over one, so that both see the same. The plots above show the ' +
  'measured run among the others, straight from sample to sample and open where the record is. Record less run: the rms about its mean, and ' +
  'its share of the run\'s deviation from its mean.';

const impactWords = 'With MuJoCo\'s soft contact an impact is an episode of contact: the time of its onset, and the impulse over the whole of it, ' +
  'lasting contact included.';
// Times, and below them impulses. differences: of each contact model, whose impacts are pairs with the native ones.
function impactsOf(differences, labels) {
  const impacts = Object.fromEntries(Object.entries(differences).map(([label, model]) => [label, model.impacts]));
  const count = Math.max(0, ...Object.values(impacts).map((pairs) => pairs.length));
  const native = impacts[labels[1]];
  const cellOf = (one) => (one ? {text: (milli * one.t).toFixed(4), beside: short(milli * one.normal_impulse, 4)} : '–');
  const at = (label, k) => (label === 'native' ? native?.[k]?.native : impacts[label]?.[k]?.other);
  return {caption: 'Time / ms, and below it impulse / mN s', class: 'impacts', columns: [{text: '#'}, ...labels.map((label) => ({text: label, number: true}))],
    rows: Array.from({length: count}, (_, k) => ({cells: [String(k + 1), ...labels.map((label) => cellOf(at(label, k)))]}))};
}

export const engineOf = ({engine, integrator, contact}) => `${engine}, integrator ${integrator}, contact ${contact}`;
export const conditionsOf = ({text: scene}, id, facts) => ({details: 'Conditions and the scene\'s text', id: `${id}-conditions`, contents: 'Conditions', parts: [
  {facts}, {markup: html`<pre>${scene}</pre>`}]});
export const rotorOf = (scene, id) => ({details: 'The free rotor: whirl', id: `${id}-rotor`, contents: 'Whirl', parts: whirlParts(scene)});

const filmsOf = ({films, no_films: why}) => (films.length ? html`<p class="note films">Films of the runs, beside this page:
  ${films.map(({link, caption}) => html`<a href="${link}" title="${caption}">${link}</a> `)}</p>` : html`<p class="note">No film: ${why}</p>`);

function sceneOf(scene, index, data, named) {
  const id = `scene-${index + 1}`, {verdicts, figures, resync, differences, modes, measured} = named;
  const runs = scene.sides.filter((side) => !side.measured), facts = [
    ...Object.entries(data.versions), ['scene hash', scene.hash], ['step', units.duration(scene.step)], ['tolerance', percent(data.tolerance)],
    ['repeated runs', `${scene.found.twins} of native, from starts a few units in the last place apart`],
    ...runs.map((side) => [side.label, `${engineOf(side)}, ${side.status}`])];
  const later = (name, contents, details, parts) => (parts ? [{details, id: `${id}-${name}`, contents, parts}] : []);
  const impacts = impactsOf(scene.found.differences, runs.map(({label}) => label));
  return {id, title: scene.name, contents: scene.name, scene: String(index),
    conditions: `step ${units.duration(scene.step)} · ${units.duration(scene.end)} simulated · scene ${scene.hash}`, parts: [
      {markup: verdictsOf(verdicts)},
      ...(resync ? [{parts: [{heading: 'Contact by contact'}, ...resync, text(resyncWords)]}] : [judgedOf(figures[0]), ...named.notes]),
      {markup: liveOf(scene, id)}, {markup: filmsOf(scene)}, rotorOf(scene, id),
      ...later('measured', 'Measured', 'The measured run', measured && [...measured, text(measuredWords)]),
      ...later('differences', 'Differences', 'Where the differences come from', differences && splitOf(differences)),
      ...later('modes', 'Modes kept', 'What the bending modes kept leave out', modes && [{markup: ladderWords}, ...modes]),
      ...later('figures', 'Figures', 'All figures', [allOf(figures[0])]),
      ...later('impacts', 'Impacts', 'The first impacts', impacts.rows.length && [impacts, text(impactWords)]),
      conditionsOf(scene, id, facts)]};
}

// ---------------------------------------------------------------- the pages

const besideWords = {precision: ['Speed against error', 'kept results of rotorub bench'],
  cases: ['Hard cases', 'kept results of rotorub check, against the rules in their files'], maps: ['Maps', 'kept results of rotorub sweep']};
const besideParts = ({benches, cases, sweeps}) => ({
  cases, maps: sweeps.flatMap(({name, answer}, index) => [{heading: name}, ...answer.map(text), {maps: index}]),
  precision: benches.flatMap(({scene, machine, reference: {source}}, index) =>
    [{heading: scene}, text(`Measured on ${machine}; reference: ${source}.`), {plots: 'bench', index}])});
const besideOf = (data) => ([id, parts]) => (parts.length ? [{class: 'beside', id, contents: besideWords[id][0], title: besideWords[id][0],
  conditions: besideWords[id][1], parts: withPlots(parts, data)}] : []);

// The parts of a comparison's result by their names; notes: those that belong to none.
const namedParts = ({parts}) => ({...Object.fromEntries(parts.filter(({id}) => id).map((part) => [part.id, part.parts])), notes: parts.filter(({id}) => !id)});

export function reportParts(data) {
  const named = data.scenes.map(namedParts);
  return [{class: 'answers', id: 'verdicts', contents: 'Answer', parts: data.scenes.map((scene, k) => answerOf(scene, k, named[k]))},
    {markup: lead(data)}, ...(data.scenes.length > 2 ? [trade] : []), ...data.scenes.map((scene, k) => sceneOf(scene, k, data, named[k])),
    ...Object.entries(besideParts(data)).flatMap(besideOf(data)), glossary];
}
