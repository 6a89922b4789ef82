// The parts of the page of one run for layout.js, from what page.cc writes: the answer in a sentence and cards, the player
// and the plots, and folded below them the free rotor, all figures and the conditions.
import {hz} from './factors.js';
import {glossary} from './glossary.js';
import {html} from './html.js';
import {liveOf} from './live_frame.js';
import {units} from './player/units.js';
import {conditionsOf, engineOf, rotorOf} from './report_parts.js';
import {number, short} from './style.js';

const card = (title, headline, text, tone = '') => ({title, headline, text, tone});
const percent = (share) => `${short(100 * share)} %`;

// The critical speed next to the scene's speed; rpm.
export function nearestCritical({campbell}) {
  if (!campbell?.critical.length || !campbell.running) return null;
  const away = (speed) => Math.abs(speed - campbell.running);
  const speed = campbell.critical.reduce((best, one) => (away(one) < away(best) ? one : best));
  return {speed, share: away(speed) / campbell.running, above: speed > campbell.running};
}

// found: the run's summary.json, SI.
export function runCards({found: summary, contacts, rotor}) {
  const {first_touch: touch, settled, least_gap: gap, peak_impulse: impulse, peak_force: force, hard_impacts: hard,
    control_force: control} = summary;
  const touches = touch !== null && touch !== undefined, critical = nearestCritical(rotor);
  const counted = `${hard} hard impact${hard === 1 ? '' : 's'}`;
  const ofContact = !contacts[0].touches ? [] : touches ? [
    card('First touch', units.duration(Number(touch.toPrecision(4))), `in contact for ${percent(summary.contact_fraction)} of the time after it`),
    card('Mean normal force', units.force(summary.mean_force), 'from the first touch on, impacts included'),
    impulse > 0 ? card('Largest impact', units.impulse(impulse), counted) : card('Largest force', units.force(force ?? 0), counted),
  ] : [card('First touch', 'none', typeof gap !== 'number' ? 'in this run' : `smallest gap ${units.length(gap)}, ${percent(gap / contacts[0].clearance)} of the clearance`)];
  return [...ofContact,
    ...(control > 0 ? [card('Control force', units.force(control), 'root mean square over the whole run')] : []),
    card('Settles to', settled?.attractor ?? 'unknown', settled?.whirl_frequency ?
      `whirl at ${short(hz * settled.whirl_frequency)} Hz in the last fifth of the run` : 'in the last fifth of the run'),
    ...(critical ? [card('Margin to a critical speed', percent(critical.share),
      `the nearest is ${number(critical.speed, 4)} rpm, ${critical.above ? 'above' : 'below'} the scene's speed`)] : [])];
}

const upperFirst = (text) => text[0].toUpperCase() + text.slice(1);
const isRub = ({text}) => text?.startsWith('rubs: ');

const endingOf = ({status, message, end}, scene) => (status === 'ok' ? {conditions: `${units.duration(end)} simulated`} :
  {conditions: `ended at ${units.duration(end)} of ${units.duration(scene.end)}: ${[status, message].filter(Boolean).join(', ')}`, tone: 'bad'});

export function runParts({scenes: [scene], versions}) {
  const [side, shadow] = scene.sides, {parts} = scene, facts = [['rotorub', versions.rotorub], ['scene hash', scene.hash], ['run', engineOf(side)],
    ...(shadow ? [['shadow', engineOf(shadow)]] : []), ['steps', String(side.steps)], ...(side.step > 0 ? [['step', units.duration(side.step)]] : []),
    ['rows', String(side.rows)], ['rows in impacts.csv', String(side.impacts_written)]];
  const rub = parts.find(isRub), figures = parts.filter(({rows}) => rows), told = parts.filter(({text, mark}) => text && /^(warning|note): /.test(text) && !mark);
  const sentence = rub && html`<p class="sentence"><b>Does the rotor rub?</b> ${upperFirst(rub.text.slice('rubs: '.length))}.</p>`;
  return [{id: 'answer', class: 'run-answer', contents: 'Answer', parts: [...(sentence ? [{markup: sentence}] : []), {cards: runCards(scene)}, ...told]},
    {id: 'run', title: engineOf(side), ...endingOf(side, scene), scene: '0', parts: [
      {markup: liveOf(scene, 'run')}, rotorOf(scene, 'run'),
      {details: 'All figures', id: 'run-figures', contents: 'Figures', parts: figures}, conditionsOf(scene, 'run', facts)]}, glossary];
}
