// How contact forces and impulses are distributed, and what is left of a record beside each run, as plotly takes them.
import {opened, thinned} from './scales.js';
import {axes, css, decades, layout, line, number, titled} from './style.js';

// The corners of a staircase: share[k] from k width to (k + 1) width.
export function staircase({width, share}) {
  const x = [0], y = [0];
  share.forEach((value, k) => {
    x.push(k * width, (k + 1) * width);
    y.push(value, value);
  });
  return {x: [...x, share.length * width], y: [...y, 0]};
}

const trace = (label, x, y, more) => ({x, y, name: label, meta: label, type: 'scatter', mode: 'lines', line: line(label), ...more});

// The first two runs set the width, as they do the height of a force plot; one that goes far beyond says so.
export function widthFor(sides) {
  const reach = ({of}) => of.force.width * of.force.share.length, all = sides.filter(({of}) => of.force);
  const usual = 1.05 * Math.max(0, ...all.slice(-2).map(reach));
  const beyond = all.filter((side) => reach(side) > 3 * usual);
  return beyond.length ? {range: [0, Math.max(usual, ...all.filter((side) => !beyond.includes(side)).map(reach))], beyond: beyond.map((side) => ({label: side.label, most: reach(side)}))} :
    {beyond};
}

function force(sides) {
  const {range, beyond} = widthFor(sides);
  return {data: sides.filter(({of}) => of.force).map(({label, of}) => {
    const {x, y} = staircase(of.force);
    return trace(label, x, y, {line: {...line(label), dash: 'solid'}, hovertemplate: `%{x:.4g} N: %{y:.3g} % of the time<extra>${label}</extra>`});
  }), layout: layout({hovermode: 'closest', xaxis: titled('normal force / N', range ? {range} : {}), yaxis: titled('share of the time / %', decades),
    annotations: beyond.map(({label, most}, k) => ({text: `${label} reaches ${number(most, 3)} N`, xref: 'paper', yref: 'paper', x: 1, y: 1, xanchor: 'right',
      yanchor: 'top', yshift: -16 * k, showarrow: false, font: {color: css(`--${label}`), size: 12}}))})};
}

function impulse(sides) {
  return {data: sides.filter(({of}) => of.impulse).map(({label, of}) => trace(label, of.impulse.value, of.impulse.count, {
    line: {...line(label), shape: 'vh'}, hovertemplate: `%{y} impacts reach %{x:.4g} mN s<extra>${label}</extra>`})),
  layout: layout({hovermode: 'closest', xaxis: titled('normal impulse / mN s', {type: 'log', exponentformat: 'power'}),
    yaxis: titled('impacts that reach it', {type: 'log', exponentformat: 'none'})})};
}

const figures = {force_spread: force, impulse_spread: impulse};
// number: of the contact.
export const spreadFigure = (key, scene, number) => figures[key]([...scene.sides].reverse().map(({label, distribution}) => ({label, of: distribution[number]})));

// Record minus run along x, um, at the record's samples within both.
export function measuredMinus(record, run, [from, to]) {
  const t = record.tracks.rotor.instants(Math.max(from, run.start), Math.min(to, run.end), 2).filter((time) => record.within(time));
  return {t, y: t.map((time) => 1e6 * (record.tracks.rotor.at(time, 0) - run.tracks.rotor.at(time, 0)))};
}

export function minusFigure(runs, range) {
  const record = runs.find((run) => run.measured), others = runs.filter((run) => !run.measured && run.has('rotor'));
  const data = !record?.has('rotor') ? [] : [...others].reverse().map((run) => {
    const all = measuredMinus(record, run, range), {t, y} = opened(thinned(all.t, all.y, 700), record.holes.rotor);
    return trace(run.label, t, y, {hovertemplate: `measured − ${run.label}: %{y:.4g} µm<extra></extra>`});
  });
  return {data, layout: layout({hovermode: 'x unified', xaxis: axes({title: {text: 't / s', standoff: 6}, range: range.slice(), hoverformat: '.6f'}),
    yaxis: axes({zerolinecolor: css('--soft')})})};
}
