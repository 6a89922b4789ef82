// What the scripts of all pages share: the page's data, its colours, plots in its style, and the
// light or dark theme.
'use strict';
const page = (() => {
  const root = document.documentElement;
  const css = (name) => getComputedStyle(root).getPropertyValue(name).trim();

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

  // Draws the page, and again whenever the theme changes.
  function start(draw) {
    const prefersDark = matchMedia('(prefers-color-scheme: dark)');
    let chosen = null;
    function theme(name) {
      root.dataset.theme = name || chosen || (prefersDark.matches ? 'dark' : 'light');
      draw();
    }
    document.getElementById('theme').addEventListener('click', () => {
      chosen = root.dataset.theme === 'dark' ? 'light' : 'dark';
      theme();
    });
    prefersDark.addEventListener('change', () => theme());
    addEventListener('beforeprint', () => theme('light'));
    addEventListener('afterprint', () => theme());
    theme();
  }

  return {data: JSON.parse(document.getElementById('data').textContent), css, axes, layout, start,
    config: {responsive: true, displaylogo: false, displayModeBar: false}};
})();
