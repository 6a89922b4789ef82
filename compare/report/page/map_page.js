// A page of maps alone (sweep.js): of a sweep, of a linear analysis.
'use strict';
(() => {
  const maps = page.maps(document.querySelector('main'), page.data);
  page.start(maps.draw);
})();
