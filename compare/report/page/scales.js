// Scales of maps and of lines: the colour of a value, the positions of a key's values, and the points of a line that are drawn.
import {parts, shade, short} from './style.js';

const low2high = ['#440154', '#414487', '#2a788e', '#22a884', '#7ad151', '#fde725'];
const below2above = ['#2166ac', '#92c5de', '#f7f7f7', '#f4a582', '#b2182b'];
// A settled state has the same colour in every map, whether it was found by runs or by eigenvalues (attractor.h,
// rub_analysis.h). States that may coexist have the mean of their colours.
const states = {'no contact': '#c9d6e3', bouncing: '#aa3377', resting: '#8c6d31', 'synchronous rub': '#2f5fb3', 'forward rub': '#33a5c8',
  'backward whip': '#d62728', rolling: '#e8b800', unknown: '#8f8f8f', 'none stable': '#3b3b3b'};
// The colour of a word of a map, as "#rrggbb". Words other than the states above are coloured by their position in `words`.
export function colourOfWord(word, words) {
  const mixed = word.split(' + ').map((state) => states[state]);
  if (mixed.includes(undefined)) return kinds[words.indexOf(word) % kinds.length];
  const all = mixed.map(parts);
  const mean = [0, 1, 2].map((k) => Math.round(all.reduce((sum, part) => sum + part[k], 0) / all.length));
  return `#${mean.map((part) => part.toString(16).padStart(2, '0')).join('')}`;
}
export const kinds = ['#4477aa', '#ee6677', '#228833', '#ccbb44', '#66ccee', '#aa3377', '#bbbbbb', '#997700'];

// The colour scale of the chosen values of a column. of(value): red, green, blue. Numbers over several decades have a
// logarithmic scale; each word has its own colour. signed: the colours change at 0.
export function colourScale(column, chosen, signed) {
  const given = chosen.map((i) => column[i]).filter((v) => v !== null);
  if (given.some((v) => typeof v === 'string')) {
    const words = [...new Set(column.filter((v) => v !== null))].sort();
    return {words, of: (v) => parts(colourOfWord(v, words))};
  }
  let low = given.length ? Infinity : 0, high = given.length ? -Infinity : 1;
  for (const v of given) { low = Math.min(low, v); high = Math.max(high, v); }
  if (signed) { high = Math.max(Math.abs(low), Math.abs(high)); low = -high; }
  const palette = signed ? below2above : low2high, log = low > 0 && high > 100 * low;
  const place = (v) => (log ? Math.log10(v) : v), span = place(high) - place(low) || 1;
  return {log, palette, constant: low === high, low: place(low), high: place(low) + span, place, of: (v) => shade((place(v) - place(low)) / span, palette)};
}

// The indices of the points of a complete grid, one list for each key; the last key varies fastest.
export function gridPlaces(keys) {
  const counts = keys.map(({values}) => values.length), all = counts.reduce((product, count) => product * count, 1);
  let stride = all;
  return counts.map((count) => {
    stride /= count;
    return Array.from({length: all}, (_, i) => Math.floor(i / stride) % count);
  });
}

// Ticks of a logarithmic axis at 1, 2 and 5 of each decade; over several decades only at 1.
export function logTicks(values) {
  const given = values.filter((v) => v > 0), low = Math.min(...given), high = Math.max(...given), ticks = [];
  const steps = high > 100 * low ? [1] : [1, 2, 5];
  for (let decade = Math.floor(Math.log10(low)); given.length && decade <= Math.ceil(Math.log10(high)); ++decade)
    ticks.push(...steps.map((step) => Number(`${step}e${decade}`)));
  const isPlain = ticks.every((v) => v > 9e-4 && v < 2e7);
  return {tickvals: ticks, ticktext: ticks.map((v) => (isPlain ? v.toLocaleString('en') : `${v.toExponential(0).split('e')[0] === '1' ? '' : `${v.toExponential(0)[0]}·`}` +
    `10<sup>${String(Math.floor(Math.log10(v) + 1e-9)).replace('-', '−')}</sup>`))};
}

// The positions of the values of a grid's key: the values themselves if they are evenly spaced, otherwise their indices.
export function keyScale({values: list, even}) {
  const itself = even && list.length > 1;
  const first = itself ? list[0] : 0, width = itself ? (list[list.length - 1] - first) / (list.length - 1) : 1;
  const at = (place) => first + width * place;
  const every = Math.max(1, Math.ceil(list.length / 8)), ticks = list.map((_, i) => i).filter((i) => i % every === 0);
  const named = itself ? {} : {tickvals: ticks.map(at), ticktext: ticks.map((i) => (typeof list[i] === 'number' ? short(list[i]) : list[i]))};
  return {at, width, from: at(-0.5), to: at(list.length - 0.5), axis: named};
}

// The number of elements of `all` (ascending) that are at most `value`.
export function countUntil(all, value, of = (x) => x) {
  let low = 0, high = all.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (of(all[middle]) <= value) low = middle + 1; else high = middle;
  }
  return low;
}

// Keeps the first, least, greatest and last sample of each of `buckets` equal parts of the time, in order, so that no spike is
// lost and the line between two parts is exact.
export function thinned(t, y, buckets) {
  const n = t.length;
  if (n <= 4 * buckets) return {t, y};
  const width = (t[n - 1] - t[0]) / buckets, kept = [];
  for (let first = 0, b = 1; first < n; ++b) {
    let low = first, high = first, last = first;
    for (let i = first; i < n && (b >= buckets || t[i] < t[0] + b * width); ++i) {
      if (y[i] < y[low]) low = i;
      if (y[i] > y[high]) high = i;
      last = i;
    }
    if (b < buckets && t[first] >= t[0] + b * width) continue;  // nothing in this part
    kept.push(...new Set([first, Math.min(low, high), Math.max(low, high), last]));
    first = last + 1;
  }
  return {t: kept.map((i) => t[i]), y: kept.map((i) => y[i])};
}

// A line {t, y} with gaps at the holes [from, to].
export function opened({t, y}, holes = []) {
  if (!holes.length) return {t, y};
  const points = t.map((time, k) => [time, y[k]]).filter(([time]) => !holes.some(([from, to]) => time > from && time < to));
  for (const [from, to] of holes) points.push([0.5 * (from + to), null]);
  points.sort((a, b) => a[0] - b[0]);
  return {t: points.map((p) => p[0]), y: points.map((p) => p[1])};
}

// Points of a curve in the plane at ascending times, with a gap for every hole between two of them.
export function openedCurve(times, points, holes = []) {
  return points.flatMap((point, k) => (k > 0 && holes.some(([from, to]) => times[k - 1] <= from && times[k] >= to) ? [[null, null], point] : [point]));
}
