// The picture below a comparison's answer: native and MuJoCo alone, around the time at which they diverge.
import {milli} from './factors.js';
import {timeTraces} from './traces.js';
import {axes, css, layout, line, short, symbol} from './style.js';

const kLooks = 4000;      // instants of the run at which the two are compared
const kApart = 0.01;      // relative to the clearance: the runs have diverged if their gaps differ by more, or
const kForceApart = 0.5;  // relative to native's usual force: if their forces differ by more
const kTurns = 3;         // number of turns shown

// The index of the run that is first shown beside native: the measured record, else MuJoCo alone, else the next run.
export function besideNative(runs, names = ['measured', 'cone', 'cone-default']) {
  for (const name of names) {
    const at = runs.findIndex((run) => run.label === name);
    if (at > 0) return at;
  }
  return Math.min(1, runs.length - 1);
}

// The first of kLooks + 1 evenly spaced times in [from, to] at which `apart` is true; undefined if there is none.
const firstTime = (from, to, apart) =>
  Array.from({length: kLooks + 1}, (_, k) => from + (to - from) * k / kLooks).find(apart);

// [from, to], s: from half a turn before the runs diverge to kTurns turns after it; null if they do not. turn: s.
export function partingWindow(native, other, {from, to}, clearance, usualForce, turn) {
  const value = (run, name, t) => (run.has(name) ? run.value(name, t) : 0);
  const beyond = (name, most) => firstTime(from, to, (t) => Math.abs(value(native, name, t) - value(other, name, t)) > most);
  const touched = (t) => Math.min(value(native, 'gap', t), value(other, 'gap', t)) < kApart * clearance;
  if (firstTime(from, to, touched) === undefined) return null;
  const parted = beyond('gap', kApart * clearance) ?? beyond('normal', kForceApart * usualForce);
  if (parted === undefined) return null;
  const first = Math.max(from, parted - 0.5 * turn);
  return [first, Math.min(to, first + (kTurns + 0.5) * turn)];
}

// Draws the impulse of each impact in [from, to] as a stem. For a soft contact it is the impulse of a contact episode, so
// impacts that take several steps are drawn like those that take none.
export function impulseTrace(run, [from, to]) {
  const x = [], y = [];
  run.points.t.forEach((t, k) => {
    if (t < from || t > to) return;
    x.push(t, t, null);
    y.push(0, run.points.normal[k], null);
  });
  return {x, y, name: run.label, meta: run.label, type: 'scatter', mode: 'lines+markers', opacity: 0.8, line: line(run.label),
    marker: {color: css(`--${run.label}`), size: 5, symbol: symbol(run.label)}, hovertemplate: `%{y:.4g} mN s<extra>${run.label}</extra>`};
}

// {data, layout, words}: the gap above, the impulses below. Null if the runs do not diverge.
export function firstFigure(scene, runs) {
  const native = runs[0], other = runs[besideNative(runs, ['cone', 'cone-default'])];
  if (!other || other === native || !native.has('gap') || !scene.contacts[0].touches) return null;
  const whole = scene.windows[0], speed = Math.abs(scene.spin);
  const turn = speed > 0 ? 1 / speed : 0.05 * (whole.to - whole.from);
  const range = partingWindow(native, other, whole, scene.contacts[0].clearance, native.forces.usual, turn);
  if (!range) return null;
  const pair = [native, other];
  const gaps = timeTraces(pair, 'gap', range), impulses = pair.map((run) => ({...impulseTrace(run, range), yaxis: 'y2'}));
  const below = impulses.some((trace) => trace.x.length > 0);
  return {data: [...gaps, ...(below ? impulses : [])], layout: layout({hovermode: 'x unified',
    xaxis: axes({title: {text: 't / s', standoff: 6}, range: range.slice(), hoverformat: '.6f', anchor: below ? 'y2' : 'y'}),
    yaxis: axes({title: {text: 'gap / µm', standoff: 4}, domain: [below ? 0.54 : 0, 1]}),
    ...(below ? {yaxis2: axes({title: {text: 'impulse / mN s', standoff: 4}, domain: [0, 0.46]})} : {})}),
  words: {other: other.label, from: range[0]}};
}

// Draws the figure in its place, or removes the place if there is no figure.
export function showFirst(plot, scene, runs, show) {
  const figure = firstFigure(scene, runs), place = plot.closest('figure');
  if (!figure) {
    place.remove();
    return;
  }
  const name = figure.words.other === 'cone' ? 'MuJoCo alone' : figure.words.other;
  const sample = (label, text) => `<span class="key-of"><i class="swatch side-${label}"></i>${text}</span>`;
  place.querySelector('figcaption').innerHTML = `<b>Where they part</b>, shown from ${short(milli * figure.words.from)} ms on: ` +
    `${sample(native(runs), 'native')} ${sample(figure.words.other, name)} — gap (0: contact), and impulse of each impact`;
  show(plot, figure);
}
const native = (runs) => runs[0].label;
