// The report, and the page of one run: what control trades, then every scene with its plots and its live player,
// under one clock each.
// Without it the page still shows verdicts and tables.
import {showFirst} from './first.js';
import {layOut} from './layout.js';
import {LiveScene} from './live.js';
import {data, show, start, withPlotly} from './page.js';
import {withPlots} from './plot_words.js';
import {stills} from './stills.js';
import {axes, css, layout} from './style.js';

function drawTrade() {
  const points = data.trade;
  if (!points) return;
  // One name a scene, on alternating sides: laws of a kind lie close together. A thin line joins its two forces.
  const sides = ['top right', 'bottom right', 'top left', 'bottom left'];
  const pairs = points.map((p) => ({type: 'line', x0: p.orbit, x1: p.orbit, y0: p.contact, y1: p.actuator,
    line: {color: css('--line'), width: 1}, layer: 'below'}));
  const trace = (key, name, symbol, color) => ({x: points.map((p) => p.orbit), y: points.map((p) => p[key]), name,
    text: points.map((p) => p.name), type: 'scatter', mode: key === 'contact' ? 'markers+text' : 'markers',
    textposition: points.map((_, k) => sides[k % sides.length]), cliponaxis: false,
    textfont: {color: css('--soft'), size: 11},
    marker: {symbol, size: 9, color: css(color)},
    hovertemplate: `%{text}<br>orbit %{x:.4g} mm<br>%{y:.4g} N<extra>${name}</extra>`});
  show(document.getElementById('trade'), {data: [trace('contact', 'contact', 'circle', '--native'),
    trace('actuator', 'actuators', 'square-open', '--rigid')],
  layout: layout({hovermode: 'closest', showlegend: true, shapes: pairs, legend: {orientation: 'h', y: 1.12},
    margin: {l: 56, r: 110, t: 28, b: 40},
    xaxis: axes({title: {text: 'orbit / mm', standoff: 8}, rangemode: 'tozero'}),
    yaxis: axes({title: {text: 'force / N', standoff: 8}, rangemode: 'tozero'})})});
}

for (const [id, parts] of Object.entries(data.beside || {})) {
  if (parts.length) layOut(document.getElementById(id), withPlots(parts, data), 3);
}
const scenes = [...document.querySelectorAll('.scene')].map(
  (element) => new LiveScene(element, data.scenes[Number(element.dataset.scene)]));
const drawStills = stills({first: (plot) => showFirst(plot, scenes[plot.dataset.index].scene, scenes[plot.dataset.index].runs, show)});
// For tests, and for whoever scripts the page.
window.page = {data, players: scenes.map((scene) => scene.player)};

function draw() {
  for (const scene of scenes) scene.drawAll();
  drawStills();
  if (window.Plotly) drawTrade();
}
start(draw);
scenes[0]?.begin();
withPlotly(draw);
