// The report, and the page of one run: lays it out, and starts every scene with its plots and its live player, under one
// clock each.
import {showFirst} from './first.js';
import {element, layOut} from './layout.js';
import {LiveScene} from './live.js';
import {data, show, start, withPlotly} from './page.js';
import {reportParts, runParts} from './report_parts.js';
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

// The list of contents: of every part that has a name, those of a scene in its line.
function contentsOf(main) {
  const parts = [...main.querySelectorAll('[data-contents]')], sceneAround = (part) => part.parentElement.closest('.scene[data-contents]');
  const list = (chosen) => element('ul', {}, ...chosen.map((part) => {
    const inside = parts.filter((inner) => sceneAround(inner) === part);
    return element('li', {class: inside.length && 'parted'}, element('a', {href: `#${part.id}`}, part.dataset.contents), inside.length && list(inside));
  }));
  return element('nav', {class: 'contents', 'aria-label': 'contents'}, list(parts.filter((part) => !sceneAround(part))));
}

const main = document.querySelector('main');
layOut(main, data.ending ? runParts(data) : reportParts(data));
main.before(contentsOf(main));
const scenes = [...document.querySelectorAll('[data-scene]')].map(
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
