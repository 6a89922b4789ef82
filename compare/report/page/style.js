// Colours, the style of plots, and the line styles that distinguish runs. The module reads nothing from the document when it is
// loaded, so that figures can be tested without a browser.

// A custom property of the style sheet, kept until the theme changes.
const colors = new Map();
export const forgetColours = () => colors.clear();
export function css(name) {
  if (!colors.has(name)) colors.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
  return colors.get(name);
}

// Pictures on paper are small.
const onPaper = () => document.documentElement?.classList?.contains('printing');
const fontSize = () => (onPaper() ? 8 : 12);
// Plotly enlarges powers of ten on a logarithmic axis by a quarter.
const evenFont = ({type, exponentformat} = {}) => (type === 'log' && exponentformat === 'power' ? {tickfont: {size: fontSize() / 1.25}} : {});
export const axes = (extra) => ({gridcolor: css('--hair'), zerolinecolor: css('--line'), linecolor: css('--line'),
  tickcolor: css('--line'), ticks: 'outside', ticklen: 4, automargin: true, ...evenFont(extra), ...extra});
export const titled = (text, extra) => axes({title: {text, standoff: 8}, ...extra});
export const layout = (extra) => ({
  paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)', showlegend: false,
  font: {family: getComputedStyle(document.body).fontFamily, size: fontSize(), color: css('--soft')},
  margin: {l: 56, r: 12, t: 8, b: 40}, hovermode: 'x unified',
  hoverlabel: {bgcolor: css('--panel'), bordercolor: css('--line'), font: {color: css('--ink')}}, ...extra});
export const legendAbove = (extra) => ({orientation: 'h', x: 0, y: 1.02, yanchor: 'bottom', font: {color: css('--ink')}, ...extra});
// Notes above a plot, where they do not cover a curve, two in a line. notes: {text, color}. The margin has room for them.
export const notesAbove = (notes, {l = 56, r = 12, t = 8, b = 40} = {}) => ({margin: {l, r, t: t + 15 * Math.ceil(notes.length / 2), b},
  annotations: notes.length ? [{xref: 'paper', yref: 'paper', x: 0, y: 1, xanchor: 'left', yanchor: 'bottom', align: 'left', showarrow: false, font: {size: 12},
    text: notes.map(({text, color}, k) => `${k === 0 ? '' : k % 2 ? ', ' : '<br>'}<span style="color:${color}">${text}</span>`).join('')}] : []});
// A legend below the axis title, in as many rows as its names need. height: px to add to the bottom margin and to the plot's
// height, so that the axes keep their size.
export function legendBelow(names, width) {
  const letter = onPaper() ? 5 : 7, columns = Math.max(1, Math.floor(width / (letter * Math.max(1, ...names.map(({length}) => length)) + 50)));
  return {height: names.length ? 20 * Math.ceil(names.length / columns) : 0,
    legend: {orientation: 'h', x: 0, xref: 'container', y: 0, yref: 'container', yanchor: 'bottom', font: {color: css('--ink'), size: onPaper() ? 7 : 11}}};
}
// Makes room for such a legend.
export function growBy(plot, height) {
  plot.style.height = '';
  if (height) plot.style.height = `${plot.clientHeight + height}px`;
}
// Properties of a logarithmic axis of these values: a tick at every decade, or at every second or third one if there are many;
// within little more than a decade also at 2 and 5. most: the number of decades below the largest value that are shown.
export function decades(values, most = Infinity) {
  const given = values.filter((v) => v > 0), ends = [Math.min, Math.max].map((end) => Math.log10(given.reduce((a, b) => end(a, b), given[0] ?? 1)));
  const span = Math.min(most, ends[1] - ends[0]), range = most < ends[1] - ends[0] ? {range: [ends[1] - most, ends[1] + 0.05 * most]} : {};
  const isPlain = ends[1] - span > -3.5 && ends[1] < 4.5;
  return {type: 'log', ...(isPlain ? {exponentformat: 'none', separatethousands: true} : {exponentformat: 'power'}),
    dtick: span > 1.3 ? Math.ceil(span / 9) : 'D2', ...range};
}

// Red, green and blue of "#rrggbb", and of a share of the way through a palette of such colours.
export const parts = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
export function shade(share, palette) {
  const place = Math.min(Math.max(share, 0), 1) * (palette.length - 1), first = Math.min(Math.floor(place), palette.length - 2);
  const a = parts(palette[first]), b = parts(palette[first + 1]);
  return a.map((part, k) => Math.round(part + (place - first) * (b[k] - part)));
}
export const scaleOfColours = (palette) => palette.map((color, k) => [k / (palette.length - 1), color]);

// The name of a run for the reader.
export const nameOf = (label) => label === 'recomputed' ? 'native, recomputed here' : label;

// A run is distinguished by its colour, and also by dash, width and symbol. Native is in front.
const dashes = {native: 'solid', rigid: 'dash', coulomb: 'dashdot', cone: 'dot', 'cone-coulomb': 'longdashdot', 'cone-default': 'dot',
  shadow: 'dash', measured: 'longdash', recomputed: 'solid'};
const symbols = {native: 'circle', rigid: 'circle-open', coulomb: 'square-open', cone: 'triangle-up-open', 'cone-coulomb': 'triangle-down-open',
  'cone-default': 'star-open', shadow: 'diamond-open', measured: 'x-open', recomputed: 'hexagon-open'};
export const isRun = (label) => label in dashes;
export const isFront = (label) => label === 'native';
export const line = (label, front = isFront(label)) =>
  ({color: css(`--${label}`), width: front ? 2.4 : 1.4, dash: dashes[label] || 'dot', simplify: false});
export const symbol = (label) => symbols[label] || 'cross-open';

// number: rounded to `digits` significant digits, with thousands separators. short: the same without separators.
export const number = (value, digits) => Number(value.toPrecision(digits)).toLocaleString('en');
export const short = (value, digits = 3) => String(Number(value.toPrecision(digits)));
