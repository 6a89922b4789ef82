// Plotly figures of the free rotor, from {campbell, shapes, bode, stiffness} (rotor_data.js). This file has the mode shapes at
// rest.
import {campbellFigure, dampingFigure, decrementFigure} from './campbell.js';
import {bodeFigure, polarFigure, stiffnessFigure} from './response.js';
import {axes, css, layout, legendAbove as legend, number} from './style.js';
import {whirlShapesFigure} from './whirl_shapes.js';

// ------------------------------------------------------------------ along the shaft
const kinds = {disc: ['square', '--ink'], bearing: ['triangle-up', '--good'], contact: ['circle-open', '--bad'],
  drive: ['star', '--mode-4'], magnetic_bearing: ['diamond', '--mode-5'], force: ['arrow-bar-down', '--backward']};

const length = (shapes) => shapes.z[shapes.z.length - 1];
const alongShaft = (shapes, y, name, color, dash, visible) => ({x: shapes.z, y, name, type: 'scatter', mode: 'lines',
  ...(visible ? {} : {visible: 'legendonly'}), line: {color: css(`--mode-${color}`), width: 2.2, dash},
  hovertemplate: `z = %{x:.1f} mm: %{y:.3f}<extra>${name}</extra>`});
const colorOf = (mode) => ((mode.number - 1) % 6) + 1;

// Mode shapes at rest. The colour shows the mode; the plane y is dashed if it differs.
const restTraces = (shapes) => shapes.modes.map((mode) => alongShaft(shapes, mode.shape,
  `mode ${mode.number}${shapes.same_planes ? '' : ` ${mode.plane}`}, ${number(mode.frequency, 4)} Hz`,
  colorOf(mode), mode.plane === 'y' ? 'dash' : 'solid', mode.number <= 4));

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

// One trace of symbols: bearings are below the shaft, all others above it.
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

const figures = {campbell: campbellFigure, damping: dampingFigure, decrement: decrementFigure,
  bode: bodeFigure, polar: polarFigure, stiffness: (rotor, _width, index) => stiffnessFigure(rotor, index),
  shapes: ({shapes}, width) => shaftFigure(shapes, restTraces(shapes), width),
  whirl_shapes: ({shapes}, width) => whirlShapesFigure(shapes, width)};
// width: of the plot, px. index: the map's number if there are several. Curves that the reader has switched off stay off when
// the page is drawn again.
export function rotorFigure(rotor, key, width, index) {
  const figure = figures[key](rotor, width, index);
  figure.layout.uirevision = key;
  return figure;
}
