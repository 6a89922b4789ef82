// Plotly figures of a run-up over its speed: the cascade of full spectra, amplitude and phase of 1x and 2x, and the polar plot
// of 1x. Each has at(t), the position of the runs at a time in its axes: [{label, x, y}].
import {micro, rpm} from './factors.js';
import {placeOf} from './response.js';
import {amplitudesAndPhases} from './rotor_data.js';
import {axes, css, layout, line, number, titled} from './style.js';

const rpmsOf = ({speed}) => speed.map((omega) => rpm * Math.abs(omega));
const rpmOf = (run, t) => rpm * Math.abs(run.value('spin_speed', t));

// Interpolates a list over ascending times linearly.
export function between(times, values, t) {
  const k = times.findIndex((time) => time >= t);
  if (k < 0) return values[values.length - 1];
  if (k === 0) return values[0];
  const share = (t - times[k - 1]) / (times[k] - times[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

// um of each cell of a row, from a byte each (plot_points.h: levels_data).
export function amplitudes({levels, columns, low, high}, row) {
  return Array.from({length: columns}, (_, k) => {
    const level = levels.charCodeAt(row * columns + k);
    return level === 0 ? 0 : micro * 10 ** (low + (level / 255) * (high - low));
  });
}

function cascade(scene, runs, hidden) {
  const side = scene.sides.find((s) => s.whirl.cascade && !hidden.has(s.label));
  if (!side) return {data: [], layout: layout({})};
  const c = side.whirl.cascade, run = runs.find((r) => r.label === side.label), {t} = c, speed = rpmsOf(c), last = speed.length - 1;
  const unpacked = {...c, levels: atob(c.levels)}, all = speed.map((_, row) => amplitudes(unpacked, row));
  const low = speed[0], high = speed[last], most = Math.max(...all.flat()), gain = 5 * (high - low) / last / most;
  const f = Array.from({length: c.columns}, (_, k) => c.f[0] + (c.f[1] - c.f[0]) * k / (c.columns - 1));
  // Drawn from the highest speed down, each spectrum filled to its base line, so that a nearer one hides those behind it.
  const lines = speed.flatMap((n, row) => [{x: f, y: all[row].map((a) => n + gain * a), name: `${number(n, 4)} rpm`, meta: side.label, type: 'scatter',
    mode: 'lines', fill: 'tonexty', fillcolor: css('--paper'), line: {color: css(`--${side.label}`), width: 1, simplify: false}, customdata: all[row],
    hovertemplate: `%{x:.4g} Hz: %{customdata:.3g} µm<extra>${number(n, 4)} rpm, t = ${t[row].toPrecision(4)} s</extra>`},
  {x: [f[0], f[f.length - 1]], y: [n, n], type: 'scatter', mode: 'lines', hoverinfo: 'skip', meta: side.label, name: 'foot',
    line: {color: css(`--${side.label}`), width: 0}}]).reverse();
  const rays = [-2, -1, 1, 2].map((k) => ({type: 'line', x0: k * low / 60, y0: low, x1: k * high / 60, y1: high,
    line: {color: css('--coulomb'), width: 1, dash: 'dash'}}));
  const words = [-2, -1, 1, 2].map((k) => ({x: k * high / 60, y: high, yanchor: 'bottom', text: `${k > 0 ? '' : '−'}${Math.abs(k)}×`, showarrow: false,
    font: {size: 11, color: css('--coulomb')}}));
  return {data: lines, at: (time) => [{label: side.label, x: rpmOf(run, time) / 60, y: rpmOf(run, time)}],
    layout: layout({hovermode: 'closest', margin: {l: 64, r: 16, t: 24, b: 44}, shapes: rays, annotations: [...words,
      {text: `${side.label}; the highest peak has ${number(most, 3)} µm`, xref: 'paper', yref: 'paper', x: 0, y: 1, xanchor: 'left', yanchor: 'bottom', showarrow: false,
        font: {color: css(`--${side.label}`), size: 12}}],
    xaxis: titled('backward   ←   whirl / Hz   →   forward', {range: c.f.slice()}),
    yaxis: titled('spin speed / rpm', {range: [low - 0.02 * (high - low), high + 1.05 * gain * most], exponentformat: 'none', separatethousands: true})})};
}

// 1x and 2x of the runs that change their speed: rpm, µm and degrees.
const tracked = (scene) => [...scene.sides].reverse().filter((side) => side.whirl.orders).map(({label, whirl: {orders: of}}) => {
  const each = of.orders.map(amplitudesAndPhases);
  return {label, orders: {t: of.t, speed: rpmsOf(of), amplitude: each.map(({amplitude}) => amplitude), phase: each.map(({phase}) => phase)}};
});

// Phases from -270 to 90 degrees, as in Bode plots. Null where a line would jump, and where the amplitude is below `least`,
// because the phase is random there.
export function withinTurn(phases, sizes, least) {
  let last = null;
  return phases.map((phase, k) => {
    const within = phase - 360 * Math.ceil((phase - 90) / 360), jumps = last !== null && Math.abs(within - last) > 180;
    last = within;
    return jumps || sizes[k] < least ? null : within;
  });
}

function orders(scene) {
  const sides = tracked(scene), traces = sides.flatMap((side) => [1, 0].flatMap((k) => {
    const {speed, amplitude, phase} = side.orders, name = `${side.label}, ${k + 1}×`;
    const trace = (y, more) => ({x: speed, y, name, meta: side.label, type: 'scatter', mode: 'lines',
      line: {...line(side.label), width: k ? 1 : line(side.label).width}, opacity: k ? 0.6 : 1,
      customdata: amplitude[k].map((a, i) => [a, phase[k][i]]),
      hovertemplate: `%{x:.5g} rpm: %{customdata[0]:.4g} µm, %{customdata[1]:.1f}°<extra>${name}</extra>`, ...more});
    return [trace(amplitude[k]), trace(withinTurn(phase[k], amplitude[k], 0.01 * Math.max(...amplitude[0])), {yaxis: 'y2'})];
  }));
  const at = (t) => sides.map(({label, orders: o}) => ({label, x: between(o.t, o.speed, t), y: between(o.t, o.amplitude[0], t)}));
  return {data: traces, at, layout: layout({hovermode: 'closest', margin: {l: 64, r: 24, t: 8, b: 44},
    xaxis: axes({title: {text: 'spin speed / rpm', standoff: 6}, anchor: 'y2', exponentformat: 'none', separatethousands: true}),
    yaxis: axes({title: {text: 'amplitude / µm', standoff: 8}, automargin: false, rangemode: 'tozero', domain: [0.4, 1]}),
    yaxis2: axes({title: {text: 'phase / °', standoff: 8}, automargin: false, domain: [0, 0.34], dtick: 90, range: [-280, 100]})})};
}

function ordersPolar(scene) {
  const sides = tracked(scene), square = {automargin: false, constrain: 'domain', exponentformat: 'none', separatethousands: true};
  const data = sides.map((side) => {
    const {speed, amplitude, phase} = side.orders, places = amplitude[0].map((a, k) => placeOf(a, phase[0][k]));
    return {x: places.map((p) => p[0]), y: places.map((p) => p[1]), name: side.label, meta: side.label, type: 'scatter', mode: 'lines', line: line(side.label),
      customdata: speed.map((n, k) => [n, amplitude[0][k], phase[0][k]]),
      hovertemplate: `%{customdata[0]:.5g} rpm: %{customdata[1]:.4g} µm, %{customdata[2]:.1f}°<extra>${side.label}</extra>`};
  });
  const at = (t) => sides.map(({label, orders: o}) => {
    const [x, y] = placeOf(between(o.t, o.amplitude[0], t), between(o.t, o.phase[0], t));
    return {label, x, y};
  });
  return {data, at, layout: layout({hovermode: 'closest', xaxis: titled('along the mark / µm', square),
    yaxis: titled('ahead in the sense of spin / µm', {...square, scaleanchor: 'x'})})};
}

const figures = {cascade, orders, orders_polar: ordersPolar};
export const runUpFigure = (key, scene, runs, hidden) => figures[key](scene, runs, hidden);
