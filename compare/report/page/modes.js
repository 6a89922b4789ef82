// The page of `modes`: the figures of campbell.js. Without it the page still shows its tables.
'use strict';
page.start(() => document.querySelectorAll('.plot').forEach((plot) => {
  const {data, layout} = page.rotor.of(page.data, plot.dataset.plot, plot.clientWidth);
  Plotly.react(plot, data, layout, page.config);
}));
