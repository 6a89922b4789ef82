// Draws the plots of every scene from the page's data, links their time axes and legends, and
// follows the light or dark theme. Without it the page still shows verdicts, films and tables.
'use strict';
(() => {
  const {data, css, axes, layout, config} = page;

  // ------------------------------------------------------------------ traces
  const dashes = {native: 'solid', rigid: 'solid', coulomb: 'solid', cone: 'solid'};
  const line = (side, width) => ({color: css('--' + side), width, dash: dashes[side] || 'dot'});

  // What scatters most lies behind, and the judged run thin on top of the native one.
  const behindFirst = (sides) => [...sides.slice(2), ...sides.slice(0, 2)];

  // A series over time, in the window that is shown.
  function timeTraces(scene, key, window) {
    return behindFirst(scene.sides).filter((side) => side.series[key]).map((side) => {
      const {t, y} = side.series[key][window];
      return {x: t, y, name: side.label, meta: side.label, type: 'scatter', mode: 'lines',
        opacity: side.label === 'cone' ? 0.6 : 1,
        line: line(side.label, side.label === 'native' ? 2.4 : 1.2),
        hovertemplate: '%{y:.5g}<extra>' + side.label + '</extra>'};
    });
  }

  // The same run with a passive bearing, behind all others.
  function uncontrolledTraces(scene, key, window) {
    const series = scene.uncontrolled[key];
    return series ? [{x: series[window].t, y: series[window].y, name: 'without control', meta: 'without control',
      type: 'scatter', mode: 'lines', line: {color: css('--soft'), width: 1, dash: 'dot'}, opacity: 0.7,
      hovertemplate: '%{y:.5g}<extra>without control</extra>'}] : [];
  }

  // Every impact a point. `law`: over what it is drawn.
  const laws = {
    impacts: {x: 't', y: 'y', text: 't = %{x:.6g} s<br>%{y:.4g} mN s'},
    friction_impacts: {x: 't', y: 'friction', text: 't = %{x:.6g} s<br>%{y:.4g} mN s'},
    normal_law: {x: 'before', y: 'after', text: 'before %{x:.4g} m/s<br>after %{y:.4g} m/s'},
    friction_law: {x: 'slip', y: 'share', text: 'slip after %{x:.4g} m/s<br>%{y:.4g} of friction times normal'},
  };
  function impactTraces(scene, key) {
    const law = laws[key];
    return scene.sides.map((side) => ({x: side.impacts[law.x], y: side.impacts[law.y], name: side.label,
      meta: side.label, type: 'scatter', mode: 'markers',
      marker: {color: css('--' + side.label), size: 5, opacity: 0.75,
        symbol: side.label === 'native' ? 'circle' : side.label === 'cone' ? 'triangle-up-open' : 'circle-open'},
      hovertemplate: law.text + '<extra>' + side.label + '</extra>'}));
  }

  // A run's own points on the characteristic of what drives it.
  function characteristicTraces(scene, key, window) {
    const curves = key === 'motor' ? (scene.motor ? [{...scene.motor, name: 'characteristic'}] : []) : scene.actuator;
    const law = curves.map((c) => ({x: c.x, y: c.y, name: c.name, meta: c.name, type: 'scatter', mode: 'lines',
      line: {color: css('--soft'), width: 1, dash: 'dash'}, hovertemplate: '%{y:.4g}<extra>' + c.name + '</extra>'}));
    return [...law, ...behindFirst(scene.sides).filter((side) => side.paths[key]).map((side) => ({
      x: side.paths[key][window].x, y: side.paths[key][window].y, name: side.label, meta: side.label, type: 'scatter',
      mode: 'lines', line: line(side.label, side.label === 'native' ? 2.4 : 1.2),
      hovertemplate: '(%{x:.4g}, %{y:.4g})<extra>' + side.label + '</extra>'}))];
  }

  // The laws themselves: after = -eps before, and Coulomb's: against the slip, within +-1 where there is none.
  function lawShape(scene, key) {
    const line = {color: css('--soft'), width: 1, dash: 'dash'};
    const all = scene.sides.flatMap((side) => side.impacts[laws[key].x]);
    const low = Math.min(0, ...all), high = Math.max(0, ...all);
    const piece = (x0, y0, x1, y1) => ({type: 'line', x0, y0, x1, y1, line, layer: 'below'});
    return key === 'normal_law' ? [piece(low, -scene.restitution * low, 0, 0)] :
      [piece(low, 1, 0, 1), piece(0, 1, 0, -1), piece(0, -1, high, -1)];
  }

  function curve(side, xy, text, width, dash) {
    return {x: xy.x, y: xy.y, name: side.label, meta: side.label, type: 'scatter', mode: 'lines',
      line: {color: css('--' + side.label), width, dash},
      hovertemplate: '(%{x:.1f}, %{y:.1f}) µm<extra>' + side.label + ' ' + text + '</extra>'};
  }
  const orbitTraces = (scene, window) => behindFirst(scene.sides).flatMap((side) => [
    curve(side, side.rotor[window], 'rotor', side.label === 'native' ? 2.4 : 1.2, 'solid'),
    curve(side, side.ring[window], 'ring', side.label === 'native' ? 1.8 : 1, 'dot')]);
  const relativeTraces = (scene, window) =>
    behindFirst(scene.sides).map((side) =>
      curve(side, side.relative[window], 'relative', side.label === 'native' ? 2.4 : 1.2, 'solid'));

  // The first two runs, native and the contact model that is judged, set the height of a force plot;
  // a run that leaves it says so, rather than flattening the others.
  function heightFor(traces) {
    const extent = (list) => list.reduce((e, trace) => trace.y.reduce(
      (f, y) => [Math.min(f[0], y), Math.max(f[1], y)], e), [0, 0]);
    const [low, high] = extent(traces.slice(-2));
    const room = 0.08 * (high - low);
    const range = [low < 0 ? low - room : -room, high > 0 ? high + room : room];
    const notes = [];
    for (const trace of traces.slice(0, -2)) {
      const [least, most] = extent([trace]);
      const far = Math.abs(least) > most ? least : most;
      if (high === low || (least >= 3 * range[0] && most <= 3 * range[1])) continue;
      notes.push({text: trace.name + ' reaches ' + Number(far.toPrecision(3)).toLocaleString('en') + ' N',
        xref: 'paper', yref: 'paper', x: 0.01, y: far > 0 ? 1 : 0, xanchor: 'left',
        yanchor: far > 0 ? 'top' : 'bottom', yshift: (far > 0 ? -18 : 18) * notes.length, showarrow: false, bgcolor: css('--paper'),
        font: {color: trace.line.color, size: 12}});
    }
    return notes.length ? {axis: {range}, notes} : {};
  }

  // ------------------------------------------------------------------ one scene
  class Scene {
    constructor(element, scene) {
      this.element = element;
      this.scene = scene;
      this.plots = [...element.querySelectorAll('.plot')];
      this.hidden = new Set();
      this.quiet = false;
      this.range = this.span(scene.first_window);
      element.querySelectorAll('[data-window]').forEach((button) => button.addEventListener('click',
        () => this.show(this.span(Number(button.dataset.window)))));
      element.querySelectorAll('.legend-item').forEach((button) => button.addEventListener('click',
        () => this.toggle(button)));
      const playAll = element.querySelector('.play-all');
      if (playAll) playAll.addEventListener('click', () => this.playTogether());
    }

    span(window) {
      const {from, to} = this.scene.windows[window];
      return [from, to];
    }

    // The narrowest window with data for all of the range.
    window() {
      let best = 0;
      this.scene.windows.forEach((w, k) => {
        const holds = w.from <= this.range[0] + 1e-9 && w.to >= this.range[1] - 1e-9;
        const narrower = w.to - w.from < this.scene.windows[best].to - this.scene.windows[best].from;
        if (holds && narrower) best = k;
      });
      return best;
    }

    draw(plot) {
      const {plot: key, over} = plot.dataset;
      const window = this.window();
      let traces, shape;
      // All turns of a run on top of each other show nothing: the last ones stand for it.
      const turns = window > 0 ? window : this.scene.windows.length - 1;
      if (over === 'turns') {
        traces = key === 'orbit' ? orbitTraces(this.scene, turns) : relativeTraces(this.scene, turns);
        const r = 1e6 * this.scene.clearance;
        const circle = {type: 'circle', x0: -r, x1: r, y0: -r, y1: r, line: {color: css('--soft'), width: 1, dash: 'dash'}};
        shape = layout({hovermode: 'closest', shapes: key === 'relative' && r > 0 ? [circle] : [],
          xaxis: axes({title: {text: 'x / µm', standoff: 8}, automargin: false, constrain: 'domain'}),
          yaxis: axes({title: {text: 'y / µm', standoff: 8}, automargin: false, constrain: 'domain', scaleanchor: 'x'})});
      } else if (over === 'law') {
        traces = impactTraces(this.scene, key);
        const titles = key === 'normal_law' ? ['before / (m/s)', 'after / (m/s)'] :
          ['slip after / (m/s)', 'tangential / (friction × normal)'];
        shape = layout({hovermode: 'closest', shapes: lawShape(this.scene, key),
          xaxis: axes({title: {text: titles[0], standoff: 8}}),
          yaxis: axes({title: {text: titles[1], standoff: 8}})});
      } else if (over === 'path') {
        traces = characteristicTraces(this.scene, key, window);
        const titles = key === 'motor' ? ['speed / rpm', 'torque / N m'] : ['current / A', 'force / N'];
        shape = layout({hovermode: 'closest', xaxis: axes({title: {text: titles[0], standoff: 8}}),
          yaxis: axes({title: {text: titles[1], standoff: 8}})});
      } else {
        const impacts = over === 'impacts';
        traces = impacts ? impactTraces(this.scene, key) :
          [...uncontrolledTraces(this.scene, key, window), ...timeTraces(this.scene, key, window)];
        const height = key.endsWith('_force') ? heightFor(traces) : {};
        shape = layout({xaxis: axes({title: {text: 't / s', standoff: 6}, range: this.range.slice(),
            hoverformat: '.5f'}),
          yaxis: axes(impacts ? {type: 'log', exponentformat: 'power', dtick: 1} : height.axis),
          annotations: height.notes || []});
        if (impacts) shape.hovermode = 'closest';
      }
      traces.forEach((trace) => { trace.visible = this.hidden.has(trace.meta) ? 'legendonly' : true; });
      const first = !plot.classList.contains('drawn');
      Plotly.react(plot, traces, shape, config);
      if (first) {
        plot.classList.add('drawn');
        plot.on('plotly_relayout', (change) => this.follow(over, change));
      }
    }

    drawAll() {
      this.quiet = true;
      this.plots.forEach((plot) => this.draw(plot));
      this.quiet = false;
      const shown = this.window();
      const whole = this.span(shown);
      const exact = Math.abs(whole[0] - this.range[0]) + Math.abs(whole[1] - this.range[1]) < 1e-9;
      this.element.querySelectorAll('[data-window]').forEach((button) => button.classList.toggle('on',
        exact && Number(button.dataset.window) === shown));
    }

    // Zooming one plot in time zooms all of them; a double click shows the whole run.
    follow(over, change) {
      if (this.quiet || (over !== 'time' && over !== 'impacts')) return;
      if (change['xaxis.autorange']) this.show(this.span(0));
      const from = change['xaxis.range[0]'], to = change['xaxis.range[1]'];
      if (from === undefined || to === undefined) return;
      this.show([Math.max(this.scene.windows[0].from, from), Math.min(this.scene.windows[0].to, to)]);
    }

    show(range) {
      this.range = range;
      this.drawAll();
    }

    toggle(button) {
      const side = button.dataset.side;
      if (!this.hidden.delete(side)) this.hidden.add(side);
      button.setAttribute('aria-pressed', String(!this.hidden.has(side)));
      this.drawAll();
    }

    playTogether() {
      const films = [...this.element.querySelectorAll('video')];
      const start = films.every((film) => film.paused);
      films.forEach((film) => {
        if (!start) { film.pause(); return; }
        film.currentTime = 0;
        film.play();
      });
    }
  }

  // ------------------------------------------------------------------ all scenes
  function drawTrade() {
    const points = data.trade;
    if (!points) return;
    // One name a scene, on alternating sides: laws of a kind lie close together. A thin line joins its two forces.
    const sides = ['top right', 'bottom right', 'top left', 'bottom left'];
    const pairs = points.map((p) => ({type: 'line', x0: p.orbit, x1: p.orbit, y0: p.contact, y1: p.actuator,
      line: {color: css('--line'), width: 1}, layer: 'below'}));
    const trace = (key, name, symbol, color) => ({x: points.map((p) => p.orbit), y: points.map((p) => p[key]), name,
      text: points.map((p) => p.name), type: 'scatter', mode: key === 'contact' ? 'markers+text' : 'markers',
      textposition: points.map((p, k) => sides[k % sides.length]), cliponaxis: false,
      textfont: {color: css('--soft'), size: 11},
      marker: {symbol, size: 9, color: css(color)},
      hovertemplate: '%{text}<br>orbit %{x:.4g} mm<br>%{y:.4g} N<extra>' + name + '</extra>'});
    Plotly.react('trade', [trace('contact', 'contact', 'circle', '--native'),
      trace('actuator', 'actuators', 'square-open', '--rigid')],
    layout({hovermode: 'closest', showlegend: true, shapes: pairs, legend: {orientation: 'h', y: 1.12},
      margin: {l: 56, r: 110, t: 28, b: 40},
      xaxis: axes({title: {text: 'orbit / mm', standoff: 8}, rangemode: 'tozero'}),
      yaxis: axes({title: {text: 'force / N', standoff: 8}, rangemode: 'tozero'})}), config);
  }

  const scenes = [...document.querySelectorAll('.scene')].map(
    (element) => new Scene(element, data.scenes[Number(element.dataset.scene)]));
  page.start(() => {
    drawTrade();
    scenes.forEach((scene) => scene.drawAll());
  });
})();
