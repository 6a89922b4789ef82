// The page of `rotorub modes`: the answers from its JSON, plots, tables.
import {scenesText, sheetsOf} from './answer.js';
import {rpmText} from './campbell.js';
import {hz, micro, rpm} from './factors.js';
import {short} from './style.js';

const microns = (length, digits = 4) => `${short(micro * length, digits)} µm`;

function speedCard({campbell: {running, critical}}, isUnstable) {
  const nearest = [...critical].sort((a, b) => Math.abs(a - running) - Math.abs(b - running))[0], share = nearest / running - 1;
  const text = !critical.length ? 'There is no critical speed.' : running === 0 ? `The first critical speed is ${rpmText(critical[0])}.` :
    `The nearest undamped critical speed is ${rpmText(nearest)}, ${short(100 * Math.abs(share))} % ${share >= 0 ? 'above' : 'below'}.`;
  return {title: 'The scene\'s speed', tone: isUnstable && 'bad', headline: rpmText(running) + (isUnstable ? ', unstable' : ''), text};
}

function criticalCard({campbell: {critical}}, whirls) {
  const more = critical.length - 3;
  return {title: 'Critical speeds', headline: `${critical.slice(0, 3).map(rpmText).join(', ') || 'none'}${more > 0 ? ` and ${more} more` : ''}`,
    text: whirls.every((whirl) => whirl === 'forward') ? 'undamped; forward whirl, which unbalance excites' :
      'undamped; whirl in both directions, since the planes differ'};
}

function stabilityCard({unstable_ranges: ranges, stability_bound: bound}, isUnstable) {
  const title = 'Free whirl', tone = isUnstable ? 'bad' : ranges.length ? '' : 'good';
  if (!ranges.length && bound === null)
    return {title, tone, headline: 'stable at all speeds', text: 'Without contact, nothing in the rotor can make a whirl grow.'};
  if (!ranges.length)
    return {title, tone, headline: `stable up to ${rpmText(bound * rpm)}`, text: 'The search ends there, at 20 times the highest frequency.'};
  const [[from, to]] = ranges, more = ranges.length - 1;
  const headline = from === 0 ? 'unstable at rest' : to === null ? `unstable above ${rpmText(from * rpm)}` :
    `unstable from ${rpmText(from * rpm)} to ${rpmText(to * rpm)}`;
  const why = from === 0 ? 'The negative stiffness is stronger than the shaft and its bearings.' :
    'Rotating damping or a bearing\'s cross stiffness feeds a whirl there.';
  // The growing whirl may have left the modes kept at the end of the range.
  const above = more > 0 ? ` There ${more > 1 ? `are ${more} more ranges` : 'is one more range'} above it.` :
    to !== null ? ' Above it no whirl of the modes kept grows.' : '';
  return {title, tone, headline, text: why + above};
}

// The closed loop of magnetic bearings: whether it is stable, and its largest sensitivity.
function loopCard({poles, poles_refused: refused, loops}, at) {
  if (refused) return {title: 'Closed loop', headline: 'stability unknown', text: `The poles are unknown, because ${refused}.`};
  const [{real, imaginary}] = poles;
  if (real >= 0) {
    const motion = imaginary === 0 ? 'A motion without oscillation' : `A motion at ${short(hz * Math.abs(imaginary))} Hz`;
    const isRoundOff = real < 1e-10 * Math.max(...poles.map((pole) => Math.hypot(pole.real, pole.imaginary)));
    return {title: 'Closed loop', tone: 'bad', headline: `unstable at ${at}`,
      text: `${motion} ${isRoundOff ? 'does not decay' : `grows at ${short(real)} 1/s`}.`};
  }
  const worst = loops.reduce((top, loop) => (loop.sensitivity > top.sensitivity ? loop : top));
  const size = `${short(worst.sensitivity)} (${short(20 * Math.log10(worst.sensitivity), 2)} dB)`;
  return {title: 'Magnetic bearings', tone: worst.zone === 'A' ? 'good' : '', headline: `stable, zone ${worst.zone}`,
    text: `largest sensitivity ${size} at ${short(hz * worst.frequency)} Hz, ISO 14839-3`};
}

// The smallest gap of the free rotor at a contact.
function orbitCard(response, title, isInService = true) {
  const {orbit, least_gap: gap, vibration, vibration_limit: limit, refused} = response;
  if (orbit === null) return {title, headline: 'none', text: refused};
  // The limit of API 617 is for a machine in service, not after the loss of a blade.
  const shaking = isInService && limit !== null && vibration > 0 ?
    `; vibration ${microns(vibration, 5)} peak to peak, ${vibration <= limit ? 'within' : 'beyond'} the ${microns(limit)} of API 617` : '';
  return {title, tone: gap > 0 ? '' : 'bad', headline: gap > 0 ? `least gap ${microns(gap)}` : `touches, ${microns(-gap)} beyond`,
    text: `${microns(orbit)} from the middle of the ring, clearance ${microns(orbit + gap)}${shaking}`};
}
const orbitCards = ({name, response}, at) => {
  if (!response) return [];
  const title = `Free orbit${name ? ` at contact "${name}"` : ''}`, before = response.before_loss;
  return before ? [orbitCard(before, `${title}, before the loss, ${at}`), orbitCard(response, `${title}, after the loss, ${at}`, false)] :
    [orbitCard(response, `${title}, ${at}`)];
};

function rubCards({name, rub, rub_refused: refused}, at) {
  const title = `Stable motions${name ? ` at contact "${name}"` : ''}`;
  if (refused) return [{title, headline: 'not analysed', text: refused.replace(/^\S*:\d+: /, '')}];  // without the file and the line
  if (!rub) return [];
  const unstable = rub.rubs.filter(({stable}) => !stable).length, against = rub.attractors.some((word) => ['backward whip', 'rolling'].includes(word));
  return [{title, link: rub.rubs.length ? '#rubs' : '', tone: against ? 'bad' : '', headline: rub.attractors.join(' + ') || 'none stable', text: `at ${at}` +
    (unstable ? `; ${unstable} further lasting rub${unstable > 1 ? 's are' : ' is'} unstable` : '')}];
}

export function modesCards(rotor) {
  const {found} = rotor, {speeds: [{speed, response, rub, contacts, notes, levitation}], critical, unstable_ranges: ranges} = found, at = rpmText(Math.abs(speed) * rpm);
  const running = rotor.campbell.running / rpm;
  const loop = levitation ? [loopCard(levitation, at)] : [], hasStableLoop = levitation && !levitation.poles_refused && levitation.poles[0].real < 0;
  const isUnstable = ranges.some(([from, to]) => (running > from || from === 0) && (to === null || running < to)) || loop[0]?.tone === 'bad';
  // The whirl leaves out parts of the controls, so it does not show the stability of a loop.
  const whirl = levitation ? {...stabilityCard(found, isUnstable), text: 'without integrators, filters, amplifiers and sampling'} :
    stabilityCard(found, isUnstable);
  const places = contacts || [{name: '', response, rub, rub_refused: found.rub_refused}];
  // A reason that applies to every contact is given once.
  const isSameRefusal = places.every(({rub_refused: refused}) => refused && refused === places[0].rub_refused);
  return [speedCard(rotor, isUnstable), criticalCard(rotor, critical.map(({whirl}) => whirl)), ...loop,
    ...(levitation && !hasStableLoop ? [] : [whirl]),
    ...places.flatMap((place) => orbitCards(place, at)),
    ...notes.map((text) => ({title: `Response, ${at}`, headline: 'of limited validity', text})),
    ...(isSameRefusal ? rubCards({...places[0], name: ''}, at) : places.flatMap((place) => rubCards(place, at)))];
}

// Lists the peaks with their distance from the scene's speed and the distance that API 617 asks for. Where peaks nearly coincide, it
// lists the largest.
export function peaksOf(bode) {
  const all = (bode?.curves || []).flatMap(({name, plane, peaks}) => peaks.map((peak) => ({...peak, name: plane ? `${name}, ${plane}` : name})))
    .sort((a, b) => a.speed - b.speed);
  const groups = [];
  for (const peak of all) {
    const last = groups[groups.length - 1];
    if (last && peak.speed <= 1.02 * last[0].speed) last.push(peak); else groups.push([peak]);
  }
  return groups.map((group) => group.reduce((top, peak) => (peak.amplitude > top.amplitude ? peak : top)));
}

function peakParts(bode) {
  const percent = (share) => `${short(100 * share)} %`;
  const rows = peaksOf(bode).map(({name, speed, amplitude, factor, margin}) => {
    const away = Math.abs(speed - bode.running) / bode.running, known = bode.running > 0;
    return {cells: [name, short(speed, 5), short(amplitude, 4), factor === null ? '–' : short(factor),
      {text: known ? percent(away) : '–', tone: margin === null ? '' : away >= margin ? 'good' : 'bad'}, margin === null ? 'none' : percent(margin)]};
  });
  const columns = ['station', 'at / rpm', 'amplitude / µm', 'AF', 'margin', 'required'].map((text, k) => ({text, number: k > 0}));
  return rows.length ? [{heading: 'Peaks of the unbalance response'}, {columns, rows}, {text: 'Among peaks at nearly the same speed, only the ' +
    'largest is listed. AF is the amplification factor of API 684. The margin is the distance of the scene\'s speed from the peak, beside what ' +
    'API 617 requires: nothing if AF is below 2.5, which is critically damped.'}] : [];
}

const loopParts = (loops) => (loops.some(({sensitivity, step}) => sensitivity.length || step.length) ? [{class: 'plots', parts: [{heading: 'Closed loop of the magnetic bearings'},
  {text: 'This analysis is linear, with the modes kept, and assumes that no current or voltage reaches its limit. It includes the hold and the ' +
    'delay of a sampled control. Colours distinguish the bearings; axis y is dashed.'}, ...loops.map((_, index) => ({plots: 'loop', index}))]}] : []);

// The tables of lasting rubs, each with the contact that it belongs to, and all other parts of their section.
function splitRubs(parts) {
  const front = [], behind = [];
  let heading = '';
  for (const part of parts) {
    heading = part.heading || heading;
    const isContact = part.heading?.startsWith('contact '), isRubs = heading && !/^(contact|whirl of) /.test(heading);
    if (isContact || isRubs) front.push(part);
    if (!isRubs) behind.push(part);
  }
  return front.some(({rows}) => rows) ? [front, behind] : [[], parts];
}

// Puts the mark of a row, to which a note refers, before its first cell.
const withMarks = (part) => (part.rows ? {...part, rows: part.rows.map((row) => {
  const [first, ...others] = row.cells;
  return row.mark ? {...row, cells: [first.text === undefined ? `${row.mark} ${first}` : {...first, text: `${row.mark} ${first.text}`}, ...others]} : row;
})} : part);

export function modesParts({page: {parts}, rotor, loops, texts: [scene]}) {
  const rubs = parts.find(({id}) => id === 'rubs'), [front, behind] = splitRubs((rubs?.parts || []).map(withMarks));
  return [{cards: modesCards(rotor)},
    {lead: 'Small whirl of the rotor in its bearings, without contact, from the eigenvalues of the gyroscopic system with external and ' +
      `rotating damping at a constant spin speed.${rotor.shapes ? ' The shaft is not truncated to the modes kept.' : ''} Forward whirl turns ` +
      'with the spin, backward whirl against it.'},
    {class: 'plots', parts: [{plots: 'rotor'}]}, ...loopParts(loops), ...(front.length ? [{id: 'rubs', ...sheetsOf(front)}] : []),
    sheetsOf([...parts.filter((part) => part !== rubs), ...behind, ...peakParts(rotor.bode), scenesText(scene)])];
}
