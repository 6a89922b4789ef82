// The annotations of an orbit: the points at which the rotor's mark passes (keyphasor), and the direction of the motion.
import {css} from './style.js';

// The signed area that the points [x, y], in order of time, sweep about their mean, divided by the unsigned area. 1: always
// from x to y; -1: always from y to x; near 0: to and fro.
export function sweptSense(points) {
  if (points.length < 3) return 0;
  const mean = [0, 1].map((c) => points.reduce((sum, p) => sum + p[c], 0) / points.length);
  let swept = 0, either = 0;
  for (let k = 1; k < points.length; ++k) {
    const [a, b] = [points[k - 1], points[k]].map((p) => [p[0] - mean[0], p[1] - mean[1]]), part = a[0] * b[1] - a[1] * b[0];
    swept += part;
    either += Math.abs(part);
  }
  return either > 0 ? swept / either : 0;
}

// The sense in words, for a spin of either sign.
export function senseWord(sense, spin) {
  if (Math.abs(sense) < 0.2) return 'to and fro';
  if (!spin) return sense > 0 ? 'from x to y' : 'from y to x';
  const way = sense * spin > 0 ? 'forward' : 'backward';
  return Math.abs(sense) < 0.8 ? `mostly ${way}` : way;
}

// The part of [from, to] in which the mark and the sense are determined, and the number of samples. Only the last kTurns turns
// are used.
const kTurns = 24;
export function lookAt(from, to, turn) {
  const begin = turn > 0 ? Math.max(from, to - kTurns * turn) : from;
  return {from: begin, to, steps: turn > 0 ? Math.min(4000, Math.max(200, Math.ceil(40 * (to - begin) / turn))) : 400};
}

// The lines that state the senses: one line for the sense that most runs have, and one for each run with another sense.
export function senseLines(words) {
  const all = [...words.values()], most = [...new Set(all)].sort((a, b) => all.filter((w) => w === b).length - all.filter((w) => w === a).length)[0];
  const others = [...words].filter(([, word]) => word !== most), same = all.length - others.length;
  const line = {text: same === 1 ? [...words].find(([, word]) => word === most).join(': ') : `${others.length ? `${same} others` : 'all'}: ${most}`, label: null};
  return all.length ? [...others.map(([label, word]) => ({text: `${label}: ${word}`, label})), line] : [];
}

// Marks, arrows and words of the runs; placeOf(run, t): um.
export function orbitMarks(runs, [from, to], hidden, placeOf) {
  const data = [], arrows = [], words = new Map();
  for (const run of runs.filter((r) => !hidden.has(r.label))) {
    const start = Math.max(from, run.start), end = Math.min(to, run.end);
    if (!(end > start)) continue;
    const spin = run.value('spin_speed', end), turn = spin ? 2 * Math.PI / Math.abs(spin) : 0, look = lookAt(start, end, turn);
    const color = css(`--${run.label}`), points = [];
    for (let k = 0; k <= look.steps; ++k) points.push(placeOf(run, look.from + (look.to - look.from) * k / look.steps));
    const passed = run.pulses(look.from, look.to, look.steps).map((t) => placeOf(run, t));
    data.push({x: passed.map((p) => p[0]), y: passed.map((p) => p[1]), name: run.label, meta: run.label, type: 'scatter', mode: 'markers', cliponaxis: false,
      marker: {color, symbol: 'diamond', size: 11, line: {color: css('--paper'), width: 1.5}}, hovertemplate: `the mark passes: (%{x:.4g}, %{y:.4g})<extra>${run.label}</extra>`});
    // The arrow is at the end of the line and spans a twentieth of a turn.
    const head = points[points.length - 1], tail = placeOf(run, Math.max(start, end - (turn || end - start) / 20));
    if (Math.hypot(head[0] - tail[0], head[1] - tail[1]) > 0) {
      arrows.push({x: head[0], y: head[1], ax: tail[0], ay: tail[1], xref: 'x', yref: 'y', axref: 'x', ayref: 'y', text: '', showarrow: true,
        arrowhead: 2, arrowsize: 1.4, arrowwidth: 1.6, arrowcolor: color});
    }
    words.set(run.label, senseWord(sweptSense(points), spin));
  }
  return {data, arrows, notes: senseLines(words).map(({text, label}) => ({text, color: css(label ? `--${label}` : '--soft')}))};
}
