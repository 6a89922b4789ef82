// The free rotor as plotly takes it, from {campbell, shapes} (modes_page.h): Campbell diagram with the scene's speed,
// damping ratios, mode shapes at rest and whirl shapes at speed.
import {axes, css, layout, legendAbove as legend, number} from './style.js';

// ------------------------------------------------------------------ against the spin speed
// Sense of a whirl: colour, dash and mark.
const senses = {forward: {color: '--forward', dash: 'solid', symbol: 'circle'},
  backward: {color: '--backward', dash: 'dash', symbol: 'diamond-open'},
  overdamped: {color: '--soft', dash: 'dot', symbol: 'x'}, rigid: {color: '--soft', dash: 'dot', symbol: 'x'}};

const once = () => {
  const seen = new Set();
  return (name) => !seen.has(name) && Boolean(seen.add(name));
};

// A value of all pieces against speed; what grows lies thick on top.
function branches(campbell, key) {
  const first = once();
  const trace = (piece, y, name, line) => ({x: piece.speed, y, name, legendgroup: name, showlegend: first(name),
    type: 'scatter', mode: 'lines', line, customdata: piece.speed.map((_, k) => [piece.frequency[k], piece.damping[k]]),
    hovertemplate: `%{x:.5g} rpm: %{customdata[0]:.5g} Hz, damping %{customdata[1]:.3g} %<extra>${name}</extra>`});
  // Backward whirl, dashed, over the forward whirl that it may coincide with.
  const order = [...campbell.pieces].sort((a, b) => (a.sense === 'backward') - (b.sense === 'backward'));
  const plain = order.map((piece) => {
    const {color, dash} = senses[piece.sense];
    return trace(piece, piece[key], piece.sense, {color: css(color), width: 2, dash});
  });
  const growing = campbell.pieces.filter((piece) => piece.damping.some((d) => d < 0)).map((piece) =>
    trace(piece, piece[key].map((y, k) => (piece.damping[k] < 0 ? y : null)), 'growing',
      {color: css('--bad'), width: 4}));
  return [...plain, ...growing];
}

const across = (x, color, dash) => ({type: 'line', x0: x, x1: x, yref: 'paper', y0: 0, y1: 1,
  line: {color: css(color), width: 1.2, dash}});
const besides = (campbell, x, text, color, y) => ({x, xref: 'x', y, yref: 'paper', text, showarrow: false,
  xanchor: x > 0.7 * campbell.top ? 'right' : 'left', xshift: x > 0.7 * campbell.top ? -5 : 5, yanchor: 'top',
  bgcolor: css('--paper'), font: {color: css(color), size: 12}});

// The scene's speed and the threshold of stability, with the unstable range behind everything.
function marks(campbell, lettered) {
  const lines = [], notes = [];
  if (campbell.running > 0 && campbell.running <= campbell.top) {
    lines.push(across(campbell.running, '--soft', 'dot'));
    if (lettered) notes.push(besides(campbell, campbell.running, "scene's speed", '--soft', 1));
  }
  const threshold = campbell.threshold;
  if (threshold !== null && threshold <= campbell.top) {
    lines.push({type: 'rect', x0: threshold, x1: campbell.top, yref: 'paper', y0: 0, y1: 1, layer: 'below',
      fillcolor: css('--bad-bg'), opacity: 0.7, line: {width: 0}}, across(threshold, '--bad', 'dash'));
    if (lettered) notes.push(besides(campbell, threshold, `unstable above ${number(threshold, 5)} rpm`, '--bad', 0.93));
  }
  return {shapes: lines, annotations: notes};
}
const speedAxis = (campbell) => axes({title: {text: 'spin speed / rpm', standoff: 6}, range: [0, campbell.top],
  exponentformat: 'none', separatethousands: true, nticks: 8});
const valueAxis = (extra) => axes(Object.assign({automargin: false}, extra));

// High enough for 1x and the two lowest modes of either sense; a double click shows the rest.
function ceiling(campbell) {
  const highest = campbell.pieces.filter((piece) => piece.speed[0] === 0)
    .map((piece) => Math.max(...piece.frequency)).sort((a, b) => a - b);
  return 1.08 * Math.max(campbell.top / 60, ...highest.slice(0, 4));
}

function campbellFigure({campbell}) {
  const {top, critical, torsion, operating} = campbell, high = ceiling(campbell);
  const ray = (times, dash) => ({type: 'scatter', x: [0, top], y: [0, times * top / 60], name: `${times}×`, mode: 'lines',
    line: {color: css('--ink'), width: 1.2, dash}, hoverinfo: 'skip'});
  const speeds = {type: 'scatter', x: critical, y: critical.map((n) => n / 60), name: 'critical speed',
    mode: 'markers+text', text: critical.map((n) => `${number(n, 4)} rpm`),
    // On either side of 1x in turn: critical speeds come in near pairs.
    textposition: critical.map((n, k) => (critical.length > 1 && k % 2 === 0 ? 'top left' : n > 0.75 * top ? 'bottom left' : 'bottom right')),
    textfont: {color: css('--ink')}, cliponaxis: false,
    marker: {color: css('--paper'), size: 10, line: {color: css('--ink'), width: 2}},
    hovertemplate: 'critical: %{x:.6g} rpm, %{y:.5g} Hz<extra></extra>'};
  const first = once();
  const twists = torsion.map((f) => ({type: 'scatter', x: [0, top], y: [f, f], name: 'torsion', legendgroup: 'torsion',
    showlegend: first('torsion'), mode: 'lines', line: {color: css('--mode-4'), width: 1.6, dash: 'dashdot'},
    hovertemplate: 'torsion: %{y:.5g} Hz<extra></extra>'}));
  const here = ['forward', 'backward'].map((sense) => {
    const list = operating.filter((mode) => mode.sense === sense);
    return {type: 'scatter', x: list.map(() => campbell.running), y: list.map((mode) => mode.frequency), mode: 'markers',
      name: `${sense} at the scene's speed`, showlegend: false, cliponaxis: false,
      marker: {color: css(senses[sense].color), size: 9, symbol: senses[sense].symbol, line: {width: 2}},
      customdata: list.map((mode) => mode.damping),
      hovertemplate: `at the scene's speed: %{y:.5g} Hz, damping %{customdata:.3g} %<extra>${sense}</extra>`};
  });
  const {shapes, annotations} = marks(campbell, true);
  const above = torsion.filter((f) => f > high);
  if (above.length) {
    annotations.push({xref: 'paper', x: 1, xanchor: 'right', yref: 'paper', y: 0, yanchor: 'bottom', showarrow: false, bgcolor: css('--paper'),
      text: `↑ torsion: ${above.slice(0, 3).map((f) => number(f, 4)).join(', ')}${above.length > 3 ? ', …' : ''} Hz`, font: {color: css('--mode-4'), size: 12}});
  }
  return {data: [...branches(campbell, 'frequency'), ray(1, 'longdashdot'), ray(2, 'dot'), ...twists, ...here, speeds],
    layout: layout({shapes, annotations, hovermode: 'closest', showlegend: true, legend: legend(),
      margin: {l: 64, r: 24, t: 30, b: 44}, xaxis: speedAxis(campbell),
      yaxis: valueAxis({title: {text: 'whirl frequency / Hz', standoff: 8}, range: [0, high]})})};
}

function dampingFigure({campbell}) {
  const most = Math.max(0, ...campbell.pieces.flatMap((piece) => piece.damping));
  const least = Math.min(0, ...campbell.pieces.flatMap((piece) => piece.damping));
  const room = 0.1 * (most - least) || 0.1;
  return {data: branches(campbell, 'damping'), layout: layout({...marks(campbell, false), hovermode: 'closest',
    margin: {l: 64, r: 24, t: 8, b: 44}, xaxis: speedAxis(campbell),
    yaxis: valueAxis({title: {text: 'damping ratio / %', standoff: 8}, range: [least - room, most + room],
      zeroline: true, zerolinecolor: css('--soft')})})};
}

// ------------------------------------------------------------------ along the shaft
const kinds = {disc: ['square', '--ink'], bearing: ['triangle-up', '--good'], contact: ['circle-open', '--bad'],
  drive: ['star', '--mode-4'], magnetic_bearing: ['diamond', '--mode-5'], force: ['arrow-bar-down', '--backward']};

const length = (shapes) => shapes.z[shapes.z.length - 1];
const alongShaft = (shapes, y, name, color, dash, visible, words = '') => ({x: shapes.z, y, name, type: 'scatter', mode: 'lines',
  ...(visible ? {} : {visible: 'legendonly'}), line: {color: css(`--mode-${color}`), width: 2.2, dash},
  hovertemplate: `z = %{x:.1f} mm: %{y:.3f}${words}<extra>${name}</extra>`});
const colorOf = (mode) => ((mode.number - 1) % 6) + 1;

// At rest: colour the mode, dashes the plane y where it differs.
const restTraces = (shapes) => shapes.modes.map((mode) => alongShaft(shapes, mode.shape,
  `mode ${mode.number}${shapes.same_planes ? '' : ` ${mode.plane}`}, ${number(mode.frequency, 4)} Hz`,
  colorOf(mode), mode.plane === 'y' ? 'dash' : 'solid', mode.number <= 4));

// At speed: colour the mode, dashes backward whirl.
const whirlTraces = (shapes) => shapes.whirl.map((mode) => alongShaft(shapes, mode.shape,
  `${mode.sense} ${mode.number}, ${number(mode.frequency, 4)} Hz`, colorOf(mode),
  mode.sense === 'backward' ? 'dash' : 'solid', mode.number <= 2,
  mode.roundness < 0.999 ? `<br>half-axes 1 : ${mode.roundness.toFixed(3)}` : ''));

const tallest = (shapes) => Math.max(...shapes.sections.flatMap((s) => [s.diameter / 2, s.end_diameter / 2]), ...shapes.discs.map((d) => d.radius || 0));
const radiusAt = (shapes, z) => Math.max(0, ...shapes.sections.filter((s) => s.from <= z && z <= s.to).map((s) =>
  (s.diameter + (s.end_diameter - s.diameter) * (z - s.from) / (s.to - s.from)) / 2));

// The rotor itself as rectangles and cones on the lower axes, and a hairline through the modes at each station.
function rotorShapes(shapes) {
  const box = (x0, x1, radius, fill) => ({type: 'rect', yref: 'y2', layer: 'between', x0, x1, y0: -radius, y1: radius, fillcolor: css(fill),
    line: {color: css('--soft'), width: 1}});
  const cone = (s) => ({type: 'path', yref: 'y2', layer: 'between', fillcolor: css('--line'), line: {color: css('--soft'), width: 1},
    path: `M${s.from},${s.diameter / 2}L${s.to},${s.end_diameter / 2}L${s.to},${-s.end_diameter / 2}L${s.from},${-s.diameter / 2}Z`});
  const half = 0.006 * length(shapes);
  return [
    ...shapes.stations.map(({z}) => ({type: 'line', x0: z, x1: z, yref: 'paper', y0: 0.3, y1: 1, layer: 'below',
      line: {color: css('--line'), width: 1}})),
    ...shapes.sections.map((s) => s.diameter === s.end_diameter ? box(s.from, s.to, s.diameter / 2, '--line') : cone(s)),
    ...shapes.discs.map((d) => box(d.z - half, d.z + half, d.radius || 0.6 * tallest(shapes), '--soft'))];
}

// One trace of symbols: bearings from below, all else from above the shaft.
function stationTrace(shapes) {
  const shown = shapes.stations.filter(({kind}) => kind !== 'disc');
  const high = 0.22 * tallest(shapes);
  const y = ({kind, z}) => (kind === 'bearing' ? -radiusAt(shapes, z) - high : kind === 'contact' || kind === 'drive' ? 0 : radiusAt(shapes, z) + high);
  return {x: shown.map(({z}) => z), y: shown.map(y), yaxis: 'y2', type: 'scatter', mode: 'markers', showlegend: false,
    text: shown.map(({name}) => name), hovertemplate: '%{text}, z = %{x:.1f} mm<extra></extra>', cliponaxis: false,
    marker: {size: shown.map(({kind}) => (kind === 'contact' ? 17 : 12)), symbol: shown.map(({kind}) => kinds[kind][0]),
      color: shown.map(({kind}) => css(kinds[kind][1])), line: {width: shown.map(({kind}) => (kind === 'contact' ? 2.5 : 0))}}};
}

// Names under the rotor, each on the first line where it has room.
function stationNames(shapes, width) {
  const ends = [];
  return shapes.stations.map(({kind, name, z}) => {
    const middle = (z / length(shapes)) * width, half = 3.6 * name.length + 6;
    let row = ends.findIndex((end) => end < middle - half);
    if (row < 0) row = ends.length;
    ends[row] = middle + half;
    return {x: z, xref: 'x', y: 0, yref: 'paper', yanchor: 'top', yshift: -22 - 15 * row, text: name, showarrow: false,
      font: {color: css(kinds[kind][1]), size: 12}, row};
  });
}

function shaftFigure(shapes, lines, width) {
  const names = stationNames(shapes, 0.9 * (width || 1000));
  const rows = 1 + Math.max(0, ...names.map(({row}) => row));
  const tall = 1.6 * tallest(shapes);
  return {data: [...lines, stationTrace(shapes)], layout: layout({hovermode: 'closest', showlegend: true, legend: legend(),
    shapes: rotorShapes(shapes), annotations: names.map(({row, ...note}) => note),
    margin: {l: 56, r: 24, t: 30, b: 44 + 15 * rows},
    xaxis: axes({title: {text: 'z / mm', standoff: 10 + 15 * rows}, range: [-0.02 * length(shapes), 1.02 * length(shapes)],
      anchor: 'y2', zeroline: false, automargin: false}),
    yaxis: axes({title: {text: 'deflection', standoff: 8}, domain: [0.3, 1], range: [-1.1, 1.1], dtick: 0.5,
      zerolinecolor: css('--soft')}),
    yaxis2: axes({domain: [0, 0.25], range: [-tall, tall], visible: false, fixedrange: true})})};
}

const figures = {campbell: campbellFigure, damping: dampingFigure,
  shapes: ({shapes}, width) => shaftFigure(shapes, restTraces(shapes), width),
  whirl_shapes: ({shapes}, width) => shaftFigure(shapes, whirlTraces(shapes), width)};
// width: px, of the plot. What the reader has switched off stays off when the page is drawn again.
export function rotorFigure(rotor, key, width) {
  const figure = figures[key](rotor, width);
  figure.layout.uirevision = key;
  return figure;
}
