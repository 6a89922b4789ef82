// Figures without a clock: of a bench, maps of a sweep or of a linear analysis, the free rotor, the closed loop of
// magnetic bearings, a bifurcation diagram, branches of periodic rubs. Each is drawn when it comes near the screen. On pages of their own, and beside the comparison in the report.
import {bifurcationFigure, branchesFigure} from './bifurcation.js';
import {loopFigure} from './loop.js';
import {mapsOf} from './maps.js';
import {convergenceFigure} from './optimum.js';
import {data, inTurn, isPrinting, show, whenNear} from './page.js';
import {benchOf, precision} from './precision.js';
import {rotorFigure} from './rotor.js';

// Keyed by the kind of plot, the value of data-of.
const figures = {
  loop: (plot) => loopFigure(data.loops[plot.dataset.index], plot.dataset.plot),
  convergence: (plot) => convergenceFigure(data.search, plot),
  bifurcation: () => bifurcationFigure(data.bifurcation),
  branches: (plot) => branchesFigure(data.branches, plot.dataset.plot),
  bench: (plot) => precision(benchOf(data.benches[plot.dataset.index]), plot.dataset.plot, plot),
  rotor: (plot) => rotorFigure(data.rotor, plot.dataset.plot, plot.clientWidth, plot.dataset.index),
};

// Returns the function that redraws everything near the screen. further: functions for further kinds of plots, each of which
// draws its plot itself.
export function stills(further = {}) {
  const of = (selector, drawOf) => [...document.querySelectorAll(selector)].map((element) => ({element, draw: drawOf(element)}));
  const all = [...of('.plot[data-of]', (plot) => () => {
    const kind = plot.dataset.of;
    if (further[kind]) further[kind](plot); else show(plot, figures[kind](plot));
  }),
    ...of('.map-set', (set) => mapsOf(set, data.maps[set.dataset.index]))];
  function draw(one) {
    one.stale = false;
    one.draw();
    one.element.classList.add('drawn');
  }
  for (const one of all) {
    whenNear(one.element, (near) => {
      one.near = near;
      if (near && one.stale && window.Plotly) inTurn(one, () => draw(one));
    });
  }
  return () => {
    for (const one of all) one.stale = true;
    if (!window.Plotly) return;
    for (const one of all) if (one.near || isPrinting()) inTurn(one, () => draw(one));
  };
}
