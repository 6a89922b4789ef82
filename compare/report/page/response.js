// The free rotor's response to unbalance over the spin speed (Bode, polar), and its critical speeds over the stiffness of
// its bearings, as plotly figures.
import {across, valueAxis} from './campbell.js';
import {logTicks} from './scales.js';
import {axes, css, layout, legendAbove as legend, number, titled} from './style.js';

const rpm = (speed) => `${number(speed, 4)} rpm`;
const nameOf = ({name, plane}) => (plane ? `${name}, ${plane}` : name);

// The curves that are shown at first, only in the plane x: the contacts, the sensors of magnetic bearings, and the few other
// stations that move most.
const kFirst = 5;
export function shownFirst(curves) {
  const most = ({amplitude}) => Math.max(...amplitude), inX = curves.filter(({plane}) => plane !== 'y');
  const named = (word) => inX.filter(({name}) => name.startsWith(word)), sensors = named('sensor');
  const always = [...named('contact'), ...(sensors.length ? sensors : named('magnetic bearing'))];
  const others = inX.filter((curve) => !always.includes(curve) && !curve.name.startsWith('bearing')).sort((a, b) => most(b) - most(a));
  return new Set([...always, ...others].slice(0, Math.max(kFirst, always.length)));
}

// The colour shows the station (curves that are shown at first get the first colours); the plane y is dashed.
function styleOf(curves, first) {
  const stations = [...new Set([...curves.filter((curve) => first.has(curve)), ...curves].map(({name}) => name))];
  return ({name, plane}) => ({color: css(`--mode-${(stations.indexOf(name) % 6) + 1}`), width: 2,
    dash: plane === 'y' ? 'dash' : 'solid', simplify: false});
}

// The peaks that get a label: the highest ones of all curves, none close to another. A critically damped peak (API 684) has
// only its ring.
const kDamped = 2.5;
export function letteredPeaks(curves, top) {
  const all = curves.flatMap((curve) => curve.peaks.map((peak) => ({...peak, curve}))).filter(({factor}) => factor >= kDamped)
    .sort((a, b) => b.amplitude - a.amplitude);
  return all.filter((peak, k) => all.slice(0, k).every((higher) => Math.abs(higher.speed - peak.speed) > 0.08 * top));
}
const factorOf = ({factor}) => (factor === null ? 'no amplification factor' : `AF ${number(factor, 3)}${factor < kDamped ? ', critically damped' : ''}`);

// The range of the amplitude axis (log10): at most five decades below the highest peak.
function decadesOf(curves, limits) {
  const all = curves.flatMap(({amplitude}) => amplitude).filter((a) => a > 0), sizes = all.length ? all : [1];
  const high = Math.log10(Math.max(...limits, ...sizes)), low = Math.log10(sizes.reduce((least, a) => Math.min(least, a), Infinity));
  return [Math.max(low, high - 5), high + 0.4];
}

const hover = '%{customdata[0]:.5g} rpm: %{customdata[1]:.4g} µm, %{customdata[2]:.1f}°';
const facts = (speed, {amplitude, phase}) => speed.map((n, k) => [n, amplitude[k], phase[k]]);

// Degrees between two ticks of the phase, for at most eight ticks.
function quarters(curves) {
  const all = curves.flatMap(({phase}) => phase).filter((p) => p !== null);
  const span = Math.max(0, ...all) - Math.min(0, ...all);
  return [90, 180].find((tick) => span <= 8 * tick) ?? 360;
}

export function bodeFigure({bode, campbell}) {
  const {speed, running, curves, clearance, limit} = bode, first = shownFirst(curves), style = styleOf(curves, first), top = speed[speed.length - 1];
  const visibility = (curve) => (first.has(curve) ? {} : {visible: 'legendonly'}), shown = [...first];
  const line = (curve, y, more) => ({x: speed, y, name: nameOf(curve), legendgroup: nameOf(curve), type: 'scatter', mode: 'lines',
    line: style(curve), customdata: facts(speed, curve), hovertemplate: `${hover}<extra>${nameOf(curve)}</extra>`, ...visibility(curve), ...more});
  const rings = curves.map((curve) => ({x: curve.peaks.map((p) => p.speed), y: curve.peaks.map((p) => p.amplitude), name: nameOf(curve),
    legendgroup: nameOf(curve), showlegend: false, type: 'scatter', mode: 'markers', cliponaxis: false, ...visibility(curve),
    marker: {color: css('--paper'), size: 9, line: {color: style(curve).color, width: 2}},
    text: curve.peaks.map(factorOf), hovertemplate: `peak at %{x:.5g} rpm: %{y:.4g} µm, %{text}<extra>${nameOf(curve)}</extra>`}));
  const letters = letteredPeaks(shown, top).map((peak) => ({x: peak.speed, y: Math.log10(peak.amplitude), text: `${rpm(peak.speed)}, ${factorOf(peak)}`,
    showarrow: false, xanchor: peak.speed > 0.85 * top ? 'right' : peak.speed < 0.15 * top ? 'left' : 'center', yanchor: 'bottom', yshift: 7, bgcolor: css('--paper'), font: {color: css('--ink'), size: 12}}));
  const marks = [...(running > 0 && running <= top ? [across(running, '--soft', 'dot')] : []),
    ...campbell.critical.filter((n) => n <= top).map((n) => across(n, '--line', 'longdash')),
    ...(clearance ? [{type: 'line', xref: 'paper', x0: 0, x1: 1, y0: clearance, y1: clearance, line: {color: css('--bad'), width: 1.2, dash: 'dash'}}] : [])];
  if (clearance) {
    letters.push({xref: 'paper', x: 0, xanchor: 'left', y: Math.log10(clearance), yanchor: 'bottom', text: bode.clearance_of, showarrow: false,
      font: {color: css('--bad'), size: 12}});
  }
  const allowed = limit ? [{x: speed, y: limit, name: 'limit of API 617', type: 'scatter', mode: 'lines', line: {color: css('--bad'), width: 1.6, dash: 'dashdot'},
    hovertemplate: '%{x:.5g} rpm: %{y:.4g} µm<extra>limit of API 617</extra>'}] : [];
  return {data: [...curves.map((curve) => line(curve, curve.amplitude)), ...rings, ...allowed,
    ...curves.map((curve) => line(curve, curve.phase, {yaxis: 'y2', showlegend: false}))],
  layout: layout({shapes: marks.map((mark) => ({...mark, layer: 'below'})), annotations: letters, hovermode: 'closest', showlegend: true, legend: legend(),
    margin: {l: 64, r: 24, t: 30, b: 44},
    xaxis: axes({title: {text: 'spin speed / rpm', standoff: 6}, range: [0, top], anchor: 'y2', exponentformat: 'none', separatethousands: true, nticks: 8}),
    yaxis: valueAxis({title: {text: 'amplitude / µm', standoff: 8}, type: 'log', exponentformat: 'power', domain: [0.4, 1], range: decadesOf(shown, [clearance ?? 0, ...(limit ?? [])])}),
    yaxis2: valueAxis({title: {text: 'phase / °', standoff: 8}, domain: [0, 0.34], dtick: quarters(shown)})})};
}

// The deflection in the rotor's frame: the mark points to the right, and angles increase in the sense of the spin.
export const placeOf = (amplitude, phase) => (amplitude === null ? [null, null] :
  [amplitude * Math.cos(phase * Math.PI / 180), amplitude * Math.sin(phase * Math.PI / 180)]);

// The indices of `count` points of a curve, evenly spaced along its length; the start is left out.
export function alongCurve(places, count) {
  const way = [0];
  for (let k = 1; k < places.length; ++k) {
    const step = Math.hypot(places[k][0] - places[k - 1][0], places[k][1] - places[k - 1][1]);
    way.push(way[k - 1] + (Number.isFinite(step) ? step : 0));
  }
  const whole = way[way.length - 1];
  return Array.from({length: count}, (_, k) => way.findIndex((w) => w >= whole * (k + 1) / count)).filter((k) => k > 0);
}

// A range around values, with room for labels on either side.
function widened(values) {
  const given = values.filter((v) => v !== null), low = Math.min(...given), high = Math.max(...given), room = 0.3 * (high - low);
  return [low - room, high + room];
}

// The side of each chosen point of a curve that faces away from the middle of the points, as plotly names it.
export function outside(places, chosen) {
  const middle = [0, 1].map((c) => chosen.reduce((sum, k) => sum + places[k][c], 0) / chosen.length);
  return chosen.map((k) => {
    const [x, y] = [0, 1].map((c) => places[k][c] - middle[c]), angle = Math.abs(Math.atan2(y, x)) / Math.PI;
    if (angle > 0.4 && angle < 0.6) return y > 0 ? 'top center' : 'bottom center';
    return x > 0 ? 'middle right' : 'middle left';
  });
}

export function polarFigure({bode}) {
  const {speed, curves} = bode, first = shownFirst(curves), style = styleOf(curves, first);
  const visibility = (curve) => (first.has(curve) ? {} : {visible: 'legendonly'});
  const places = curves.map((curve) => curve.amplitude.map((a, k) => placeOf(a, curve.phase[k])));
  const lines = curves.map((curve, c) => ({x: places[c].map((p) => p[0]), y: places[c].map((p) => p[1]), name: nameOf(curve), legendgroup: nameOf(curve),
    type: 'scatter', mode: 'lines', line: style(curve), customdata: facts(speed, curve), hovertemplate: `${hover}<extra>${nameOf(curve)}</extra>`,
    ...visibility(curve)}));
  // The labels of the speeds are on the largest shown curve.
  const largest = curves.reduce((best, curve, c) => (first.has(curve) && (best < 0 || Math.max(...curve.amplitude) > Math.max(...curves[best].amplitude)) ? c : best), -1);
  const at = largest < 0 ? [] : alongCurve(places[largest], 8);
  const letters = largest < 0 ? [] : [{x: at.map((k) => places[largest][k][0]), y: at.map((k) => places[largest][k][1]), text: at.map((k) => rpm(speed[k])),
    legendgroup: nameOf(curves[largest]), showlegend: false, type: 'scatter', mode: 'markers+text', textposition: outside(places[largest], at), hoverinfo: 'skip', cliponaxis: false,
    textfont: {color: css('--soft'), size: 11}, marker: {color: style(curves[largest]).color, size: 6}}];
  const square = {automargin: false, constrain: 'domain', exponentformat: 'none', separatethousands: true};
  return {data: [...lines, ...letters], layout: layout({hovermode: 'closest', showlegend: true, legend: legend(), margin: {l: 84, r: 24, t: 30, b: 44},
    xaxis: titled('along the mark / µm', {...square, ...(at.length && {range: widened(places[largest].map(([x]) => x))})}),
    yaxis: titled('ahead in the sense of spin / µm', {...square, scaleanchor: 'x'})})};
}

export function stiffnessFigure({stiffness, campbell}, index) {
  const {stiffness: x, own, of, curves, ring} = stiffness[index];
  const line = (y, name, style, more) => ({x, y, name, type: 'scatter', mode: 'lines', line: {width: 2, simplify: false, ...style},
    hovertemplate: `%{x:.3g} N/m: %{y:.5g} rpm<extra>${name}</extra>`, ...more});
  const color = (k) => css(`--mode-${(k % 6) + 1}`);
  const lines = [...curves.map((y, k) => line(y, `critical speed ${k + 1}`, {color: color(k)}, k < 6 ? {} : {visible: 'legendonly'})),
    ...ring.map((y, k) => line(y, `ring alone${ring.length > 1 ? ` ${k + 1}` : ''}`, {color: css('--ink'), dash: 'dash', width: 1.6}))];
  // Lines at the critical speeds of the rotor without contact, beside the curves of the rotor held to a ring.
  const rotor = ring.length ? campbell.critical.map((y) => ({type: 'line', xref: 'paper', x0: 0, x1: 1, y0: y, y1: y, layer: 'below',
    line: {color: css('--soft'), width: 1, dash: 'longdash'}})) : [];
  const along = campbell.running > 0 ? [{type: 'line', xref: 'paper', x0: 0, x1: 1, y0: campbell.running, y1: campbell.running, layer: 'below',
    line: {color: css('--soft'), width: 1.2, dash: 'dot'}}] : [];
  const note = (extra) => ({showarrow: false, bgcolor: css('--paper'), font: {color: css('--soft'), size: 12}, ...extra});
  return {data: lines, layout: layout({shapes: [{...across(own, '--soft', 'dash'), layer: 'below'}, ...rotor, ...along], hovermode: 'closest', showlegend: true, legend: legend(),
    annotations: [note({x: Math.log10(own), y: 0, yref: 'paper', yanchor: 'bottom', xanchor: 'left', xshift: 5, text: 'as in the scene'}),
      ...(along.length ? [note({xref: 'paper', x: 1, xanchor: 'left', xshift: 4, y: Math.log10(campbell.running), text: "scene's speed"})] : [])],
    margin: {l: 72, r: along.length ? 96 : 24, t: 30, b: 44}, xaxis: titled(`${of} / (N/m)`, {type: 'log', exponentformat: 'power', dtick: 1}),
    yaxis: valueAxis({title: {text: 'critical speed / rpm', standoff: 8}, type: 'log', ...logTicks([...curves, ...ring].flat())})})};
}
