// The picture beneath a comparison's answer: native beside MuJoCo alone, where the two part.
import {timeTraces} from './traces.js';
import {axes, css, layout, line, short, symbol} from './style.js';

const kLooks = 4000;      // instants of the run at which the two are compared
const kApart = 0.01;      // of the clearance, or
const kForceApart = 0.5;  // of native's usual force: from there on they have parted
const kTurns = 3;         // shown

// What a reader sees beside native at first: the measured record, else MuJoCo alone, else what comes next.
export function besideNative(runs, names = ['measured', 'cone', 'cone-default']) {
  for (const name of names) {
    const at = runs.findIndex((run) => run.label === name);
    if (at > 0) return at;
  }
  return Math.min(1, runs.length - 1);
}

// The first time in [from, to] at which `apart` holds, of equally many instants between; undefined: never.
const firstTime = (from, to, apart) =>
  Array.from({length: kLooks + 1}, (_, k) => from + (to - from) * k / kLooks).find(apart);

// [from, to], s: half a turn before the two part to some turns after it; null: they do not. turn: s.
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

// {data, layout, words}, or null where there is nothing to be seen. Gap above, impulses below.
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

// Draws it in its place, or leaves the place out.
export function showFirst(plot, scene, runs, show) {
  const figure = firstFigure(scene, runs), place = plot.closest('figure');
  if (!figure) {
    place.remove();
    return;
  }
  const name = figure.words.other === 'cone' ? 'MuJoCo alone' : figure.words.other;
  const sample = (label, text) => `<span class="key-of"><i class="swatch side-${label}"></i>${text}</span>`;
  place.querySelector('figcaption').innerHTML = `<b>Where they part</b>, shown from ${short(1e3 * figure.words.from)} ms on: ` +
    `${sample(native(runs), 'native')} ${sample(figure.words.other, name)} — gap (0: contact), and impulse of each impact`;
  show(plot, figure);
}
const native = (runs) => runs[0].label;
