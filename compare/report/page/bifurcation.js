// A bifurcation diagram as plotly takes it (compare/report/bifurcation_plot.h): places once a turn over the swept key, up
// and down, and the largest Lyapunov exponent below them.
import {axes, css, layout, legendAbove as legend, short} from './style.js';

const nameOf = (key) => key.name + (key.unit ? ` / ${key.unit}` : '');
const periodOf = ({period}) => (period === 0 ? 'no period up to 16 turns' : period === 1 ? 'a turn' : `${period} turns`);

// Every place a point, in the order of the values.
export function places(points) {
  const all = points.flatMap((point) => point.x.map((x) => ({x: point.value, y: x, text: `${short(point.value, 6)}: ${periodOf(point)}`})));
  return {x: all.map((p) => p.x), y: all.map((p) => p.y), text: all.map((p) => p.text)};
}

export function bifurcationFigure({key, up, down}) {
  const branch = (points, name, color, symbol, size) => ({...places(points), name, type: 'scatter', mode: 'markers',
    marker: {color: css(color), symbol, size, opacity: 0.8}, hovertemplate: `%{text}<br>x = %{y:.5g} µm<extra>${name}</extra>`});
  // Open where there is none.
  const exponent = {x: up.map((p) => p.value), y: up.map((p) => p.exponent), name: 'Lyapunov exponent', showlegend: false, yaxis: 'y2', type: 'scatter',
    mode: 'lines+markers', line: {color: css('--soft'), width: 1, simplify: false},
    marker: {size: 5, color: up.map((p) => css(p.exponent > 0 ? '--bad' : '--good'))},
    hovertemplate: '%{x:.6g}: %{y:.4g} 1/s<extra>largest Lyapunov exponent</extra>'};
  const two = up.some((p) => p.exponent !== null);
  return {data: [branch(down, 'downwards', '--mode-2', 'circle-open', 7), branch(up, 'upwards', '--ink', 'circle', 3.5), ...(two ? [exponent] : [])],
    layout: layout({hovermode: 'closest', showlegend: true, legend: legend(), margin: {l: 72, r: 24, t: 30, b: 48},
      xaxis: axes({title: {text: nameOf(key), standoff: 6}, type: key.log ? 'log' : undefined, anchor: two ? 'y2' : 'y', zeroline: false}),
      yaxis: axes({title: {text: 'x / µm', standoff: 8}, automargin: false, domain: two ? [0.34, 1] : [0, 1], exponentformat: 'none', separatethousands: true}),
      ...(two ? {yaxis2: axes({title: {text: 'exponent / (1/s)', standoff: 8}, automargin: false, domain: [0, 0.26], zerolinecolor: css('--soft')})} : {})})};
}
