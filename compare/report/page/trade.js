// The trade-off of control: the forces of contact and of actuators over the size of the orbit, for the native run of each scene.
import {milli} from './factors.js';
import {axes, css, layout} from './style.js';

// The orbit in mm, at the end of the run, and forces in N. scenes: LiveScene.
export function tradeOf(scenes) {
  return scenes.map(({scene: {name, summary}, runs: [native]}) => {
    const {rotor} = native.tracks;
    const orbit = rotor.instants(summary.settled.from, native.end, 1000).reduce((most, t) => Math.max(most, rotor.length(t)), 0);
    return {name, orbit: milli * orbit, contact: summary.mean_force, actuator: summary.control_force ?? 0};
  });
}

export function tradeFigure(points) {
  // Each scene has one label; the sides alternate, because similar laws lie close together. A thin line joins its two forces.
  const sides = ['top right', 'bottom right', 'top left', 'bottom left'];
  const pairs = points.map((p) => ({type: 'line', x0: p.orbit, x1: p.orbit, y0: p.contact, y1: p.actuator,
    line: {color: css('--line'), width: 1}, layer: 'below'}));
  const trace = (key, name, symbol, color) => ({x: points.map((p) => p.orbit), y: points.map((p) => p[key]), name,
    text: points.map((p) => p.name), type: 'scatter', mode: key === 'contact' ? 'markers+text' : 'markers',
    textposition: points.map((_, k) => sides[k % sides.length]), cliponaxis: false,
    textfont: {color: css('--soft'), size: 11},
    marker: {symbol, size: 9, color: css(color)},
    hovertemplate: `%{text}<br>orbit %{x:.4g} mm<br>%{y:.4g} N<extra>${name}</extra>`});
  return {data: [trace('contact', 'contact', 'circle', '--native'),
    trace('actuator', 'actuators', 'square-open', '--rigid')],
  layout: layout({hovermode: 'closest', showlegend: true, shapes: pairs, legend: {orientation: 'h', y: 1.12},
    margin: {l: 56, r: 110, t: 28, b: 40},
    xaxis: axes({title: {text: 'orbit / mm', standoff: 8}, rangemode: 'tozero'}),
    yaxis: axes({title: {text: 'force / N', standoff: 8}, rangemode: 'tozero'})})};
}
