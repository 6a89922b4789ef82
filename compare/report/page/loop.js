// Plotly figures of the closed loop of magnetic bearings, from the data of rotor_data.js: sensitivities with the zones of
// ISO 14839-3, and responses to a step of force.
import {axes, css, layout, legendAbove as legend, titled} from './style.js';

// The colour shows the bearing; the axis y is dashed, because it often coincides with x.
const style = (name) => ({color: css(`--mode-${((Number(name.split(' ')[1]) - 1) % 6) + 1}`), width: 2,
  dash: name.endsWith('y') ? 'dash' : 'solid', simplify: false});
const lineOf = (name, x, y, hovertemplate) => ({x, y, name, legendgroup: name, type: 'scatter', mode: 'lines',
  line: style(name), hovertemplate: `${hovertemplate}<extra>${name}</extra>`});
const mark = (name, [x, y], symbol, words) => ({x: [x], y: [y], name, legendgroup: name, showlegend: false, type: 'scatter',
  mode: 'markers', cliponaxis: false, marker: {color: style(name).color, size: 9, symbol, line: {width: 2}},
  hovertemplate: `${words}<extra>${name}</extra>`});
const room = {l: 64, r: 34, t: 30, b: 44};

// Upper limits of the zones; D has none.
export const zones = [['A', 3, '--good-bg'], ['B', 4, '--flat-bg'], ['C', 5, '--part-bg'], ['D', Infinity, '--bad-bg']]
  .map(([name, limit, color]) => ({name, limit: 20 * Math.log10(limit), color}));

function sensitivityFigure({sensitivity}) {
  const values = sensitivity.flatMap(({y}) => y);
  const high = Math.max(18, ...values.map((y) => y + 2)), low = Math.max(-40, Math.min(...values) - 2);
  const shapes = [], annotations = [];
  zones.forEach(({name, limit, color}, k) => {
    const from = k === 0 ? low : zones[k - 1].limit, to = Math.min(limit, high);
    shapes.push({type: 'rect', xref: 'paper', x0: 0, x1: 1, y0: from, y1: to, layer: 'below', fillcolor: css(color), line: {width: 0}});
    if (k > 0) shapes.push({type: 'line', xref: 'paper', x0: 0, x1: 1, y0: from, y1: from, line: {color: css('--soft'), width: 1, dash: 'dot'}});
    annotations.push({xref: 'paper', x: 1, xanchor: 'left', xshift: 8, y: k === 0 ? (Math.max(from, 0) + to) / 2 : (from + to) / 2,
      text: `<b>${name}</b>`, showarrow: false, font: {color: css('--ink'), size: 13}});
  });
  const curves = sensitivity.flatMap(({name, f, y, peak}) => [
    lineOf(name, f, y, '%{x:.5g} Hz: %{y:.3g} dB'), mark(name, peak, 'circle-open', 'most: %{x:.5g} Hz, %{y:.3g} dB')]);
  return {data: curves, layout: layout({shapes, annotations, hovermode: 'closest', showlegend: true, legend: legend(), margin: room,
    xaxis: titled('frequency / Hz', {type: 'log', exponentformat: 'none'}), yaxis: axes({title: {text: '|S| / dB', standoff: 8}, range: [low, high]})})};
}

function stepFigure({step}) {
  const curves = step.flatMap(({name, t, y, peak, settled}) => [
    lineOf(name, t, y, '%{x:.4g} ms: %{y:.4g} µm/N'),
    ...(peak ? [mark(name, peak, 'circle-open', 'most: %{y:.4g} µm/N at %{x:.4g} ms')] : []),
    mark(name, settled, 'diamond-open', 'settled within 2 % from %{x:.4g} ms on')]);
  // The steady deflection.
  const shapes = step.map(({name, steady}) => ({type: 'line', xref: 'paper', x0: 0, x1: 1, y0: steady, y1: steady, layer: 'below',
    line: {color: style(name).color, width: 1, dash: 'dot'}}));
  return {data: curves, layout: layout({shapes, hovermode: 'closest', showlegend: true, legend: legend(), margin: room,
    xaxis: titled('time / ms', {rangemode: 'tozero'}), yaxis: titled('deflection per newton / (µm/N)', {zerolinecolor: css('--soft')})})};
}

const figures = {sensitivity: sensitivityFigure, step: stepFigure};
export const loopFigure = (loop, key) => figures[key](loop);
