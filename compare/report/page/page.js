// What the scripts of all pages share: the page's data, its colours, plots in its style, and the
// light or dark theme.
'use strict';
const page = (() => {
  const root = document.documentElement;
  // A custom property of the style sheet, kept until the theme changes.
  const colors = new Map();
  function css(name) {
    if (!colors.has(name)) colors.set(name, getComputedStyle(root).getPropertyValue(name).trim());
    return colors.get(name);
  }

  function axes(extra) {
    return Object.assign({gridcolor: css('--hair'), zerolinecolor: css('--line'), linecolor: css('--line'),
      tickcolor: css('--line'), ticks: 'outside', ticklen: 4, automargin: true}, extra);
  }
  function layout(extra) {
    return Object.assign({
      paper_bgcolor: 'rgba(0,0,0,0)', plot_bgcolor: 'rgba(0,0,0,0)', showlegend: false,
      font: {family: getComputedStyle(document.body).fontFamily, size: 12, color: css('--soft')},
      margin: {l: 56, r: 12, t: 8, b: 40}, hovermode: 'x unified',
      hoverlabel: {bgcolor: css('--panel'), bordercolor: css('--line'), font: {color: css('--ink')}},
    }, extra);
  }

  const config = {displaylogo: false, displayModeBar: false};
  const titled = (text, extra) => axes({title: {text, standoff: 8}, ...extra});

  // Red, green and blue of "#rrggbb", and of a share of the way through a palette of such colours.
  const parts = (hex) => [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16));
  function shade(share, palette) {
    const place = Math.min(Math.max(share, 0), 1) * (palette.length - 1), first = Math.min(Math.floor(place), palette.length - 2);
    const a = parts(palette[first]), b = parts(palette[first + 1]);
    return a.map((part, k) => Math.round(part + (place - first) * (b[k] - part)));
  }
  const scaleOfColours = (palette) => palette.map((color, k) => [k / (palette.length - 1), color]);

  // How a run is distinguished from the others: its colour, and as a second cue dash, width and mark. Native is in front.
  const dashes = {native: 'solid', rigid: 'dash', coulomb: 'dashdot', cone: 'dot', 'cone-coulomb': 'longdashdot', 'cone-default': 'dot',
    shadow: 'dash', measured: 'longdash'};
  const symbols = {native: 'circle', rigid: 'circle-open', coulomb: 'square-open', cone: 'triangle-up-open', 'cone-coulomb': 'triangle-down-open',
    'cone-default': 'star-open', shadow: 'diamond-open', measured: 'x-open'};
  const isFront = (label) => label === 'native';
  const line = (label, front = isFront(label)) => ({color: css('--' + label), width: front ? 2.4 : 1.4, dash: dashes[label] || 'dot', simplify: false});
  const symbol = (label) => symbols[label] || 'cross-open';

  // Draws the page, and again whenever the theme changes.
  function start(draw) {
    const prefersDark = matchMedia('(prefers-color-scheme: dark)');
    let chosen = null;
    function theme(name) {
      colors.clear();
      root.dataset.theme = name || chosen || (prefersDark.matches ? 'dark' : 'light');
      document.getElementById('theme').setAttribute('aria-pressed', String(root.dataset.theme === 'dark'));
      draw();
    }
    document.getElementById('theme').addEventListener('click', () => {
      chosen = root.dataset.theme === 'dark' ? 'light' : 'dark';
      theme();
    });
    prefersDark.addEventListener('change', () => theme());
    // On paper a picture does not fit itself to its place: it is drawn for it, at the paper's width.
    function print(on) {
      page.printing = on;
      root.classList.toggle('printing', on);
      theme(on ? 'light' : undefined);
    }
    addEventListener('beforeprint', () => print(true));
    addEventListener('afterprint', () => print(false));
    theme();
  }

  // Draws a figure {data, layout} in its place. On paper at its place's size.
  function show(plot, {data, layout: own}) {
    const size = page.printing ? {width: plot.clientWidth, height: plot.clientHeight} : {};
    Plotly.react(plot, data, Object.assign(own, size), {...config, responsive: !page.printing});
  }

  // Plotly comes last and takes a third of a second: the player is there before it. `ready` follows.
  function withPlotly(ready) {
    requestAnimationFrame(() => setTimeout(() => {
      const script = document.createElement('script');
      script.textContent = document.getElementById('plotly').textContent;
      document.head.append(script);
      ready();
    }, 50));
  }

  return {withPlotly, data: JSON.parse(document.getElementById('data').textContent), css, axes, layout, titled, parts, shade, scaleOfColours,
    isFront, line, symbol, start, show};
})();
