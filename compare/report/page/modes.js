// The page of `modes`: the figures of campbell.js. Without it the page still shows its tables.
'use strict';
page.start(() => document.querySelectorAll('.plot').forEach((plot) =>
  page.show(plot, page.rotor.of(page.data, plot.dataset.plot, plot.clientWidth))));
