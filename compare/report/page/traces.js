// Builds the plotly figure (traces and layout) of each plot of a scene.
import {micro, milli, rpm} from './factors.js';
import {orbitMarks} from './orbits.js';
import {Track} from './player/tracks.js';
import {rotorFigure} from './rotor.js';
import {runUpFigure} from './runup.js';
import {opened, openedCurve, thinned} from './scales.js';
import {minusFigure, spreadFigure} from './spread.js';
import {axes, css, decades, isFront, layout, line, notesAbove, number, symbol, titled} from './style.js';
import {ranges, whirlFigure} from './whirl.js';

const kBuckets = 700;   // parts of a trace, each with two points

// Traces with more points are solid, because dashes are unreadable in a trace that scatters over the whole picture.
const kDashed = 900;
// The runs that scatter most are drawn first, and the judged run thin on top of the native one.
const behindFirst = (runs) => [...runs.slice(2), ...runs.slice(0, 2)];

// A plot over time: the track of the run that it shows, and the value in the plot's unit.
const component = (name, factor = 1, c = 0) => ({track: name, read: (run, t) => factor * run.tracks[name].at(t, c)});
const size = (name, factor = 1) => ({track: name, read: (run, t) => factor * run.tracks[name].length(t)});
const series = {
  gap: component('gap', micro),
  gap_rate: {...component('gap_rate', milli), jumps: true},
  rotor_x: component('rotor', micro),
  normal_force: component('normal'),
  sample_force: component('force'),
  friction_force: component('friction'),
  spin: component('spin_speed', rpm),
  ring_speed: component('ring_speed', rpm),
  torsion: component('torsion', milli),
  control: size('control'),
  current: size('current'),
};

function sampled(run, key, [from, to]) {
  const {track, read, jumps} = series[key];
  const t = run.tracks[track].instants(from, to, 2 * kBuckets, jumps);
  return opened(thinned(t, t.map((time) => read(run, time)), kBuckets), run.holes?.[track]);
}

const has = (run, key) => run.has(series[key].track);

export function timeTraces(runs, key, range) {
  return behindFirst(runs).filter((run) => has(run, key)).map((run) => {
    const {t, y} = sampled(run, key, range);
    return {x: t, y, name: run.label, meta: run.label, type: 'scatter', mode: 'lines',
      opacity: ['cone', 'cone-default'].includes(run.label) ? 0.6 : 1,
      line: {...line(run.label), ...(t.length > kDashed ? {dash: 'solid'} : {})},
      hovertemplate: `%{y:.5g}<extra>${run.label}</extra>`};
  });
}

// The same run with a passive bearing, behind all others.
function uncontrolledTraces({scene, number: contact}, key, range) {
  if (!scene.uncontrolled || key !== 'rotor_x' || contact > 0) return [];
  scene.passive = scene.passive || {tracks: {rotor: new Track(scene.uncontrolled.rotor)}};
  const {t, y} = sampled(scene.passive, key, range);
  return [{x: t, y, name: 'without control', meta: 'without control', type: 'scatter', mode: 'lines',
    line: {color: css('--soft'), width: 1, dash: 'dot', simplify: false}, opacity: 0.7,
    hovertemplate: '%{y:.5g}<extra>without control</extra>'}];
}

// The plots with one point per impact: the abscissa, the ordinate and the hover text of each.
const laws = {
  impacts: {x: 't', y: 'normal', text: 't = %{x:.6g} s<br>%{y:.4g} mN s'},
  friction_impacts: {x: 't', y: 'friction', text: 't = %{x:.6g} s<br>%{y:.4g} mN s'},
  normal_law: {x: 'before', y: 'after', text: 'before %{x:.4g} m/s<br>after %{y:.4g} m/s'},
  friction_law: {x: 'slip', y: 'share', text: 'slip after %{x:.4g} m/s<br>%{y:.4g} of friction times normal'},
};
function impactTraces(runs, key) {
  const law = laws[key];
  return runs.map(({label, points}) => ({x: points[law.x], y: points[law.y], name: label, meta: label, type: 'scatter', mode: 'markers',
    marker: {color: css(`--${label}`), size: isFront(label) ? 5 : 6, opacity: 0.75, symbol: symbol(label)},
    hovertemplate: `${law.text}<extra>${label}</extra>`}));
}

// The lines of the laws: gap rate after = -eps gap rate before; and Coulomb's law, friction against the slip, within +-1 if
// there is no slip.
function lawShapes({contact, runs}, key) {
  const dashed = {color: css('--soft'), width: 1, dash: 'dash'};
  const all = runs.flatMap((run) => run.points[laws[key].x]);
  const low = Math.min(0, ...all), high = Math.max(0, ...all);
  const piece = (x0, y0, x1, y1) => ({type: 'line', x0, y0, x1, y1, line: dashed, layer: 'below'});
  return key === 'normal_law' ? [piece(low, -contact.restitution * low, 0, 0)] :
    [piece(low, 1, 0, 1), piece(0, 1, 0, -1), piece(0, -1, high, -1)];
}

// A curve in the plane at every knot of `track`, and at further instants where it would be coarse.
function curve(run, track, range, read, label, width, dash) {
  const times = run.tracks[track].instants(range[0], range[1], 2 * kBuckets);
  const every = Math.ceil(times.length / (4 * kBuckets)), kept = times.filter((_, k) => k % every === 0);
  const points = openedCurve(kept, kept.map(read), run.holes?.[track]);
  return {x: points.map((p) => p[0]), y: points.map((p) => p[1]), name: run.label, meta: run.label, type: 'scatter', mode: 'lines',
    line: {...line(run.label, false), width, ...(dash ? {dash} : {})}, hovertemplate: `(%{x:.4g}, %{y:.4g})<extra>${run.label}${label}</extra>`};
}
const inMicrons = ([x, y]) => [micro * x, micro * y];
const orbitTraces = (runs, range) => behindFirst(runs).filter((run) => run.has('rotor')).flatMap((run) => [
  curve(run, 'rotor', range, (t) => inMicrons(run.pose(t).rotor), ' rotor', isFront(run.label) ? 2.4 : 1.4, 'solid'),
  ...(run.has('ring') ? [curve(run, 'ring', range, (t) => inMicrons(run.pair('ring', t)), ' ring', isFront(run.label) ? 1.8 : 1, 'dot')] : [])]);
const relativePlace = (run, t) => { const p = run.pose(t); return inMicrons([p.rotor[0] - p.ring[0], p.rotor[1] - p.ring[1]]); };
const relativeTraces = (runs, range) => behindFirst(runs).filter((run) => run.has('rotor') && run.has('gap') && run.ringKnown).map((run) =>
  curve(run, 'gap', range, (t) => relativePlace(run, t), ' relative', isFront(run.label) ? 2.4 : 1.4));

// The points of a run on the characteristic of its actuator or motor. The first actuator axis is (1, 1) / sqrt 2.
function pathTraces({scene, contact, runs}, key, range) {
  const characteristics = key === 'motor' ? (scene.motor ? [{...scene.motor, name: 'characteristic'}] : []) : contact.actuator;
  const dashed = characteristics.map((c) => ({x: c.x, y: c.y, name: c.name, meta: c.name, type: 'scatter', mode: 'lines',
    line: {color: css('--soft'), width: 1, dash: 'dash'}, hovertemplate: `%{y:.4g}<extra>${c.name}</extra>`}));
  const [track, read] = key === 'motor' ?
    ['motor_torque', (run) => (t) => [rpm * run.value('spin_speed', t), run.value('motor_torque', t)]] :
    ['current', (run) => (t) => { const [x, y] = run.pair('control', t); return [run.value('current', t), (x + y) * Math.SQRT1_2]; }];
  return [...dashed, ...behindFirst(runs).filter((run) => run.has(track) && (key === 'motor' || run.has('control'))).map((run) =>
    curve(run, track, range, read(run), '', isFront(run.label) ? 2.4 : 1.4))];
}

// The first two runs, native and the contact model that is judged, set the height of a force plot if another run would
// flatten them; every run that then leaves the axis is named in a note.
export function heightFor(traces) {
  const extent = (list) => list.reduce((e, trace) => trace.y.reduce(
    (f, y) => [Math.min(f[0], y), Math.max(f[1], y)], e), [0, 0]);
  const [low, high] = extent(traces.slice(-2));
  const room = 0.08 * (high - low);
  const range = [low < 0 ? low - room : -room, high > 0 ? high + room : room];
  const beyond = traces.slice(0, -2).map((trace) => ({trace, ends: extent([trace])}));
  const leaves = ([least, most], times) => least < times * range[0] || most > times * range[1];
  if (high === low || !beyond.some(({ends}) => leaves(ends, 3))) return {};
  const notes = beyond.filter(({ends}) => leaves(ends, 1)).map(({trace, ends: [least, most]}) =>
    ({text: `${trace.name} reaches ${number(Math.abs(least) > most ? least : most, 3)} N`, color: trace.line.color}));
  return {axis: {range}, notes};
}

function turnsPlot({contact, runs}, {key, range, hidden}) {
  // All runs have the same clearance, except one that was recomputed with another.
  const radii = [...new Set([contact, ...runs].map(({clearance}) => micro * clearance))].filter((r) => r > 0);
  const circles = radii.map((r) => ({type: 'circle', x0: -r, x1: r, y0: -r, y1: r, line: {color: css('--soft'), width: 1, dash: 'dash'}}));
  const orbit = key === 'orbit', lines = orbit ? orbitTraces(runs, range) : relativeTraces(runs, range);
  const marked = behindFirst(runs).filter((run) => run.has('rotor') && run.has('spin') && (orbit || run.has('gap')));
  const marks = orbitMarks(marked, range, hidden, orbit ? (run, t) => inMicrons(run.pose(t).rotor) : relativePlace);
  // The picture is square, even if the rotor rests at one side.
  const points = [...lines.flatMap(({x, y}) => x.map((value, k) => [value, y[k]])), ...(orbit ? [] : radii.flatMap((r) => [[-r, -r], [r, r]]))];
  const [x, y] = ranges(points.filter(([value]) => value !== null)) ?? [];
  const square = (range) => ({automargin: false, constrain: 'domain', ...(range && {range})});
  const {margin, annotations} = notesAbove(marks.notes);
  return {data: [...lines, ...marks.data],
    layout: layout({hovermode: 'closest', margin, annotations: [...marks.arrows, ...annotations], shapes: orbit ? [] : circles,
      xaxis: titled('x / µm', square(x)), yaxis: titled('y / µm', {...square(y), scaleanchor: 'x'})})};
}
function timePlot(view, {key, over, range}) {
  const impacts = over === 'impacts';
  const data = impacts ? impactTraces(view.runs, key) : [...uncontrolledTraces(view, key, range), ...timeTraces(view.runs, key, range)];
  const height = key.endsWith('_force') ? heightFor(data) : {};
  return {data, layout: layout({hovermode: impacts ? 'closest' : 'x unified', ...notesAbove(height.notes || [], {l: 64}),
    xaxis: axes({title: {text: 't / s', standoff: 6}, automargin: false, range: range.slice(), hoverformat: '.6f'}), yaxis: axes({automargin: false, ...(impacts ? decades(data.flatMap(({y}) => y)) : height.axis)})})};
}

const axisTitles = {normal_law: ['before / (m/s)', 'after / (m/s)'], friction_law: ['slip after / (m/s)', 'tangential / (friction × normal)'],
  motor: ['speed / rpm', 'torque / N m'], actuator: ['current / A', 'force / N']};
const planeFigure = (key, data, shapes = []) => ({data, layout: layout({hovermode: 'closest', shapes, xaxis: titled(axisTitles[key][0]), yaxis: titled(axisTitles[key][1])})});

// The functions that build figures, by a plot's key, or else by its `over` (run_plots.js).
const figures = {
  time: timePlot, impacts: timePlot, turns: turnsPlot,
  law: (view, {key}) => planeFigure(key, impactTraces(view.runs, key), lawShapes(view, key)),
  path: (view, {key, range}) => planeFigure(key, pathTraces(view, key, range)),
  measured_minus: ({runs}, {range}) => minusFigure(runs, range),
  residual: ({scene}, {key, range, hidden}) => whirlFigure(scene, key, range, hidden),
  whirl: ({scene}, {key, range, hidden}) => whirlFigure(scene, key, range, hidden),
  runup: ({scene, runs}, {key, hidden}) => runUpFigure(key, scene, runs, hidden),
  spread: ({runs}, {key}) => spreadFigure(key, runs),
  rotor: ({scene}, {key, width}) => rotorFigure(scene.rotor, key, width),
};

// view: {scene, number, contact, runs}, at one of the scene's contacts. plot: {key, over, range, hidden: labels of hidden runs,
// width: px}.
export const sceneFigure = (view, plot) => (figures[plot.key] ?? figures[plot.over])(view, plot);
