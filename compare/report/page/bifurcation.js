// A bifurcation diagram as a plotly figure (compare/sweep/page_data.h): positions once per turn over the swept key, swept up
// and down, and below them the largest Lyapunov exponent.
import {micro} from './factors.js';
import {shownUnit} from './linear_maps.js';
import {axes, css, decades, layout, legendAbove as legend, short} from './style.js';

const nameOf = (key) => key.name + (key.unit ? ` / ${key.unit}` : '');
const periodOf = ({period}) => (period === 0 ? 'no period up to 16 turns' : period === 1 ? 'a turn' : `${period} turns`);

// Returns one point for every position, in the order of the key's values.
export function places(points) {
  const all = points.flatMap((point) => point.x.map((x) => ({x: point.value, y: x, text: `${short(point.value, 6)}: ${periodOf(point)}`})));
  return {x: all.map((p) => p.x), y: all.map((p) => p.y), text: all.map((p) => p.text)};
}

// Splits a branch into parts that are stable or unstable throughout; a part begins where the previous one ended.
export function partsOf(points) {
  const parts = [];
  for (const point of points) {
    const last = parts.at(-1);
    if (last && last.stable === point.stable) last.points.push(point);
    else parts.push({stable: point.stable, points: last ? [last.points.at(-1), point] : [point]});
  }
  return parts;
}

// The lines of a branch with k places in a period: each joins the places of one rank along x.
export function rankLines(points) {
  const sorted = points.filter(({x}) => x.length > 0).map((point) => ({...point, x: [...point.x].sort((a, b) => a - b)}));
  const ranks = Math.max(0, ...sorted.map(({x}) => x.length));
  const whole = sorted.filter(({x}) => x.length === ranks);
  return Array.from({length: ranks}, (_, rank) => whole.map(({value, x}) => ({x: value, y: x[rank]})));
}

// Branches of periodic motions, stable parts solid and unstable ones dashed.
const branchLines = (branches) => {
  const named = new Set();
  return (branches?.lines ?? []).flatMap(({points}) => partsOf(points).flatMap((part) => rankLines(part.points).map((line) => {
    const name = part.stable ? 'stable branch' : 'unstable branch', isNew = !named.has(name);
    named.add(name);
    return {x: line.map((p) => p.x), y: line.map((p) => p.y), name, legendgroup: name, showlegend: isNew, type: 'scatter', mode: 'lines',
      line: {color: css('--mode-3'), width: part.stable ? 2 : 1.2, dash: part.stable ? 'solid' : 'dash', simplify: false},
      hovertemplate: `%{x:.6g}<br>x = %{y:.5g} µm<extra>${name}</extra>`};
  })));
};

export function bifurcationFigure({key, up, down, branches}) {
  const branch = (points, name, color, symbol, size) => ({...places(points), name, type: 'scatter', mode: 'markers',
    marker: {color: css(color), symbol, size, opacity: 0.8}, hovertemplate: `%{text}<br>x = %{y:.5g} µm<extra>${name}</extra>`});
  // The curve has a gap where there is no exponent.
  const exponent = {x: up.map((p) => p.value), y: up.map((p) => p.exponent), name: 'Lyapunov exponent', showlegend: false, yaxis: 'y2', type: 'scatter',
    mode: 'lines+markers', line: {color: css('--soft'), width: 1, simplify: false},
    marker: {size: 5, color: up.map((p) => css(p.exponent > 0 ? '--bad' : '--good'))},
    hovertemplate: '%{x:.6g}: %{y:.4g} 1/s<extra>largest Lyapunov exponent</extra>'};
  const two = up.some((p) => p.exponent !== null);
  return {data: [...branchLines(branches), branch(down, 'downwards', '--mode-2', 'circle-open', 7), branch(up, 'upwards', '--ink', 'circle', 3.5), ...(two ? [exponent] : [])],
    layout: layout({hovermode: 'closest', showlegend: true, legend: legend(), margin: {l: 72, r: 24, t: 30, b: 48},
      xaxis: axes({title: {text: nameOf(key), standoff: 6}, type: key.log ? 'log' : undefined, anchor: two ? 'y2' : 'y', zeroline: false}),
      yaxis: axes({title: {text: 'x / µm', standoff: 8}, automargin: false, domain: two ? [0.34, 1] : [0, 1], exponentformat: 'none', separatethousands: true}),
      ...(two ? {yaxis2: axes({title: {text: 'exponent / (1/s)', standoff: 8}, automargin: false, domain: [0, 0.26], zerolinecolor: css('--soft')})} : {})})};
}

// Branches of periodic rubs (`rub_branches` of compare/modes/rub_branches_text.h): stable parts solid, unstable ones dashed.
const marks = {fold: 'triangle-left', branching: 'cross', 'period doubling': 'diamond', torus: 'circle-open', grazing: 'x'};
const scales = {mean_force: 1, amplitude: micro, multiplier: 1};
const titles = {mean_force: 'mean normal force / N', amplitude: 'deflection / µm', multiplier: 'largest multiplier'};

// A key of the branches with its unit as people read it.
const axisOf = ({key, unit, values}) => ({name: key, unit: shownUnit(unit).name, perSi: shownUnit(unit).perSi, values});

export function branchesFigure({branches, ...data}, figure) {
  const across = axisOf(data.across), up = data.up && axisOf(data.up), values = up ? up.values : [null], scale = scales[figure];
  const colorOf = ({up: value}) => css(`--mode-${values.indexOf(value) % 6 + 1}`);
  const nameAt = ({up: value}) => up ? `${up.name} = ${short(value * up.perSi, 5)}${up.unit ? ` ${up.unit}` : ''}` : 'periodic rubs';
  const x = (points) => points.map((p) => p.value * across.perSi), y = (points) => points.map((p) => p[figure] * scale);
  const words = ({order}, points) => points.map((p) =>
    `${p.point ? `${p.point}, ` : ''}${p.kind}${order > 1 ? `, sub-harmonic 1/${order}` : ''}, ${p.stable ? 'stable' : 'unstable'}`);
  const hover = `%{text}<br>${across.name} = %{x:.5g}, ${titles[figure]} = %{y:.5g}<extra></extra>`;
  const named = new Set();
  const isNew = (name) => !named.has(name) && Boolean(named.add(name));
  const lines = branches.flatMap((branch) => partsOf(branch.points).map(({stable, points}) => ({x: x(points), y: y(points), text: words(branch, points),
    type: 'scatter', mode: 'lines', name: nameAt(branch), legendgroup: nameAt(branch), showlegend: stable && isNew(nameAt(branch)), hovertemplate: hover,
    line: {color: colorOf(branch), width: stable ? 2.4 : 1.4, dash: stable ? 'solid' : 'dash', simplify: false}})));
  const special = branches.flatMap((branch) => Object.entries(marks).flatMap(([kind, symbol]) => {
    const points = branch.points.filter(({point}) => point === kind);
    return points.length ? [{x: x(points), y: y(points), text: words(branch, points), type: 'scatter', mode: 'markers', name: kind, legendgroup: kind,
      showlegend: isNew(kind), hovertemplate: hover, marker: {symbol, size: 9, color: colorOf(branch), line: {width: 2, color: colorOf(branch)}}}] : [];
  }));
  // The force in rolling is thousands of times the force in a rub.
  const all = lines.flatMap((line) => line.y), isWide = Math.min(...all) > 0 && Math.max(...all) > 100 * Math.min(...all);
  return {data: [...lines, ...special], layout: layout({hovermode: 'closest', showlegend: true, legend: legend(), margin: {l: 72, r: 24, t: 30, b: 48},
    xaxis: axes({title: {text: nameOf(across), standoff: 6}, zeroline: false}),
    yaxis: axes({title: {text: titles[figure], standoff: 8}, automargin: false, ...(isWide ? decades(all) : {exponentformat: 'none', separatethousands: true})})})};
}
