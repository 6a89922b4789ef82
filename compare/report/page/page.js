// The scripts of all pages share this: the page's data, the drawing of a plot, the light or dark theme, and the units.
import {foldParts} from './fold.js';
import {writeHead} from './head.js';
import {unpacked} from './packed.js';
import {offerFiles} from './save.js';
import {forgetColours, growBy, legendBelow} from './style.js';
import {choose, convertTexts, figureInUnits, siText, systems} from './unit_system.js';

const root = document.documentElement;
export const data = JSON.parse(document.getElementById('data').textContent);
export const isPrinting = () => root.classList.contains('printing');

// Draws the page, and again whenever the theme changes.
export function start(draw) {
  writeHead(data);
  foldParts();
  const prefersDark = matchMedia('(prefers-color-scheme: dark)'), button = document.getElementById('theme');
  let chosen = null;
  function theme(name) {
    forgetColours();
    root.dataset.theme = name || chosen || (prefersDark.matches ? 'dark' : 'light');
    button.setAttribute('aria-pressed', String(root.dataset.theme === 'dark'));
    draw();
  }
  button.addEventListener('click', () => {
    chosen = root.dataset.theme === 'dark' ? 'light' : 'dark';
    theme();
  });
  prefersDark.addEventListener('change', () => theme());
  chooseUnits(draw);
  // A printed plot does not adapt to its place, so it is drawn again at the paper's width.
  function print(on) {
    root.classList.toggle('printing', on);
    theme(on ? 'light' : undefined);
  }
  addEventListener('beforeprint', () => print(true));
  addEventListener('afterprint', () => print(false));
  theme();
}

// Pages of maps keep the units of their study, in which the keys are set.
const kOwnUnits = ['sweep', 'optimise', 'rub_map', 'feedback_map'];

// The list of units in the page's head; the page's address keeps the choice.
function chooseUnits(draw) {
  if (kOwnUnits.includes(data.page.kind)) {
    document.querySelector('.unit-system').remove();
    return;
  }
  const list = document.getElementById('units'), address = new URL(location.href);
  for (const [key, {name}] of Object.entries(systems)) list.add(new Option(name, key));
  function take(key) {
    choose(key);
    convertTexts(document.querySelector('main'));
  }
  list.value = address.searchParams.get('units') in systems ? address.searchParams.get('units') : 'si';
  take(list.value);
  list.addEventListener('change', () => {
    const now = new URL(location.href);
    now.searchParams.set('units', list.value);
    if (list.value === 'si') now.searchParams.delete('units');
    history.replaceState(null, '', now);
    take(list.value);
    draw();
  });
}

// A legend above a narrow plot takes rows from it, so it stands below, and the plot grows.
const kNarrow = 560;  // px
function legendPlaced(plot, {data: traces, layout}) {
  if (!layout.showlegend || layout.legend?.yref === 'container') return {data: traces, layout};
  const names = [...new Set(traces.filter(({showlegend, name}) => showlegend !== false && name).map(({name}) => name))];
  const isNarrow = plot.clientWidth < kNarrow, {legend, height} = legendBelow(names, plot.clientWidth);
  growBy(plot, isNarrow ? height : 0);
  return {data: traces, layout: isNarrow ? {...layout, legend, margin: {...layout.margin, t: 8, b: layout.margin.b + height}} : layout};
}

// Draws a figure {data, layout} in its place. The units are the chosen ones, except in maps, whose keys have their own units.
// In print the figure has the size of its place. plot.factors: conversion of x and y from the figure's to the shown units.
export function show(plot, figure) {
  const unit = plot.closest('figure')?.querySelector('figcaption .unit');
  const {data: traces, layout, factors} = plot.closest('.map-set') ? {...figure, factors: {x: 1, y: 1}} :
    figureInUnits(legendPlaced(plot, figure), unit && siText(unit).trim());
  plot.factors = factors;
  const size = isPrinting() ? {width: plot.clientWidth, height: plot.clientHeight} : {};
  Plotly.react(plot, traces, {...layout, ...size}, {displaylogo: false, displayModeBar: false, responsive: !isPrinting()});
  plot.tabIndex = 0;
  plot.setAttribute('role', 'group');
  const title = plot.closest('figure')?.querySelector('figcaption b');
  plot.setAttribute('aria-label', `plot: ${title ? title.textContent : plot.id || 'figure'}`);
  offerFiles(plot);
}

// Draws one plot per frame, so that the page can be scrolled meanwhile; for printing it draws at once. A later call with the
// same `of` replaces an earlier one.
const waiting = new Map();
function drawNext() {
  const [first] = waiting;
  if (!first) return;
  waiting.delete(first[0]);
  if (waiting.size) requestAnimationFrame(drawNext);
  first[1]();
}
export function inTurn(of, draw) {
  if (isPrinting()) {
    waiting.delete(of);
    draw();
    return;
  }
  waiting.set(of, draw);
  if (waiting.size === 1) requestAnimationFrame(drawNext);
}

// Calls act(near) when the element comes near the screen, and when it leaves.
export function whenNear(element, act) {
  new IntersectionObserver((entries) => act(entries[entries.length - 1].isIntersecting), {rootMargin: '400px 0px'}).observe(element);
}

// Resolves when the browser reports its first paint, or after two seconds if it never does (a hidden tab, printing).
function painted() {
  return new Promise((go) => {
    setTimeout(go, 2000);
    if (!window.PerformanceObserver) return;
    const observer = new PerformanceObserver((list) => {
      if (!list.getEntriesByName('first-contentful-paint').length) return;
      observer.disconnect();
      go();
    });
    observer.observe({type: 'paint', buffered: true});
  });
}

// Loads plotly last, because it takes a third of a second; text, tables and the player are shown before. Then calls `ready`.
export async function withPlotly(ready) {
  await painted();
  const script = document.createElement('script');
  script.textContent = await unpacked('plotly').text();
  document.head.append(script);
  ready();
}
