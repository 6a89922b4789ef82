// The page of `bench`: the figures of bench.js. Without it the page still shows its tables.
'use strict';
page.start(() => document.querySelectorAll('.plot').forEach((plot) =>
  page.show(plot, page.precision.of(page.data.scenes[plot.dataset.scene], plot.dataset.plot))));
