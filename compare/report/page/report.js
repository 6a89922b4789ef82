// The report, and the page of one run: lays it out, and starts every scene with its plots and its live player, under one
// clock each.
import {showFirst} from './first.js';
import {element, layOut} from './layout.js';
import {withRubs} from './linear_maps.js';
import {LiveScene} from './live.js';
import {data, show, start, withPlotly} from './page.js';
import {reportParts} from './report_parts.js';
import {rotorOf} from './rotor_data.js';
import {runParts} from './run_parts.js';
import {stills} from './stills.js';
import {tradeFigure, tradeOf} from './trade.js';
import {slidersOf} from './what_if.js';
import {windowsOf} from './windows.js';

// The list of contents: an entry for every named part; the parts of a scene share a line.
function contentsOf(main) {
  const parts = [...main.querySelectorAll('[data-contents]')], sceneAround = (part) => part.parentElement.closest('.scene[data-contents]');
  const list = (chosen) => element('ul', {}, ...chosen.map((part) => {
    const inside = parts.filter((inner) => sceneAround(inner) === part);
    return element('li', {class: inside.length && 'parted'}, element('a', {href: `#${part.id}`}, part.dataset.contents), inside.length && list(inside));
  }));
  return element('nav', {class: 'contents', 'aria-label': 'contents'}, list(parts.filter((part) => !sceneAround(part))));
}

for (const scene of data.scenes) {
  const {rotor, what_if: asked} = scene;
  Object.assign(scene, {rotor: rotorOf(rotor), windows: windowsOf(scene), what_if: asked && {...asked, sliders: slidersOf(asked.sliders)}});
}
data.maps = data.sweeps?.map(({plots}) => withRubs(plots));
const main = document.querySelector('main');
layOut(main, data.page.kind === 'run' ? runParts(data) : reportParts(data));
main.before(contentsOf(main));
const scenes = [...document.querySelectorAll('[data-scene]')].map(
  (element) => new LiveScene(element, data.scenes[Number(element.dataset.scene)]));
const drawStills = stills({trade: (plot) => show(plot, tradeFigure(tradeOf(scenes))), first: (plot) => {
  const {scene, runs, plots} = scenes[plot.dataset.index];
  showFirst(plot, scene, runs, show);
  plots.link(plot);
}});
// For tests and for scripts of users.
window.page = {data, players: scenes.map((scene) => scene.player)};

function draw() {
  for (const scene of scenes) scene.drawAll();
  drawStills();
}
start(draw);
scenes[0]?.begin();
withPlotly(draw);
