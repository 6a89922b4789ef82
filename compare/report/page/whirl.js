// Plotly figures of whirl: full spectrum (forward above 0, backward below), waterfall, Poincaré points, and each run's
// distance from the first.
import {micro} from './factors.js';
import {axes, css, decades, layout, line, scaleOfColours, shade, short, symbol, titled} from './style.js';

const low2high = ['#fcfdbf', '#feb078', '#f1605d', '#b73779', '#721f81', '#2c115f', '#000004'];
const trace = (side, x, y, more) => ({x, y, name: side.label, meta: side.label, type: 'scatter', mode: 'lines',
  line: line(side.label), ...more});
const inMicrons = (list) => list.map((value) => micro * value);
const have = (scene, what) => [...scene.sides].reverse().filter((side) => side.whirl[what]);

const kDecades = 8;  // of a spectrum; lines below them are round-off

function spectrum(scene) {
  const marks = [-1, 1].map((k) => ({type: 'line', x0: k * scene.spin, x1: k * scene.spin, y0: 0, y1: 1, yref: 'paper',
    line: {color: css('--soft'), width: 1, dash: 'dash'}, layer: 'below'}));
  const data = have(scene, 'spectrum').map((side) => trace(side, side.whirl.spectrum.x, inMicrons(side.whirl.spectrum.y),
    {hovertemplate: `%{x:.5g} Hz: %{y:.4g} µm<extra>${side.label}</extra>`}));
  return {data,
  layout: layout({hovermode: 'closest', margin: {l: 56, r: 12, t: 22, b: 40}, shapes: scene.spin ? marks : [],
    annotations: scene.spin ? [-1, 1].map((k) => ({x: k * scene.spin, y: 1, yref: 'paper', yanchor: 'bottom', showarrow: false,
      text: k > 0 ? '+1×' : '−1×', font: {size: 11, color: css('--soft')}})) : [],
    xaxis: titled('backward   ←   whirl / Hz   →   forward'), yaxis: titled('µm', decades(data.flatMap(({y}) => y), kDecades))})};
}

// One pixel per cell; time increases upwards.
function picture(w) {
  const canvas = document.createElement('canvas'), bytes = Uint8Array.from(atob(w.levels), (c) => c.charCodeAt(0));
  canvas.width = w.columns;
  canvas.height = w.rows;
  const pen = canvas.getContext('2d'), image = pen.createImageData(w.columns, w.rows);
  bytes.forEach((level, i) => {
    const row = w.rows - 1 - Math.floor(i / w.columns);
    image.data.set([...shade(level / 255, low2high), 255], 4 * (row * w.columns + (i % w.columns)));
  });
  pen.putImageData(image, 0, 0);
  return canvas.toDataURL();
}
function waterfall(scene, _range, hidden) {
  const side = scene.sides.find((s) => s.whirl.waterfall && !hidden.has(s.label));
  if (!side) return {data: [], layout: layout({})};
  const w = side.whirl.waterfall, half = w.rows > 1 ? 0.5 * (w.t[1] - w.t[0]) / (w.rows - 1) : 0.5 * w.t[0];
  const bottom = w.t[0] - half, top = w.t[1] + half;
  const ticks = [0, 1, 2, 3, 4].map((k) => w.low + (k / 4) * (w.high - w.low));
  return {data: [{x: [null], y: [null], type: 'scatter', mode: 'markers', showlegend: false, hoverinfo: 'skip',
    marker: {color: [0], colorscale: scaleOfColours(low2high), cmin: w.low, cmax: w.high, showscale: true,
      colorbar: {title: {text: 'µm'}, thickness: 12, outlinewidth: 0, tickvals: ticks, ticktext: ticks.map((v) => short(micro * 10 ** v, 2))}}}],
  layout: layout({hovermode: false, margin: {l: 56, r: 16, t: 24, b: 44},
    images: [{source: picture(w), xref: 'x', yref: 'y', x: w.f[0], y: top, sizex: w.f[1] - w.f[0], sizey: top - bottom, sizing: 'stretch', layer: 'below'}],
    annotations: [{text: side.label, xref: 'paper', yref: 'paper', x: 0, y: 1, xanchor: 'left', yanchor: 'bottom', showarrow: false, font: {color: css(`--${side.label}`), size: 12}}],
    xaxis: titled('backward   ←   whirl / Hz   →   forward', {range: w.f.slice()}), yaxis: titled('t / s', {range: [bottom, top]})})};
}

// [range of x, range of y] around the points, at least a tenth of their largest distance from the centre wide, so that points
// that are nearly equal appear as one point and not as a cloud. Null if there are no points.
export function ranges(points) {
  if (!points.length) return null;
  const end = (of, value) => points.reduce((best, p) => of(best, value(p)), value(points[0]));
  const low = [0, 1].map((c) => end(Math.min, (p) => p[c])), high = [0, 1].map((c) => end(Math.max, (p) => p[c]));
  const width = Math.max(1.1 * (high[0] - low[0]), 1.1 * (high[1] - low[1]), 0.1 * end(Math.max, (p) => Math.hypot(...p)));
  return width > 0 ? [0, 1].map((c) => [0.5 * (low[c] + high[c] - width), 0.5 * (low[c] + high[c] + width)]) : null;
}

function poincare(scene) {
  const points = have(scene, 'poincare').flatMap(({whirl: {poincare: {x, y}}}) => x.map((v, k) => [micro * v, micro * y[k]]));
  const [x, y] = ranges(points) || [null, null];
  return {data: have(scene, 'poincare').map((side) => ({...trace(side, inMicrons(side.whirl.poincare.x), inMicrons(side.whirl.poincare.y)), mode: 'markers',
    marker: {color: css(`--${side.label}`), size: side.label === 'native' ? 7 : 8, symbol: symbol(side.label), opacity: 0.8},
    hovertemplate: `(%{x:.5g}, %{y:.5g}) µm<extra>${side.label}</extra>`})),
  layout: layout({hovermode: 'closest', xaxis: titled('x / µm', {automargin: false, constrain: 'domain', ...(x ? {range: x} : {})}),
    yaxis: titled('y / µm', {automargin: false, constrain: 'domain', scaleanchor: 'x', ...(y ? {range: y} : {})})})};
}

function residual(scene, range) {
  const data = have(scene, 'residual').map((side) => trace(side, side.whirl.residual.x, side.whirl.residual.y.map((y) => micro * y || null),
    {hovertemplate: `%{y:.4g} µm<extra>${side.label}</extra>`}));
  return {data,
  layout: layout({hovermode: 'x unified', xaxis: axes({title: {text: 't / s', standoff: 6}, range: range.slice(), hoverformat: '.6f'}),
    yaxis: axes(decades(data.flatMap(({y}) => y)))})};
}

const figures = {spectrum, waterfall, poincare, residual};
// hidden: labels of hidden runs. range: of time.
export const whirlFigure = (scene, key, range, hidden) => figures[key](scene, range, hidden);
