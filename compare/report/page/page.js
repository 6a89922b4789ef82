// What the scripts of all pages share: the page's data, the drawing of a plot, and the light or dark theme.
import {offerFiles} from './save.js';
import {forgetColours} from './style.js';

const root = document.documentElement;
export const data = JSON.parse(document.getElementById('data').textContent);
export const isPrinting = () => root.classList.contains('printing');

// Draws the page, and again whenever the theme changes.
export function start(draw) {
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
  // On paper a picture does not fit itself to its place: it is drawn for it, at the paper's width.
  function print(on) {
    root.classList.toggle('printing', on);
    theme(on ? 'light' : undefined);
  }
  addEventListener('beforeprint', () => print(true));
  addEventListener('afterprint', () => print(false));
  theme();
}

// Draws a figure {data, layout} in its place. On paper at its place's size.
export function show(plot, {data: traces, layout}) {
  const size = isPrinting() ? {width: plot.clientWidth, height: plot.clientHeight} : {};
  Plotly.react(plot, traces, {...layout, ...size}, {displaylogo: false, displayModeBar: false, responsive: !isPrinting()});
  offerFiles(plot);
}

// Calls act(near) when the element comes near the screen, and when it leaves.
export function whenNear(element, act) {
  new IntersectionObserver((entries) => act(entries[entries.length - 1].isIntersecting), {rootMargin: '400px 0px'}).observe(element);
}

// Plotly comes last and takes a third of a second: the player is there before it. `ready` follows.
export function withPlotly(ready) {
  requestAnimationFrame(() => setTimeout(() => {
    const script = document.createElement('script');
    script.textContent = document.getElementById('plotly').textContent;
    document.head.append(script);
    ready();
  }, 50));
}
