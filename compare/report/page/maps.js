// The maps of a sweep, of an optimisation or of a linear analysis, in `into`: a bar of axes, and two or four maps, each
// with the list of figures that it can show. A grid is a picture with one pixel per cell and invisible marks for the
// pointer; other points are visible marks; a single key gives a curve. A figure may be "linear" (computed for every point,
// even if its run failed) and "signed" (its colours change at 0).
import {chosenPoint} from './chosen_point.js';
import {element} from './layout.js';
import {show} from './page.js';
import {colourOfWord, colourScale, gridPlaces, keyScale, logTicks} from './scales.js';
import {axes, css, growBy, layout, legendBelow, scaleOfColours, short} from './style.js';

// The figures that maps show first, if they are there; otherwise the first two.
const preferred = ['attractor', 'peak_impulse', 'linear: attractors', 'linear: rub, growth rate'];
const ordinals = ['first', 'second', 'third', 'fourth'];

// The keys, and for points that are no grid their values, with lengths up to 0.1 m in mm.
function inMillimetres({keys, values: points}) {
  const lists = keys.map((key, k) => key.values ?? points[k]);
  const isShort = keys.map(({unit}, k) => unit === 'm' && lists[k].every((v) => typeof v === 'number' && Math.abs(v) <= 0.1));
  const scaled = lists.map((list, k) => (isShort[k] ? list.map((v) => 1e3 * v) : list));
  return {keys: keys.map((key, k) => ({...key, ...(isShort[k] ? {unit: 'mm'} : {}), ...(key.values ? {values: scaled[k]} : {})})),
    points: points?.map((list, k) => (keys[k].values ? list : scaled[k]))};
}

export function mapsOf(into, data) {
  const {figures, columns, best, feasible, statuses = ['ok']} = data, grid = data.kind === 'grid', {keys, points: given} = inMillimetres(data);
  const values = given || gridPlaces(keys), status = data.status || values[0].map(() => 0);
  const choice = {x: 0, y: Math.min(1, keys.length - 1), fixed: keys.map(() => 0)};
  const failed = '#7f7f7f';
  const isFailed = (f, i) => status[i] !== 0 && !figures[f].linear;

  // ------------------------------------------------------------------ axes
  const title = (key) => key.name + (key.unit ? ` / ${key.unit}` : '');
  const scaleOf = (k) => (grid ? keyScale(keys[k]) : {at: (i) => values[k][i], axis: keys[k].log ? {type: 'log', ...logTicks(values[k])} : {}});
  const axisOf = (k, range) => axes(Object.assign({title: {text: title(keys[k]), standoff: 6}, zeroline: false},
    scaleOf(k).axis, range ? {range} : {}));

  const valueAt = (k, i) => (grid ? keys[k].values[values[k][i]] : values[k][i]);
  const shown = (v) => (v === null ? '' : typeof v === 'number' ? short(v, 6) : v);
  function words(i, f) {
    const lines = keys.map((key, k) => `${key.name} = ${shown(valueAt(k, i))} ${key.unit}`);
    const what = columns[f][i] === null && isFailed(f, i) ? statuses[status[i]] :
      `${figures[f].name} = ${columns[f][i] === null ? 'none' : shown(columns[f][i])} ${figures[f].unit}`;
    return [`<b>${what}</b>`, ...lines].join('<br>');
  }

  // Only on a sweep's own page: a click on a point, or its number, leads to its run.
  const every = data.every || 1, place = element('div', {class: 'chosen-point', role: 'group', 'aria-label': 'the run of a point'});
  const choosePoint = data.runs ? chosenPoint(place, data.runs, (point) => {
    const i = point / every;
    if (!Number.isInteger(i)) return [];
    return [...keys.map((key, k) => [key.name, `${shown(valueAt(k, i))} ${key.unit}`]), ['status', statuses[status[i]]]];
  }) : null;
  function showPoints(plot, points, figure) {
    show(plot, figure);
    if (!choosePoint) return;
    plot.removeAllListeners('plotly_click');
    plot.on('plotly_click', ({points: [first]}) => { if (first.curveNumber === 0) choosePoint(points[first.pointNumber] * every); });
  }

  // The points of the maps. In a grid these are the points whose other keys have the chosen values.
  function chosen() {
    const all = status.map((_, i) => i);
    if (!grid) return all;
    const others = keys.map((_, k) => k).filter((k) => k !== choice.x && k !== choice.y);
    return all.filter((i) => others.every((k) => values[k][i] === choice.fixed[k]));
  }

  // ------------------------------------------------------------------ plots
  function legendOf(colour, anyFailed) {
    const entry = (name, color, symbol = 'square') => ({type: 'scatter', x: [null], y: [null], mode: 'markers', name, marker: {symbol, size: 12, color}});
    return [...(colour.words || []).map((word) => entry(word, colourOfWord(word, colour.words))),
      ...(anyFailed ? [entry('failed', failed, feasible ? 'x' : 'square')] : []),
      ...(feasible?.includes(false) ? [entry('violates a constraint', css('--ink'), 'circle-open')] : []),
      ...(typeof best === 'number' ? [entry('best', css('--ink'), 'star')] : [])];
  }
  function barOf(colour, figure) {
    if (colour.words) return {};
    const ticks = {};
    if (colour.log) {
      const steps = Array.from({length: 6}, (_, k) => colour.low + (k / 5) * (colour.high - colour.low));
      Object.assign(ticks, {tickvals: steps, ticktext: steps.map((v) => short(10 ** v, 2))});
    }
    if (colour.constant) Object.assign(ticks, {tickvals: [colour.low], ticktext: [short(colour.low)]});
    return {colorscale: scaleOfColours(colour.palette), cmin: colour.low, cmax: colour.high, showscale: true,
      colorbar: Object.assign({title: {text: figure.unit}, thickness: 14, outlinewidth: 0}, ticks)};
  }

  function picture(points, f, colour, x, y) {
    const column = columns[f];
    const canvas = document.createElement('canvas');
    canvas.width = keys[choice.x].values.length;
    canvas.height = keys[choice.y].values.length;
    const pen = canvas.getContext('2d');
    points.forEach((i) => {
      const at = values[choice.y][i];
      pen.fillStyle = isFailed(f, i) ? failed : column[i] === null ? 'rgba(0,0,0,0)' : `rgb(${colour.of(column[i]).join()})`;
      pen.fillRect(values[choice.x][i], canvas.height - 1 - at, 1, 1);
    });
    return {source: canvas.toDataURL(), xref: 'x', yref: 'y', x: Math.min(x.from, x.to), y: Math.max(y.from, y.to),
      sizex: Math.abs(x.to - x.from), sizey: Math.abs(y.to - y.from), sizing: 'stretch', layer: 'above'};
  }

  function drawMap(plot, f) {
    const points = chosen(), column = columns[f], colour = colourScale(column, points, figures[f].signed);
    const x = scaleOf(choice.x), y = scaleOf(choice.y), anyFailed = points.some((i) => isFailed(f, i));
    const at = (scaleHere, k) => points.map((i) => scaleHere.at(grid ? values[k][i] : i));
    const symbol = feasible && points.map((i) => (i === best ? 'star' : status[i] ? 'x' : feasible[i] ? 'circle' : 'circle-open'));
    const marker = Object.assign({...(feasible ? {symbol, line: {width: points.map((i) => (feasible[i] ? 0 : 2))}} : {}),
      size: grid ? 6 : points.map((i) => (i === best ? 18 : 9)), opacity: grid ? 0 : 0.9, color: points.map((i) =>
      (isFailed(f, i) ? (colour.words || grid ? failed : null) : column[i] === null ? 'rgba(0,0,0,0)' :
        colour.words ? `rgb(${colour.of(column[i]).join()})` : colour.place(column[i])))}, barOf(colour, figures[f]));
    if (grid && !colour.words) marker.color = points.map((i) => (column[i] === null ? colour.low : colour.place(column[i])));
    const trace = {type: 'scatter', mode: 'markers', x: at(x, choice.x), y: at(y, choice.y), marker, showlegend: false,
      text: points.map((i) => words(i, f)), hovertemplate: '%{text}<extra></extra>'};
    const entries = legendOf(colour, anyFailed), {legend, height} = legendBelow(entries.map(({name}) => name), plot.clientWidth);
    growBy(plot, height);
    showPoints(plot, points, {data: [trace, ...entries], layout: layout({hovermode: 'closest', hoverdistance: grid ? -1 : 20, showlegend: entries.length > 0,
      legend, margin: {l: 64, r: 24, t: 10, b: 48 + height}, images: grid ? [picture(points, f, colour, x, y)] : [],
      xaxis: axisOf(choice.x, grid ? [x.from, x.to] : null), yaxis: axisOf(choice.y, grid ? [y.from, y.to] : null)})});
  }

  function drawCurve(plot, f) {
    const points = chosen(), x = scaleOf(0);
    const trace = {type: 'scatter', mode: figures[f].word || !grid ? 'markers' : 'lines+markers',
      x: points.map((i) => x.at(grid ? values[0][i] : i)), y: points.map((i) => columns[f][i]),
      text: points.map((i) => words(i, f)), hovertemplate: '%{text}<extra></extra>', line: {color: css('--native'), width: 1.5},
      marker: {color: css('--native'), size: 6}};
    showPoints(plot, points, {data: [trace], layout: layout({hovermode: 'closest', margin: {l: 64, r: 24, t: 10, b: 48}, xaxis: axisOf(0),
      yaxis: axes({title: {text: figures[f].name + (figures[f].unit ? ` / ${figures[f].unit}` : '')}, exponentformat: 'power'})})});
  }

  // ------------------------------------------------------------------ the choices
  const wanted = preferred.filter((name) => figures.some((figure) => figure.name === name));
  const maps = (wanted.length ? wanted : figures.slice(0, 2).map(({name}) => name)).map((first, k) => {
    const list = element('select', {class: 'figure', 'aria-label': `figure of the ${ordinals[k]} map`});
    figures.forEach((figure, f) => {
      if (columns[f].some((v) => v !== null)) list.add(new Option(figure.name, f, false, figure.name === first));
    });
    if (!list.options.length) list.add(new Option(figures[0].name, 0));
    list.addEventListener('change', () => draw());
    return {list, meaning: element('span', {class: 'meaning'}), plot: element('div', {class: 'plot'})};
  });

  const draw = () => maps.forEach(({list, meaning, plot}) => {
    const f = Number(list.value);
    meaning.textContent = figures[f].meaning;
    (keys.length > 1 ? drawMap : drawCurve)(plot, f);
  });

  function select(label, names, value, change) {
    const box = document.createElement('label'), list = document.createElement('select');
    names.forEach((name, k) => { list.add(new Option(name, k, false, k === value)); });
    list.addEventListener('change', () => change(Number(list.value)));
    box.append(`${label} `, list);
    return box;
  }

  const bar = element('div', {class: 'map-bar axes', role: 'group', 'aria-label': 'axes of the maps'});
  function axesBar() {
    const names = keys.map(title), boxes = [];
    const change = (which, other) => (k) => {
      if (choice[other] === k) choice[other] = choice[which];
      choice[which] = k;
      axesBar();
      draw();
    };
    if (keys.length > 1) {
      boxes.push(select('across', names, choice.x, change('x', 'y')), select('up', names, choice.y, change('y', 'x')));
    }
    if (grid) {
      keys.forEach((key, k) => {
        if (k === choice.x || k === choice.y) return;
        boxes.push(select(`${title(key)} =`, key.values.map(shown), choice.fixed[k], (at) => { choice.fixed[k] = at; draw(); }));
      });
    }
    bar.replaceChildren(...boxes);
  }

  into.append(bar, element('div', {class: 'plot-grid'}, ...maps.map(({list, meaning, plot}) =>
    element('figure', {class: 'tall'}, element('figcaption', {class: 'map-bar'}, list, meaning), plot))));
  if (choosePoint) into.append(place);
  axesBar();
  return draw;
}
