// The live player of a scene: two runs of the reader's choice under the scene's clock, drawn by rig, section and
// unrolled gap with common scales, the last two for each contact. state() returns what is shown, for tests and scripts.
import {besideNative} from '../first.js';
import {isPrinting} from '../page.js';
import {nameOf} from '../style.js';
import {showReadings} from './readings.js';
import {Rig} from './rig.js';
import {Section} from './section.js';
import {units} from './units.js';
import {Unrolled} from './unrolled.js';

const kPaces = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];
const kTurnByKey = 0.1;  // rad
const kFilm = 25;  // s, duration of a run at the initial pace

export class Player {
  // live: the element that holds player, transport and plots. runs: of run.js; left: those without a rotor to draw.
  constructor(live, scene, runs, clock, left = []) {
    this.element = live.querySelector('.player');
    this.transport = live.querySelector('.transport');
    Object.assign(this, {scene, runs, left, clock, visible: false, rig: undefined, rigs: [], looked: null});
    this.touches = scene.contacts[0].touches;
    const places = [...this.element.querySelectorAll('.player-run')];
    this.chosen = runs.length > 1 ? [0, besideNative(runs)] : [0];
    if (!this.touches) for (const part of this.element.querySelectorAll('.section, .unrolled-figure')) part.remove();
    this.places = [];
    this.spare = places.slice(this.chosen.length);  // for a run that is added later
    for (const place of this.spare) place.remove();
    for (const place of places.slice(0, this.chosen.length)) this.take(place);
    this.listen();
    this.choose();
  }
  // Adds a side to the player. For each contact it has a canvas, readings and the mode.
  take(place) {
    const k = this.places.push({place, feet: [...place.querySelectorAll('.run-foot')].map((foot) =>
      ({section: foot.querySelector('canvas.section'), list: foot.querySelector('.readings'), mode: (foot.querySelector('.mode') || place.querySelector('.mode'))}))}) - 1;
    const select = place.querySelector('select');
    this.runs.forEach((run, r) => { select.add(new Option(nameOf(run.label), r, false, r === this.chosen[k])); });
    select.addEventListener('change', () => { this.chosen[k] = Number(select.value); this.choose(); });
    this.turnBy(place.querySelector('canvas.rig'));
  }
  // Shows a run that was computed in the page beside the first one, or in place of the previously computed run.
  join(run) {
    const before = this.runs.findIndex(({label}) => label === run.label);
    if (before < 0) {
      const at = this.runs.push(run) - 1;
      for (const {place} of this.places) place.querySelector('select').add(new Option(nameOf(run.label), at));
      this.chosen[1] = at;
      if (this.spare.length) {
        const place = this.spare.shift();
        this.places[0].place.after(place);
        this.take(place);
      }
      this.places[1].place.querySelector('select').value = at;
    } else {
      this.runs[before] = run;
    }
    this.choose();
  }

  get shown() { return this.chosen.map((k) => this.runs[k]); }
  shownAt(contact) { return this.shown.map((run) => run.contacts[contact]); }

  listen() {
    const on = (name, event, act) => this.transport.querySelector(name).addEventListener(event, act);
    on('.play', 'click', () => this.clock.play());
    on('.to-start', 'click', () => this.clock.seek(this.clock.from));
    on('.to-before', 'click', () => this.clock.toImpact(-1));
    on('.to-next', 'click', () => this.clock.toImpact(1));
    on('.seek', 'input', (event) => this.clock.seek(Number(event.target.value)));
    on('.slowing', 'change', (event) => { this.clock.slowing = event.target.checked; });
    on('.outline', 'change', () => this.draw());
    // Lists, checkboxes and buttons handle some keys themselves.
    const keys = (event) => {
      const {tagName, type} = event.target;
      if (tagName !== 'SELECT' && type !== 'checkbox' && !(tagName === 'BUTTON' && event.key === ' ')) this.clock.key(event);
    };
    this.element.addEventListener('keydown', keys);
    this.transport.addEventListener('keydown', keys);
    Object.assign(this.transport.querySelector('.seek'), {min: this.clock.from, max: this.clock.to});
    const pace = this.transport.querySelector('.pace'), wanted = kFilm / (this.clock.to - this.clock.from);
    const first = kPaces.find((p) => p >= wanted) || kPaces[kPaces.length - 1];
    for (const p of kPaces) pace.add(new Option(p === 1 ? 'not' : `1 : ${p.toLocaleString('en')}`, p, false, p === first));
    pace.addEventListener('change', () => { this.clock.pace = 1 / Number(pace.value); });
    this.clock.pace = 1 / first;
    new ResizeObserver(() => this.draw()).observe(this.element);
    new IntersectionObserver((entries) => {
      this.visible = entries[entries.length - 1].isIntersecting;
      if (this.visible) this.draw();
    }, {rootMargin: '100px 0px'}).observe(this.element);
  }

  turnBy(canvas) {
    canvas.addEventListener('pointermove', (event) => {
      if (!(event.buttons & 1)) return;
      this.rig.turn(-event.movementX / 150, event.movementY / 150);
      this.draw();
    });
    const turns = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1]};
    canvas.tabIndex = 0;
    canvas.addEventListener('keydown', (event) => {
      const turn = turns[event.key];
      if (!this.rig || !(turn || event.key === 'Home')) return;
      event.preventDefault();
      event.stopPropagation();
      if (turn) this.rig.turn(kTurnByKey * turn[0], kTurnByKey * turn[1]); else this.rig.turnBack();
      this.draw();
    });
    canvas.addEventListener('dblclick', () => { this.rig.turnBack(); this.draw(); });
  }

  // Updates the scales for the chosen runs. The longest arrows are the forces and impulses of the first run that has any, over
  // all its contacts.
  choose() {
    const {scene} = this, alone = this.chosen.length < 2;
    this.element.classList.toggle('alone', alone);
    this.transport.querySelector('.outline-choice').hidden = alone || !this.touches;
    const most = (run, of) => Math.max(0, ...run.contacts.map(of));
    const first = (of) => this.shown.map((run) => most(run, of)).find((value) => value > 0) || 0;
    const all = (of) => Math.max(...this.shown.map((run) => most(run, of)));
    this.scales = {force: first((run) => run.forces.usual), impulse: first((run) => run.largestImpulse),
      control: all((run) => run.largest('control')), current: all((run) => run.largest('current'))};
    // Only the impacts of the first run that has any, because a bouncing second run would slow down the whole film.
    const hits = this.shown.map((run) => run.contacts.flatMap((at) => at.hardImpacts)).find((times) => times.length) || [];
    this.clock.hard = [...new Set(hits)].sort((a, b) => a - b);
    // The widest clearance of the shown runs sets the size of all pictures.
    this.pictures = !this.touches ? [] : scene.contacts.map((of, c) => {
      const contact = {...of, clearance: Math.max(...this.shownAt(c).map(({clearance}) => clearance))};
      return {sections: this.places.map(({feet}) => new Section(feet[c].section, contact, this.scales)),
        unrolled: new Unrolled(this.element.querySelectorAll('canvas.unrolled')[c], contact, this.shownAt(c))};
    });
    this.places.forEach(({place}, k) => { place.querySelector('.swatch').className = `swatch side-${this.shown[k].label}`; });
    this.note();
    this.draw();
  }

  // Makes the rig once; this.rig is null without WebGL.
  makeRig() {
    if (this.rig !== undefined) return;
    this.rig = Rig.available() ? new Rig(this.scene) : null;
    if (!this.rig) for (const canvas of this.element.querySelectorAll('canvas.rig')) canvas.remove();
    this.note();
    this.draw();
  }

  note() {
    const {force, impulse, control, current} = this.scales, {rig, contacts} = this.scene, words = [];
    if (this.rig === null) words.push('This browser has no WebGL: the rig itself is not shown.');
    const times = [...new Set(contacts.map((contact) => contact.section_magnification.toLocaleString('en')))].join(' and ');
    if (this.touches) words.push(`The cross-section moves with the ring. Displacements and clearance are magnified ${times} times; rotor and ring are not. ○ marks the keyphasor, once per turn.`);
    if (!rig.has_shape && this.rig !== null) words.push('The scene has modal data without a shaft geometry, so the shaft is drawn as a simple bow.');
    if (force > 0) words.push(`Arrows are cut at ${units.force(force)}${this.shown.length > 1 ? ' in both runs' : ''}; a double head marks a larger force.`);
    if (impulse > 0) words.push(`Longest impulse stem ${units.impulse(impulse)}.`);
    if (control > 0) words.push(`Longest control arrow ${units.force(control)}.`);
    if (current > 0) words.push(`Bars beside the ring: coil currents, full length ${units.current(current)}, positive outwards.`);
    words.push(...this.runs.concat(this.left).map((run) => run.absent).filter(Boolean));
    this.element.querySelector('.player-note').textContent = words.join(' ');
  }

  // s: the last turn of the rotor, as far as there is one.
  span(run, t) {
    const whole = this.clock.to - this.clock.from, speed = Math.abs(run.value('spin_speed', t) || 2 * Math.PI * this.scene.spin);
    return Math.min(0.25 * whole, speed > 0 ? 2 * Math.PI / speed : 0.05 * whole);
  }

  draw() {
    if (!this.visible || isPrinting()) return;  // paper has no player
    const t = this.looked ?? this.clock.t, outlined = this.transport.querySelector('.outline').checked && this.shown.length > 1;
    const spans = this.shown.map((run) => this.span(run, t));
    const poses = this.scene.contacts.map((_, c) => this.shownAt(c).map((run) => ({run, pose: run.pose(t)})));
    poses.forEach((shown, c) => {
      shown.forEach(({run, pose}, k) => { showReadings(this.places[k].feet[c], run, pose); });
      if (!this.touches) return;
      const {sections, unrolled} = this.pictures[c];
      sections.forEach((section, k) => { section.draw(shown[k].run, shown[k].pose, outlined ? shown[1 - k] : null, spans[k]); });
      unrolled.draw(shown.filter(({run, pose}) => pose.gap !== null && run.ringKnown && run.within(t)), spans[0]);
    });
    if (!this.clock.playing) this.describe();
    this.firstFlat = this.firstFlat || performance.now();
    this.showTime(t);
    // The flat pictures come first, because the rig needs a WebGL context and shaders.
    if (this.rig) {
      this.rigs = this.shown.map((run, k) => this.rig.draw(this.places[k].place.querySelector('canvas.rig'), run,
        poses.map((shown) => shown[k].pose), this.scales, spans[k]));
    }
    if (this.rig === undefined) setTimeout(() => this.makeRig());
    else this.firstDrawn = this.firstDrawn || performance.now();
  }

  // Shows the instant t, or the clock's time if t is null.
  look(t) {
    this.looked = t;
    this.draw();
    this.showTime(t ?? this.clock.t);
  }

  // Describes the pictures for screen readers.
  describe() {
    this.places.forEach(({place, feet}, k) => { feet.forEach(({section, list}, c) => {
      const readings = [...list.children].map((row) => [...row.children].map((e) => e.textContent).join(' ')).join('; ');
      const words = `${this.shown[k].label} at ${units.time(this.looked ?? this.clock.t)}: ${readings}`;
      const where = this.scene.contacts[c].name ? ` ${this.scene.contacts[c].name}` : '';
      const picture = this.touches ? section : place.querySelector('canvas.rig');
      if (picture) picture.setAttribute('aria-label', (this.touches ? `cross-section at the contact${where}, ` : 'the rig, ') + words);
    }); });
  }

  showTime(t) {
    const seek = this.transport.querySelector('.seek');
    seek.value = t;
    seek.setAttribute('aria-valuetext', units.time(t));
    this.transport.querySelector('.time').textContent = units.time(t);
  }

  showPlaying() {
    const play = this.transport.querySelector('.play'), {playing} = this.clock;
    play.textContent = playing ? '❚❚' : '▶';
    play.setAttribute('aria-pressed', String(playing));
    play.setAttribute('aria-label', playing ? 'pause' : 'play');
  }

  // A copy of what is shown, SI: poses, sections and the unrolled gap of the first contact; `others` has those of the further
  // contacts. first_flat, first_drawn: ms from the page's start until all but the rig was drawn, and until all was.
  state() {
    const {clock} = this;
    const [first, ...others] = this.scene.contacts.map(({name}, c) => ({name, poses: this.shownAt(c).map((run) => run.pose(clock.t)),
      sections: this.touches ? this.pictures[c].sections.map((s) => s.drawn) : [], unrolled: this.touches ? this.pictures[c].unrolled.drawn : null}));
    return JSON.parse(JSON.stringify({time: clock.t, from: clock.from, to: clock.to, playing: clock.playing,
      slowing: clock.slowing, pace: clock.pace, pace_here: clock.paceAt(clock.t), hard: clock.hard,
      runs: this.shown.map((run) => run.label), ...first, others, scales: this.scales, webgl: Boolean(this.rig), rigs: this.rigs,
      first_flat: this.firstFlat, first_drawn: this.firstDrawn}));
  }
}
