// Plotly figures of the distributions of contact forces and impulses, and of the difference between a record and each run.
import {micro, milli} from './factors.js';
import {countUntil, opened, thinned} from './scales.js';
import {axes, css, decades, layout, line, notesAbove, number, titled} from './style.js';

// The share of the time that y spends in each of `parts` equal bins from 0 to its maximum; y is linear between the times t.
export function histogram(t, y, parts = 60) {
  const top = y.reduce((most, value) => Math.max(most, value), 0), whole = t[t.length - 1] - t[0], width = top / parts, share = new Array(parts).fill(0);
  if (!(top > 0) || !(whole > 0)) return null;
  const partOf = (value) => Math.min(parts - 1, Math.floor(Math.max(0, value) / width));
  for (let i = 1; i < t.length; ++i) {
    const low = Math.min(y[i - 1], y[i]), high = Math.max(y[i - 1], y[i]), part = (t[i] - t[i - 1]) / whole;
    if (high <= 0) continue;
    for (let k = partOf(low); k <= partOf(high); ++k) {
      const inside = Math.min(high, k + 1 === parts ? high : (k + 1) * width) - Math.max(low, k * width);
      share[k] += high > low ? part * inside / (high - low) : part;
    }
  }
  return {width, share};
}

// The values in descending order with the number of values that reach each; of many values, a selection that is even in the
// logarithm of that number.
export function exceedance(values, most = 150) {
  const all = [...values].sort((a, b) => b - a), growth = Math.log(all.length) / (most - 1);
  const even = Array.from({length: most}, (_, k) => Math.min(all.length, Math.max(1, Math.floor(Math.exp(growth * k) + 1e-9))));
  const count = all.length ? [...new Set([...even, all.length])] : [];
  return {value: count.map((n) => all[n - 1]), count};
}

const knotsOf = (track) => ({t: Array.from({length: track.knots}, (_, k) => track.time(k)), y: [0, 1].map((c) => Array.from(track.values[c] ?? []))});

// N s of each impact of a run. An episode of a soft contact that lasts longer than an impact is a rub, and its impulse is the
// sum over the whole of it.
export function impulsesOf({tracks: {impacts, normal}, longestImpact}) {
  if (!impacts?.knots) return [];
  const {t, y: [impulse]} = knotsOf(impacts), force = normal && longestImpact < Infinity && knotsOf(normal);
  const lasts = (begin) => {
    let k = countUntil(force.t, begin), last = begin;
    for (; k < force.t.length && force.y[0][k] > 0; ++k) last = force.t[k];
    return last - begin;
  };
  return impulse.filter((_, k) => !force || lasts(t[k]) <= longestImpact);
}

// The corners of a step function that is share[k] from k width to (k + 1) width.
export function staircase({width, share}) {
  const x = [0], y = [0];
  share.forEach((value, k) => {
    x.push(k * width, (k + 1) * width);
    y.push(value, value);
  });
  return {x: [...x, share.length * width], y: [...y, 0]};
}

const trace = (label, x, y, more) => ({x, y, name: label, meta: label, type: 'scatter', mode: 'lines', line: line(label), ...more});

// The first two runs set the range of the axis, as in a force plot; a run that exceeds it by far is named in a note.
export function widthFor(sides) {
  const reach = ({stairs}) => stairs.width * stairs.share.length, all = sides.filter(({stairs}) => stairs);
  const usual = 1.05 * Math.max(0, ...all.slice(-2).map(reach));
  const beyond = all.filter((side) => reach(side) > 3 * usual);
  return beyond.length ? {range: [0, Math.max(usual, ...all.filter((side) => !beyond.includes(side)).map(reach))], beyond: beyond.map((side) => ({label: side.label, most: reach(side)}))} :
    {beyond};
}

function force(runs) {
  const sides = runs.filter((run) => run.has('normal')).map(({label, tracks: {normal}}) => {
    const {t, y: [newtons]} = knotsOf(normal);
    return {label, stairs: histogram(t, newtons)};
  }), {range, beyond} = widthFor(sides);
  const data = sides.filter(({stairs}) => stairs).map(({label, stairs}) => {
    const {x, y} = staircase({...stairs, share: stairs.share.map((share) => 100 * share)});
    return trace(label, x, y, {line: {...line(label), dash: 'solid'}, hovertemplate: `%{x:.4g} N: %{y:.3g} % of the time<extra>${label}</extra>`});
  });
  return {data, layout: layout({hovermode: 'closest', xaxis: titled('normal force / N', range ? {range} : {}),
    yaxis: titled('share of the time / %', decades(data.flatMap(({y}) => y))),
    ...notesAbove(beyond.map(({label, most}) => ({text: `${label} reaches ${number(most, 3)} N`, color: css(`--${label}`)})))})};
}

function impulse(runs) {
  const data = runs.map((run) => ({label: run.label, ...exceedance(impulsesOf(run).map((value) => milli * value))})).filter(({count}) => count.length)
    .map(({label, value, count}) => trace(label, value, count, {line: {...line(label), shape: 'vh'}, hovertemplate: `%{y} impacts reach %{x:.4g} mN s<extra>${label}</extra>`}));
  const axis = (title, values) => titled(title, decades(values));
  return {data, layout: layout({hovermode: 'closest', xaxis: axis('normal impulse / mN s', data.flatMap(({x}) => x)),
    yaxis: axis('impacts that reach it', data.flatMap(({y}) => y))})};
}

const figures = {force_spread: force, impulse_spread: impulse};
// runs: the runs at one contact.
export const spreadFigure = (key, runs) => figures[key]([...runs].reverse());

// Record minus run along x, um, at the record's samples within both.
export function measuredMinus(record, run, [from, to]) {
  const t = record.tracks.rotor.instants(Math.max(from, run.start), Math.min(to, run.end), 2).filter((time) => record.within(time));
  return {t, y: t.map((time) => micro * (record.tracks.rotor.at(time, 0) - run.tracks.rotor.at(time, 0)))};
}

export function minusFigure(runs, range) {
  const record = runs.find((run) => run.measured), others = runs.filter((run) => !run.measured && run.has('rotor'));
  const data = !record?.has('rotor') ? [] : [...others].reverse().map((run) => {
    const all = measuredMinus(record, run, range), {t, y} = opened(thinned(all.t, all.y, 700), record.holes.rotor);
    return trace(run.label, t, y, {hovertemplate: `measured − ${run.label}: %{y:.4g} µm<extra></extra>`});
  });
  return {data, layout: layout({hovermode: 'x unified', xaxis: axes({title: {text: 't / s', standoff: 6}, range: range.slice(), hoverformat: '.6f'}),
    yaxis: axes({zerolinecolor: css('--soft')})})};
}
