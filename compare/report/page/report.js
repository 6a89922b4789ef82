// The report, and the page of one run: what control trades, then every scene with its plots and its live player,
// under one clock each.
// Without it the page still shows verdicts and tables.
'use strict';
(() => {
  const {data, css, axes, layout} = page;

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
    page.show(document.getElementById('trade'), {data: [trace('contact', 'contact', 'circle', '--native'),
      trace('actuator', 'actuators', 'square-open', '--rigid')],
    layout: layout({hovermode: 'closest', showlegend: true, shapes: pairs, legend: {orientation: 'h', y: 1.12},
      margin: {l: 56, r: 110, t: 28, b: 40},
      xaxis: axes({title: {text: 'orbit / mm', standoff: 8}, rangemode: 'tozero'}),
      yaxis: axes({title: {text: 'force / N', standoff: 8}, rangemode: 'tozero'})})});
  }

  const scenes = [...document.querySelectorAll('.scene')].map(
    (element) => new page.LiveScene(element, data.scenes[Number(element.dataset.scene)]));
  page.players = scenes.map((scene) => scene.player);

  // Results beside the comparison, each drawn when it comes near the screen: {element, draw}.
  const drawStill = (plot) => page.show(plot, page.precision.of(data.benches[plot.dataset.index], plot.dataset.still));
  const beside = [
    ...[...document.querySelectorAll('.plot[data-still]')].map((element) => ({element, draw: () => drawStill(element)})),
    ...[...document.querySelectorAll('.map-set')].map((element) => ({element, draw: page.maps(element, data.maps[element.dataset.index]).draw})),
  ];
  beside.forEach((part) => new IntersectionObserver((entries) => {
    part.near = entries[entries.length - 1].isIntersecting;
    if (part.near && part.stale && window.Plotly) drawPart(part);
  }, {rootMargin: '400px 0px'}).observe(part.element));
  function drawPart(part) {
    part.stale = false;
    part.draw();
    part.element.classList.add('drawn');
  }

  function draw() {
    scenes.forEach((scene) => scene.drawAll());
    beside.forEach((part) => { part.stale = true; });
    if (!window.Plotly) return;
    drawTrade();
    beside.filter((part) => part.near || page.printing).forEach(drawPart);
  }
  page.start(draw);
  if (scenes.length) scenes[0].begin();
  page.withPlotly(draw);
})();
