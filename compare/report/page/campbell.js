// Plotly figures of the free rotor over its spin speed: the Campbell diagram with the scene's speed, coloured by damping;
// damping ratios; and logarithmic decrements.
import {colourScale} from './scales.js';
import {axes, css, layout, legendAbove as legend, number, scaleOfColours, shade, short} from './style.js';

// Sense of a whirl: colour, dash and mark.
const senses = {forward: {color: '--forward', dash: 'solid', symbol: 'circle'},
  backward: {color: '--backward', dash: 'dash', symbol: 'diamond-open'},
  overdamped: {color: '--soft', dash: 'dot', symbol: 'x'}, rigid: {color: '--soft', dash: 'dot', symbol: 'x'}};

// Five digits without an exponent.
export const rpmText = (rpm) => `${Math.abs(rpm) < 1e5 ? short(rpm, 5) : rpm.toFixed(0)} rpm`;

// A sentence on what lies beyond the diagram; empty if nothing does.
export function beyondText({top, critical, threshold}) {
  const beyond = critical.filter((speed) => speed > top);
  return [...(beyond.length ? [`Beyond the diagram: ${beyond.length} critical speed${beyond.length > 1 ? 's' : ''}, ` +
    `${beyond.map((speed) => speed.toFixed(0)).join(', ')} rpm.`] : []),
  ...(threshold !== null && threshold > top ? [`The threshold of stability, ${rpmText(threshold)}, lies beyond the diagram.`] : [])].join(' ');
}

export const once = () => {
  const seen = new Set();
  return (name) => !seen.has(name) && Boolean(seen.add(name));
};

const branch = (piece, y, name, line, showlegend) => ({x: piece.speed, y, name, legendgroup: name, showlegend,
  type: 'scatter', mode: 'lines', line, customdata: piece.speed.map((_, k) => [piece.frequency[k], piece.damping[k]]),
  hovertemplate: `%{x:.5g} rpm: %{customdata[0]:.5g} Hz, damping %{customdata[1]:.3g} %<extra>${name}</extra>`});
const growing = (campbell, key) => campbell.pieces.filter((piece) => piece.damping.some((d) => d < 0)).map((piece, k) =>
  branch(piece, piece[key].map((y, i) => (piece.damping[i] < 0 ? y : null)), 'growing', {color: css('--bad'), width: 4}, k === 0));

// The colour scale of the damping ratios (%) of oscillating modes, from weak (dark) to strong (light); null if all ratios are
// nearly the same. A wide range is divided logarithmically.
const levels = 8;
export function dampingScale(pieces) {
  const given = pieces.filter(({sense}) => sense === 'forward' || sense === 'backward').flatMap(({damping}) => damping).filter((ratio) => ratio >= 0);
  const low = Math.min(...given), high = Math.max(...given);
  if (!(high - low > 0.02 * high)) return null;
  const {log, place, low: from, high: to} = colourScale(given, given.map((_, k) => k), false);
  return {log, low: from, high: to, level: (ratio) => Math.min(levels - 1, Math.max(0, Math.floor(levels * (place(ratio) - from) / (to - from))))};
}

// Splits a piece by the level of its damping: one curve for each level, with gaps in between.
export function stretches(piece, level) {
  const curves = new Map();
  for (let k = 1; k < piece.speed.length; ++k) {
    const at = level(0.5 * (piece.damping[k - 1] + piece.damping[k]));
    if (!curves.has(at)) curves.set(at, []);
    const places = curves.get(at);
    if (places[places.length - 1] === k - 1) places.push(k); else places.push(...(places.length ? [null] : []), k - 1, k);
  }
  return [...curves].map(([at, places]) => ({level: at, places}));
}

// Lines coloured by damping, dashed for backward whirl, and the bar of the colours.
function damped(campbell, scale) {
  const palette = [1, 2, 3, 4, 5].map((k) => css(`--damping-${k}`)), first = once();
  const colours = Array.from({length: levels}, (_, k) => `rgb(${shade((k + 0.5) / levels, palette).join()})`);
  const lines = campbell.pieces.flatMap((piece) => {
    const swings = piece.sense === 'forward' || piece.sense === 'backward', {color, dash} = senses[piece.sense];
    return stretches(piece, swings ? scale.level : () => 0).map(({level, places}) => {
      const of = (list) => places.map((k) => (k === null ? null : list[k]));
      return {type: 'scatter', mode: 'lines', x: of(piece.speed), y: of(piece.frequency), name: piece.sense, legendgroup: piece.sense, showlegend: false,
        line: {color: swings ? colours[level] : css(color), width: 2.6, dash}, customdata: places.map((k) => (k === null ? null : [piece.frequency[k], piece.damping[k]])),
        hovertemplate: `%{x:.5g} rpm: %{customdata[0]:.5g} Hz, damping %{customdata[1]:.3g} %<extra>${piece.sense}</extra>`};
    });
  });
  const names = campbell.pieces.filter(({sense}) => first(sense)).map(({sense}) => ({type: 'scatter', mode: 'lines', x: [null], y: [null], name: sense,
    legendgroup: sense, line: {color: css('--ink'), width: 2.6, dash: senses[sense].dash}}));
  const ticks = [0, 1, 2, 3, 4].map((k) => scale.low + (k / 4) * (scale.high - scale.low));
  const bar = {type: 'scatter', mode: 'markers', x: [null], y: [null], showlegend: false, hoverinfo: 'skip', marker: {color: [0], showscale: true,
    colorscale: scaleOfColours(palette), cmin: scale.low, cmax: scale.high, colorbar: {title: {text: 'damping / %', side: 'right'}, thickness: 14,
      outlinewidth: 0, tickvals: ticks, ticktext: ticks.map((v) => short(scale.log ? 10 ** v : v, 2))}}};
  return [...lines, ...names, ...growing(campbell, 'frequency'), bar];
}

// A value of all pieces over the speed; growing modes are drawn thick and on top.
function branches(campbell, key) {
  const first = once();
  // Backward whirl is dashed and drawn over the forward whirl, with which it may coincide.
  const order = [...campbell.pieces].sort((a, b) => (a.sense === 'backward') - (b.sense === 'backward'));
  const plain = order.map((piece) => {
    const {color, dash} = senses[piece.sense];
    return branch(piece, piece[key], piece.sense, {color: css(color), width: 2, dash}, first(piece.sense));
  });
  return [...plain, ...growing(campbell, key)];
}

export const across = (x, color, dash) => ({type: 'line', x0: x, x1: x, yref: 'paper', y0: 0, y1: 1,
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
export const speedAxis = (campbell) => axes({title: {text: 'spin speed / rpm', standoff: 6}, range: [0, campbell.top],
  exponentformat: 'none', separatethousands: true, nticks: 8});
export const valueAxis = (extra) => axes(Object.assign({automargin: false}, extra));

// The top of the diagram, Hz: it includes 1x and the two lowest modes of each sense. A double click shows the rest.
function ceiling(campbell) {
  const highest = campbell.pieces.filter((piece) => piece.speed[0] === 0)
    .map((piece) => Math.max(...piece.frequency)).sort((a, b) => a - b);
  return 1.08 * Math.max(campbell.top / 60, ...highest.slice(0, 4));
}

// The names of the critical speeds, each to the upper left of its ring; a speed that is close to the one before stands higher.
export function letteredSpeeds(critical, top) {
  let level = 0;
  return critical.map((n, k) => {
    level = k > 0 && n - critical[k - 1] < 0.12 * top ? level + 1 : 0;
    return {x: n, y: n / 60, text: `${number(n, 4)} rpm`, ax: n < 0.1 * top ? 40 : -40, ay: -22 - 18 * level, arrowhead: 0, arrowwidth: 1, standoff: 6,
      arrowcolor: css('--soft'), bgcolor: css('--paper'), font: {color: css('--ink'), size: 12}};
  });
}

export function campbellFigure({campbell}) {
  const {top, torsion, operating} = campbell, high = ceiling(campbell), scale = dampingScale(campbell.pieces);
  const critical = campbell.critical.filter((speed) => speed <= top);
  const ray = (times, dash) => ({type: 'scatter', x: [0, top], y: [0, times * top / 60], name: `${times}×`, mode: 'lines',
    line: {color: css('--ink'), width: 1.2, dash}, hoverinfo: 'skip'});
  const speeds = {type: 'scatter', x: critical, y: critical.map((n) => n / 60), name: 'critical speed', mode: 'markers', cliponaxis: false,
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
      marker: {color: css(scale ? '--ink' : senses[sense].color), size: 9, symbol: senses[sense].symbol, line: {width: 2}},
      customdata: list.map((mode) => mode.damping),
      hovertemplate: `at the scene's speed: %{y:.5g} Hz, damping %{customdata:.3g} %<extra>${sense}</extra>`};
  });
  const {shapes, annotations} = marks(campbell, true);
  annotations.push(...letteredSpeeds(critical, top));
  const above = torsion.filter((f) => f > high);
  if (above.length) {
    annotations.push({xref: 'paper', x: 1, xanchor: 'right', yref: 'paper', y: 0, yanchor: 'bottom', showarrow: false, bgcolor: css('--paper'),
      text: `↑ torsion: ${above.slice(0, 3).map((f) => number(f, 4)).join(', ')}${above.length > 3 ? ', …' : ''} Hz`, font: {color: css('--mode-4'), size: 12}});
  }
  return {data: [...(scale ? damped(campbell, scale) : branches(campbell, 'frequency')), ray(1, 'longdashdot'), ray(2, 'dot'), ...twists, ...here, speeds],
    layout: layout({shapes, annotations, hovermode: 'closest', showlegend: true, legend: legend(),
      margin: {l: 64, r: 24, t: 30, b: 44}, xaxis: speedAxis(campbell),
      yaxis: valueAxis({title: {text: 'whirl frequency / Hz', standoff: 8}, range: [0, high]})})};
}

// The logarithmic decrement for a damping ratio in percent; null if the mode does not oscillate.
export function decrement(percent) {
  const ratio = percent / 100;
  return Math.abs(ratio) < 1 ? 2 * Math.PI * ratio / Math.sqrt(1 - ratio * ratio) : null;
}

// `key` of the pieces over the speed. The axis includes 0.
function dampingPlot(campbell, key, title) {
  const values = campbell.pieces.flatMap((piece) => piece[key]), most = Math.max(0, ...values), least = Math.min(0, ...values);
  const room = 0.1 * (most - least) || 0.1;
  return {data: branches(campbell, key), layout: layout({...marks(campbell, false), hovermode: 'closest',
    margin: {l: 64, r: 24, t: 8, b: 44}, xaxis: speedAxis(campbell),
    yaxis: valueAxis({title: {text: title, standoff: 8}, range: [least - room, most + room],
      zeroline: true, zerolinecolor: css('--soft')})})};
}
export const dampingFigure = ({campbell}) => dampingPlot(campbell, 'damping', 'damping ratio / %');
export const decrementFigure = ({campbell}) => dampingPlot({...campbell,
  pieces: campbell.pieces.map((piece) => ({...piece, decrement: piece.damping.map(decrement)}))}, 'decrement', 'log. decrement');
