// The units of a page: SI with prefixes, in which everything is laid out, or mm and N, or mil and lbf. Finished texts, tables
// and figures are converted, so that a part of a page is written only once, in SI.

const kPound = 4.4482216152605, kInch = 0.0254;
// Kind and size in SI of each unit that may be converted.
const known = Object.entries({
  length: {pm: 1e-12, nm: 1e-9, µm: 1e-6, mm: 1e-3, m: 1}, speed: {'µm/s': 1e-6, 'mm/s': 1e-3, 'm/s': 1}, force: {mN: 1e-3, N: 1, kN: 1e3},
  impulse: {'µN s': 1e-6, 'mN s': 1e-3, 'N s': 1}, torque: {'mN m': 1e-3, 'N m': 1}, stiffness: {'N/m': 1}, damping: {'N s/m': 1}, compliance: {'µm/N': 1e-6},
}).flatMap(([kind, sizes]) => Object.entries(sizes).map(([unit, size]) => [unit, {kind, size}]));
const kinds = new Map(known);

// Each system has a name for the reader, and for each kind of quantity the unit and its size in SI. SI changes nothing.
export const systems = {
  si: {name: 'SI'},
  mm: {name: 'mm, N', length: ['mm', 1e-3], speed: ['mm/s', 1e-3], force: ['N', 1], impulse: ['N s', 1], torque: ['N mm', 1e-3],
    stiffness: ['N/mm', 1e3], damping: ['N s/mm', 1e3], compliance: ['mm/N', 1e-3]},
  mil: {name: 'mil, lbf', length: ['mil', 1e-3 * kInch], speed: ['in/s', kInch], force: ['lbf', kPound], impulse: ['lbf s', kPound],
    torque: ['lbf in', kPound * kInch], stiffness: ['lbf/in', kPound / kInch], damping: ['lbf s/in', kPound / kInch], compliance: ['mil/lbf', 1e-3 * kInch / kPound]},
};
let chosen = systems.si;
export const choose = (name) => { chosen = systems[name] ?? systems.si; };

// {unit, factor} for the conversion of a unit; null if it is not converted.
export function conversion(unit) {
  const of = kinds.get(unit), into = of && chosen[of.kind];
  return into ? {unit: into[0], factor: of.size / into[1]} : null;
}

const units = [...kinds.keys()].sort((a, b) => b.length - a.length).join('|');
const figure = '[-−+]?\\d[\\d,]*(?:\\.\\d+)?(?:e[-+]?\\d+)?';
// A number with its unit, and numbers beside it that share the unit.
const withUnit = new RegExp(`(?<![\\w.])(?:(${figure})( to | ± ))?(${figure})( )(${units})(?![\\w/²])(?:( instead of | where [a-z ]+ gives )(${figure})(?! ?(?:${units})))?`, 'g');
const alone = new RegExp(`^${figure}$`);
const atEnd = new RegExp(`^((?:.*(?:/ |, )|\\s*)\\(?)(${units})(\\)?\\s*)$`);

// Multiplies a number in a text; it keeps its number of digits, but at least three.
function times(text, factor) {
  if (factor === 1) return text;
  const plain = text.replace(/,/g, '').replace('−', '-'), digits = plain.replace(/e.*$/, '').replace(/\D/g, '').replace(/^0+/, '').length;
  const made = String(Number((Number(plain) * factor).toPrecision(Math.max(3, digits))));
  return (plain.startsWith('+') ? '+' : '') + (text.startsWith('−') ? made.replace('-', '−') : made);
}

// A text in the chosen units; own: the unit of a number that stands alone, from its column or its row.
export function inUnits(text, own) {
  if (chosen === systems.si) return text;
  const alike = own && conversion(own);
  if (alike && alone.test(text)) return times(text, alike.factor);
  return text.replace(withUnit, (whole, before, between, value, blank, unit, instead, other) => {
    const to = conversion(unit);
    if (!to) return whole;
    return `${before ? times(before, to.factor) + between : ''}${times(value, to.factor)}${blank}${to.unit}${instead ? instead + times(other, to.factor) : ''}`;
  });
}

// The unit at the end of a heading or of a title: "amplitude / µm", "mean normal force, N", "before / (m/s)".
export const unitOf = (title) => title?.match(atEnd)?.[2];
export const headingInUnits = (title) => title.replace(atEnd, (whole, before, unit, after) => {
  const to = conversion(unit);
  return to ? before + (to.unit.includes('/') && before.endsWith('/ ') ? `(${to.unit})` : to.unit) + after : whole;
});

// ---------------------------------------------------------------- texts

const kSkipped = 'pre, code, script, .plot, .player, .transport, .what-if, .map-set, .save';
const written = new Map();  // the text in SI of each node that was converted
export const siText = (node) => (node.nodeType === 3 ? written.get(node) ?? node.data : [...node.childNodes].map(siText).join(''));
const isHeading = (element) => element.matches('th, figcaption .unit');

const headsOf = (cell) => [...(cell.closest('table').tHead?.rows[0]?.cells ?? [])].map(siText);

// The unit of a number in a table stands in a column "unit", in the heading of its column, or in the heading of its row.
function unitBeside(cell) {
  const heads = headsOf(cell), column = heads.indexOf('unit'), {cells} = cell.parentElement;
  return column >= 0 ? siText(cells[column]) : unitOf(heads[cell.cellIndex]) ?? (cells[0] === cell ? undefined : unitOf(siText(cells[0])));
}

// All texts below an element.
export function convertTexts(root) {
  const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT), nodes = [];
  while (walker.nextNode()) if (walker.currentNode.data.trim() && !walker.currentNode.parentElement.closest(kSkipped)) nodes.push(walker.currentNode);
  for (const node of nodes) {
    const element = node.parentElement, si = siText(node), cell = element.closest('td');
    const made = isHeading(element) || (cell && headsOf(cell)[cell.cellIndex] === 'unit') ? headingInUnits(inUnits(si)) : inUnits(si, cell ? unitBeside(cell) : undefined);
    if (made === node.data) continue;
    written.set(node, si);
    node.data = made;
  }
}

// ---------------------------------------------------------------- figures of plotly

const scaled = (list, factor) => (list ? Array.from(list, (value) => (typeof value === 'number' ? factor * value : value)) : list);
const nameOf = (ref, letter) => `${letter}axis${(ref ?? letter).slice(1)}`;

// The text of a hover box, and the numbers that appear only there.
const shownValue = new RegExp(`%\\{(\\w+)(?:\\[(\\d+)\\])?(:[^}]*)?\\}(\\)?) (${units})(?![\\w/])`, 'g');
function hoverInUnits({hovertemplate, customdata}) {
  const factors = new Map();
  const words = hovertemplate?.replace(shownValue, (whole, name, index, format = '', after, unit) => {
    const to = conversion(unit);
    if (!to) return whole;
    if (name === 'customdata') factors.set(index === undefined ? null : Number(index), to.factor);
    return `%{${name}${index === undefined ? '' : `[${index}]`}${format}}${after} ${to.unit}`;
  });
  const value = (one, key) => (typeof one === 'number' && factors.has(key) ? factors.get(key) * one : one);
  return {...(words && {hovertemplate: words}), ...(factors.size && {customdata: Array.from(customdata, (row) => (Array.isArray(row) ? row.map(value) : value(row, null)))})};
}

function colorbarInUnits({marker}) {
  const bar = marker?.colorbar, to = bar && conversion(bar.title?.text);
  return to ? {marker: {...marker, colorbar: {...bar, title: {text: to.unit}, ticktext: bar.ticktext.map((text) => times(text, to.factor))}}} : {};
}

// caption: the unit of an ordinate without a title. Returns {data, layout, factors: of x and y}.
export function figureInUnits({data, layout}, caption) {
  if (chosen === systems.si) return {data, layout, factors: {x: 1, y: 1}};
  const factors = {}, made = {...layout}, factorOf = (ref, letter) => (/paper|domain|pixel/.test(ref ?? '') ? 1 : factors[nameOf(ref, letter)] ?? 1);
  for (const [name, axis] of Object.entries(layout)) {
    if (!/^[xy]axis\d*$/.test(name)) continue;
    const title = axis.title?.text, to = conversion(title ? unitOf(title) : name.startsWith('y') ? caption : undefined);
    if (!to) continue;
    factors[name] = to.factor;
    const shift = Math.log10(to.factor), log = axis.type === 'log';
    made[name] = {...axis, ...(title && {title: {...axis.title, text: headingInUnits(title)}}), ...(axis.tickvals && {tickvals: scaled(axis.tickvals, to.factor)}),
      ...(axis.range && {range: axis.range.map((end) => (log ? end + shift : end * to.factor))}), ...(axis.dtick && !log && {dtick: undefined})};
  }
  // Places of annotations on a logarithmic axis are logarithms.
  const place = (value, ref, letter, isLog) => {
    const factor = factorOf(ref, letter);
    return typeof value !== 'number' || factor === 1 ? value : isLog && layout[nameOf(ref, letter)]?.type === 'log' ? value + Math.log10(factor) : value * factor;
  };
  const placed = (one, keys, isLog) => ({...one, ...Object.fromEntries(keys.filter(([key]) => key in one).map(([key, ref, letter]) => [key, place(one[key], one[ref], letter, isLog)]))});
  const path = (one) => (one.path ? {path: one.path.replace(/(-?[\d.e-]+),(-?[\d.e-]+)/g, (_, x, y) =>
    `${place(Number(x), one.xref, 'x')},${place(Number(y), one.yref, 'y')}`)} : {});
  const ends = ['0', '1'].flatMap((end) => ['x', 'y'].map((letter) => [letter + end, `${letter}ref`, letter]));
  const both = ['x', 'y'].map((letter) => [letter, `${letter}ref`, letter]);
  const tails = ['x', 'y'].map((letter) => [`a${letter}`, `a${letter}ref`, letter]);
  made.shapes = layout.shapes?.map((one) => ({...placed(one, ends), ...path(one)}));
  made.annotations = layout.annotations?.map((one) => ({...placed(one, one.axref ? [...both, ...tails] : both, true), text: inUnits(one.text)}));
  made.images = layout.images?.map((one) => placed(one, [...both, ['sizex', 'xref', 'x'], ['sizey', 'yref', 'y']]));
  const textOf = ({text}) => (text ? {text: Array.isArray(text) ? text.map((one) => inUnits(one)) : inUnits(text)} : {});
  return {layout: made, factors: {x: factorOf('x', 'x'), y: factorOf('y', 'y')}, data: data.map((trace) => ({...trace, x: scaled(trace.x, factorOf(trace.xaxis, 'x')),
    y: scaled(trace.y, factorOf(trace.yaxis, 'y')), ...hoverInUnits(trace), ...colorbarInUnits(trace), ...textOf(trace)}))};
}
