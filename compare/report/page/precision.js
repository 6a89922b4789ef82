// The log-log plots of a bench as plotly figures, from a scene of bench.json.
import {units} from './player/units.js';
import {logTicks} from './scales.js';
import {axes, css, growBy, layout, legendBelow, short} from './style.js';

// The series of a scene with their points; errors in m, 0 if unknown. The tolerances of an engine form one series.
export function benchOf({clearance, engines, points, series}) {
  const belongs = (point, {engine, setting}) => point.engine === engine && setting === (point.step === null ? '' : point.setting);
  const pointOf = ({setting, step, position_error: error, limit_error: limit, wall_ms: wall, outcome}) => ({outcome, error,
    label: [setting, step && units.duration(step)].filter(Boolean).join(', '), step: step || 0, limit: limit || 0,
    ms: wall?.median || 0, low: wall?.low || 0, high: wall?.high || 0});
  return {clearance, series: series.map((one) => ({...one, family: engines.find(({engine}) => engine === one.engine)?.family ?? 'peer',
    points: points.filter((point) => point.position_error !== null && belongs(point, one)).map(pointOf)}))};
}

// Each engine has a colour, and each of its settings a dash pattern.
const colors = {'native-event': '--native', 'native-verlet': '--good',
  'mujoco-rigid': '--rigid', 'mujoco-coulomb': '--coulomb', 'mujoco-cone': '--cone',
  'mujoco-cone-coulomb': '--cone-coulomb'};
const spare = ['--mode-1', '--mode-2', '--mode-3', '--mode-4', '--mode-5', '--mode-6', '--soft'];
const dashes = ['solid', 'dash', 'dot', 'dashdot'];
const symbols = {native: 'circle', mujoco: 'square', peer: 'diamond'};

function style(scene, series) {
  const others = [...new Set(scene.series.map(({engine}) => engine))].filter((name) => !colors[name]);
  const settings = scene.series.filter(({engine}) => engine === series.engine);
  const color = colors[series.engine] || spare[others.indexOf(series.engine) % spare.length];
  return {color: css(color) || css('--soft'), dash: dashes[settings.indexOf(series) % dashes.length]};
}

const named = (series) => series.engine + (series.setting ? `, ${series.setting}` : '');
const ms = (x) => `${short(x)} ms`;
const text = (p) => (p.label ? `${p.label}<br>` : '') + 'error ' + p.error.toExponential(2) + ' m<br>' + ms(p.ms) +
  ' (' + short(p.low) + ' to ' + short(p.high) + ')<br>' + p.outcome;

function trace(scene, series, x, y, extra) {
  const {color, dash} = style(scene, series);
  const points = series.points.filter((p) => p[x] > 0 && p[y] > 0);
  return Object.assign({type: 'scatter', mode: 'lines+markers', name: named(series), x: points.map((p) => p[x]), y: points.map((p) => p[y]),
    text: points.map(text), hovertemplate: `%{text}<extra>${named(series)}</extra>`, line: {color, width: 1.8, dash},
    marker: {size: 8, symbol: points.map((p) => symbols[series.family] + (p.outcome === 'ok' ? '' : '-open')), color}}, extra);
}

const log = (title, values) => axes({type: 'log', title: {text: title, standoff: 6}, ...logTicks(values)});
const valuesOf = (list, key) => list.flatMap((s) => s.points.map((p) => p[key]));

// key: speed against error, with the legend of all plots; error against step, MuJoCo's distance from its own limit.
export function precision(scene, key, plot) {
  const stepped = scene.series.filter((s) => s.points.some((p) => p.step > 0));
  const mujoco = scene.series.filter((s) => s.family === 'mujoco' && s.points.some((p) => p.limit > 0));
  const line = (s, dash) => ({color: style(scene, s).color, width: 1.8, dash});
  const figures = {
    precision: () => [scene.series.map((s) => trace(scene, s, 'ms', 'error')),
      log('time of the whole run / ms', valuesOf(scene.series, 'ms')), log('largest position error / m', valuesOf(scene.series, 'error'))],
    step: () => [stepped.map((s) => trace(scene, s, 'step', 'error')),
      log('step / s', valuesOf(stepped, 'step')), log('largest position error / m', valuesOf(stepped, 'error'))],
    limit: () => [mujoco.flatMap((s) => [trace(scene, s, 'step', 'limit', {line: line(s, 'solid')}),
      trace(scene, s, 'step', 'error', {name: 'to the reference', line: line(s, 'dot')})]),
    log('step / s', valuesOf(mujoco, 'step')), log('distance / m', valuesOf(mujoco, 'limit'))],
  };
  const [traces, x, y] = figures[key]();
  const {legend, height} = legendBelow(key === 'precision' ? scene.series.map(named) : [], plot.clientWidth);
  growBy(plot, height);
  return {data: traces, layout: layout({hovermode: 'closest', showlegend: height > 0, margin: {l: 70, r: 12, t: 8, b: 46 + height}, xaxis: x, yaxis: y, legend,
    // A line at the clearance: a result with an error of that size is useless.
    shapes: [{type: 'line', xref: 'paper', x0: 0, x1: 1, y0: scene.clearance, y1: scene.clearance,
      line: {color: css('--bad'), width: 1, dash: 'dot'}}]})};
}
