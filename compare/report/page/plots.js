// The plots of one scene, from its runs' tracks: sampled anew for every window, linked in time and legend, under the
// cursor of the scene's clock. Each is drawn when it comes near the screen.
import {micro} from './factors.js';
import {inTurn, isPrinting, show, whenNear} from './page.js';
import {css, nameOf} from './style.js';
import {sceneFigure} from './traces.js';

export class ScenePlots {
  // runs: of scene.sides, each with its contacts. seek(t): called for a click at t. look(t): called with the time under the
  // pointer, or null when it leaves. changed(): called when the zoom or the shown runs change.
  constructor(element, scene, runs, {seek, look, changed}) {
    Object.assign(this, {element, scene, runs, seek, look, changed, looked: null});
    this.plots = [...element.querySelectorAll('.plot')];
    this.hidden = new Set();
    this.near = new Set();
    this.quiet = false;
    this.range = this.span(0);
    this.t = scene.windows[0].from;
    const onClick = (selector, act) => {
      for (const button of element.querySelectorAll(selector)) button.addEventListener('click', () => act(button));
    };
    onClick('[data-window]', (button) => this.show(this.span(Number(button.dataset.window))));
    onClick('.legend-item', (button) => this.toggle(button));
    for (const plot of this.plots) this.watch(plot);
  }

  watch(plot) {
    whenNear(plot, (near) => {
      if (!near) this.near.delete(plot);
      if (!near || this.near.has(plot)) return;
      this.near.add(plot);
      // The cursor has moved while the plot was off the screen.
      if (window.Plotly && plot.stale !== false) inTurn(plot, () => this.draw(plot)); else this.place(plot);
    });
    plot.addEventListener('keydown', (event) => this.key(plot, event));
    this.listen(plot);
  }

  // The pointer over a plot over time marks its instant in all of them.
  listen(plot) {
    plot.addEventListener('pointermove', (event) => { if (!event.buttons && event.pointerType !== 'touch') this.look(this.timeUnder(plot, event)); });
    plot.addEventListener('pointerleave', () => this.look(null));
    // A click seeks; a drag is plotly's own, and zooms.
    let down = null;
    plot.addEventListener('pointerdown', (event) => { down = [event.clientX, event.clientY]; }, true);
    window.addEventListener('pointerup', (event) => {
      const from = down;
      down = null;
      if (from && Math.hypot(event.clientX - from[0], event.clientY - from[1]) < 4) this.clicked(plot, event);
    }, true);
  }

  // A plot over time elsewhere on the page, already drawn.
  link(plot) {
    if (!plot.isConnected) return;
    if (!plot.mark) {
      plot.dataset.over = 'time';
      this.mark(plot);
      this.near.add(plot);
      this.listen(plot);
    }
    this.place(plot);
  }

  timeUnder(plot, event) {
    const axis = this.overTime(plot) && plot._fullLayout?.xaxis;
    if (!axis) return null;
    const x = event.clientX - plot.getBoundingClientRect().left - axis._offset;
    return x >= 0 && x <= axis._length ? axis.p2d(x) : null;
  }
  clicked(plot, event) {
    const t = this.timeUnder(plot, event);
    if (t !== null) this.seek(t);
  }

  // The keys of a plot over time: arrows move the cursor, + and - zoom about it, 0 shows the whole run.
  key(plot, event) {
    if (!this.overTime(plot) || event.target !== plot || event.ctrlKey || event.altKey || event.metaKey) return;
    const [from, to] = this.range, whole = this.span(0), step = (to - from) * (event.shiftKey ? 0.2 : 0.02);
    const zoom = (factor) => this.show([Math.max(whole[0], this.t - factor * (this.t - from)),
      Math.min(whole[1], this.t + factor * (to - this.t))]);
    const acts = {ArrowLeft: () => this.seek(this.t - step, false), ArrowRight: () => this.seek(this.t + step, false),
      Home: () => this.seek(from, false), End: () => this.seek(to, false), '+': () => zoom(0.5), '-': () => zoom(2), 0: () => this.show(whole)};
    if (!acts[event.key]) return;
    event.preventDefault();
    acts[event.key]();
  }

  overTime(plot) { return plot.dataset.over === 'time' || plot.dataset.over === 'impacts'; }
  span(window) {
    const {from, to} = this.scene.windows[window];
    return [from, to];
  }
  // All turns of a run on top of each other are unreadable, so the whole run is represented by its last turns.
  turns() {
    const whole = this.scene.windows[0];
    const all = this.range[0] <= whole.from && this.range[1] >= whole.to;
    return all ? this.span(this.scene.windows.length - 1) : this.range;
  }

  // The runs at the contact that a plot is of.
  viewOf({dataset: {contact}}) {
    const number = Number(contact || 0);
    return {scene: this.scene, number, contact: this.scene.contacts[number], runs: this.runs.map((run) => run.contacts[number])};
  }

  draw(plot) {
    const {plot: key, over} = plot.dataset;
    const range = over === 'turns' ? this.turns() : this.range;
    const {data, layout, at} = sceneFigure(this.viewOf(plot), {key, over, range, hidden: this.hidden, width: plot.clientWidth});
    plot.at = at;
    data.forEach((trace) => { trace.visible = this.hidden.has(trace.meta) ? 'legendonly' : trace.visible || true; });
    const first = !plot.classList.contains('drawn');
    plot.stale = false;
    this.quiet = true;
    show(plot, {data, layout});
    this.quiet = false;
    if (first) {
      plot.classList.add('drawn');
      plot.on('plotly_relayout', (change) => this.follow(plot, change));
      plot.on('plotly_afterplot', () => this.place(plot));
      this.mark(plot);
    }
    this.place(plot);
  }

  drawAll() {
    this.plots.forEach((plot) => { plot.stale = true; });
    for (const plot of this.plots) if (isPrinting() || this.near.has(plot)) this.draw(plot);
    this.scene.windows.forEach((w, k) => {
      const shown = Math.abs(w.from - this.range[0]) + Math.abs(w.to - this.range[1]) < 1e-9;
      const button = this.element.querySelector(`[data-window="${k}"]`);
      button.classList.toggle('on', shown);
      button.setAttribute('aria-pressed', String(shown));
    });
  }

  // ---------------------------------------------------------------- the cursor
  // Places the cursor at t. looked: the instant under the pointer, or null.
  cursor(t, looked = null) {
    Object.assign(this, {t, looked});
    for (const plot of this.near) this.place(plot);
  }

  // The cursor of a plot and the mark of the instant under the pointer.
  mark(plot) {
    const add = (kind) => Object.assign(plot.appendChild(document.createElement('i')), {className: kind});
    plot.mark = add(this.overTime(plot) ? 'cursor' : 'cursor-dots');
    if (this.overTime(plot)) plot.lookedMark = add('cursor looked');
  }
  placeLine(line, {xaxis, _size: {t: top, h: height}}, t) {
    const [from, to] = xaxis.range;
    line.hidden = t === null || t < from || t > to;
    if (!line.hidden) line.style.cssText = `top:${top}px;height:${height}px;transform:translateX(${xaxis._offset + xaxis.d2p(t)}px)`;
  }

  place(plot) {
    const layout = plot._fullLayout;
    if (!plot.mark || !layout?.xaxis) return;
    // For tests: the time of the cursor.
    plot.dataset.cursor = this.t;
    const t = this.looked ?? this.t;
    if (plot.dataset.over === 'turns') this.placeDots(plot, layout, this.onOrbits(plot, t));
    if (plot.at) this.placeDots(plot, layout, plot.at(t).filter(({label}) => !this.hidden.has(label)));
    if (!this.overTime(plot)) return;
    this.placeLine(plot.mark, layout, this.t);
    this.placeLine(plot.lookedMark, layout, this.looked);
  }

  // The position of each run at t on its orbit, um.
  onOrbits(plot, t) {
    const orbit = plot.dataset.plot === 'orbit';
    return this.viewOf(plot).runs.filter((run) => run.has('rotor') && !this.hidden.has(run.label) && run.within(t) && (orbit || run.ringKnown))
      .map((run) => {
        const {rotor, ring} = run.pose(t), from = orbit ? [0, 0] : ring;
        return {label: run.label, x: micro * (rotor[0] - from[0]), y: micro * (rotor[1] - from[1])};
      });
  }

  placeDots(plot, layout, places) {
    plot.mark.innerHTML = places.map((place) => {
      const x = layout.xaxis.d2p(place.x * plot.factors.x), y = layout.yaxis.d2p(place.y * plot.factors.y);
      const inside = x >= 0 && x <= layout.xaxis._length && y >= 0 && y <= layout.yaxis._length;
      return inside ? `<b data-side="${place.label}" style="left:${layout.xaxis._offset + x}px;top:${layout.yaxis._offset + y}px;` +
        `background:${css(`--${place.label}`)}"></b>` : '';
    }).join('');
  }

  // Zooming one plot in time zooms all of them; a double click shows the whole run.
  follow(plot, change) {
    if (this.quiet || !this.overTime(plot)) return;
    if (change['xaxis.autorange']) this.show(this.span(0));
    const from = change['xaxis.range[0]'], to = change['xaxis.range[1]'];
    if (from === undefined || to === undefined) return;
    this.show([Math.max(this.scene.windows[0].from, from), Math.min(this.scene.windows[0].to, to)]);
  }

  show(range) {
    this.range = range;
    this.drawAll();
    this.changed();
  }

  toggle(button) {
    const side = button.dataset.side;
    if (!this.hidden.delete(side)) this.hidden.add(side);
    button.setAttribute('aria-pressed', String(!this.hidden.has(side)));
    this.drawAll();
    this.changed();
  }

  // Adds a run to the legend.
  join(label) {
    const legend = this.element.querySelector('.legend');
    if (legend.querySelector(`[data-side="${label}"]`)) return;
    const button = legend.lastElementChild.cloneNode(true);
    button.dataset.side = label;
    button.innerHTML = `<i class="swatch side-${label}"></i>${nameOf(label)}`;
    button.setAttribute('aria-pressed', 'true');
    button.addEventListener('click', () => this.toggle(button));
    legend.append(button);
  }

  // Restores the view of a link before anything is drawn. Times and runs that the scene does not have are ignored.
  restore({from, to, hidden}) {
    const whole = this.scene.windows[0];
    if (from < to && from < whole.to && to > whole.from) this.range = [Math.max(whole.from, from), Math.min(whole.to, to)];
    for (const button of this.element.querySelectorAll('.legend-item')) {
      if (!hidden.has(button.dataset.side)) continue;
      this.hidden.add(button.dataset.side);
      button.setAttribute('aria-pressed', 'false');
    }
  }
}
