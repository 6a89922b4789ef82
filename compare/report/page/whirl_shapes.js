// Plotly figures of whirl shapes in space: a panel for each mode, with the bent shaft and the paths of its points, in oblique
// projection. The shaft points to the right, x to the upper right, y upwards.
import {css, layout, number} from './style.js';

const reach = 0.28;  // largest deflection, relative to the shaft's length
export const inView = (z, x, y) => [z + 0.45 * reach * x, 0.3 * reach * x + reach * y - 0.12 * z];

// A point of a mode at an angle of its path: half-axes r and roundness r, turning with the spin if forward.
export function pathPoint({sense, roundness}, r, angle) {
  return [r * Math.cos(angle), (sense === 'backward' ? -1 : 1) * roundness * r * Math.sin(angle)];
}

const steps = 40, phase = Math.PI / 5, turned = 0.6 * Math.PI;  // of the drawn shaft; how far ahead the arrow is
const places = (points) => ({x: points.map(([x]) => x), y: points.map(([, y]) => y)});

// The points along the shaft whose paths are drawn: the stations and some points in between.
function pathsOf({z, stations}) {
  const length = z[z.length - 1], nearest = (at) => z.reduce((best, value, k) => (Math.abs(value - at) < Math.abs(z[best] - at) ? k : best), 0);
  const named = new Map();
  for (let k = 0; k <= 8; ++k) named.set(nearest(k * length / 8), '');
  for (const station of stations) named.set(nearest(station.z), station.name);
  return [...named];
}

function panel(shapes, mode, [column, row], [columns, rows], axis) {
  const length = shapes.z[shapes.z.length - 1], color = css(`--mode-${((mode.number - 1) % 6) + 1}`), of = {xaxis: `x${axis}`, yaxis: `y${axis}`, type: 'scatter', showlegend: false};
  const name = `${mode.sense} ${mode.number}, ${number(mode.frequency, 4)} Hz`;
  const words = mode.roundness < 0.999 ? `<br>half-axes 1 : ${mode.roundness.toFixed(3)}` : '';
  const at = (k, angle) => inView(shapes.z[k] / length, ...pathPoint(mode, mode.shape[k], angle));
  const paths = pathsOf(shapes).map(([k, station]) => ({...of, ...places(Array.from({length: steps + 1}, (_, i) => at(k, 2 * Math.PI * i / steps))), mode: 'lines',
    line: {color: css('--soft'), width: station ? 1.4 : 0.8}, hoveron: 'points',
    hovertemplate: `${station ? `${station}, ` : ''}z = ${number(shapes.z[k], 4)} mm: ${mode.shape[k].toFixed(3)}${words}<extra>${name}</extra>`}));
  const highest = mode.shape.reduce((best, value, k) => (Math.abs(value) > Math.abs(mode.shape[best]) ? k : best), 0);
  const arc = Array.from({length: 9}, (_, i) => at(highest, phase + turned * i / 8)), tail = arc[4], head = arc[8];
  const line = (points, width, dash) => ({...of, ...places(points), mode: 'lines', hoverinfo: 'skip', line: {color, width, dash}});
  return {name,
    traces: [{...line([inView(0, 0, 0), inView(1, 0, 0)], 1, 'dash'), line: {color: css('--soft'), width: 1, dash: 'dash'}}, ...paths,
      line(shapes.z.map((_, k) => at(k, phase)), 3), line(arc.slice(0, 5), 2)],
    arrow: {x: head[0], y: head[1], ax: tail[0], ay: tail[1], xref: of.xaxis, yref: of.yaxis, axref: of.xaxis, ayref: of.yaxis, showarrow: true, arrowhead: 2,
      arrowsize: 1, arrowwidth: 2, arrowcolor: color, text: ''},
    title: {text: name, xref: `${of.xaxis} domain`, yref: `${of.yaxis} domain`, x: 0, y: 1, xanchor: 'left', yanchor: 'top', showarrow: false, font: {color: css('--ink'), size: 12}},
    axes: {[`xaxis${axis}`]: {domain: [column / columns, (column + 0.96) / columns], range: [-0.17, 1.17], constrain: 'domain', visible: false, anchor: of.yaxis, fixedrange: true},
      [`yaxis${axis}`]: {domain: [1 - (row + 0.97) / rows, 1 - row / rows], range: [-0.52, 0.5], scaleanchor: of.xaxis, constrain: 'domain', visible: false,
        anchor: of.xaxis, fixedrange: true}}};
}

// width: px. A row for each sense, or one for both if there is room.
export function whirlShapesFigure(shapes, width) {
  const whirls = shapes.whirl.filter(({shape}) => shape.length), numbers = Math.max(1, ...whirls.map((mode) => mode.number));
  const senses = [...new Set(whirls.map(({sense}) => sense))], most = width > 800 ? 4 : 2, isOneRow = numbers * senses.length <= most;
  const columns = isOneRow ? numbers * senses.length : Math.min(numbers, most), rows = isOneRow ? 1 : senses.length * Math.ceil(numbers / columns);
  const placeOf = ({number: n, sense}) => (isOneRow ? [senses.length * (n - 1) + senses.indexOf(sense), 0] :
    [(n - 1) % columns, senses.length * Math.floor((n - 1) / columns) + senses.indexOf(sense)]);
  const panels = whirls.map((mode, k) => panel(shapes, mode, placeOf(mode), [columns, rows], k ? String(k + 1) : ''));
  return {data: panels.flatMap(({traces}) => traces), layout: layout({hovermode: 'closest', margin: {l: 4, r: 4, t: 4, b: 4},
    annotations: panels.flatMap(({arrow, title}) => [arrow, title]), ...Object.assign({}, ...panels.map((one) => one.axes))})};
}
