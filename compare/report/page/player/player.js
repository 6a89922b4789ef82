// The live player of a scene: two runs of the reader's choice under the scene's clock, drawn by rig, section and
// unrolled gap to common scales. state() tells tests, and whoever scripts the page, what is shown.
'use strict';
page.Player = (() => {
  const {css, units} = page;
  const kPaces = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000];
  const kFilm = 25;  // s that a run takes at first

  class Player {
    // live: the element that holds player, transport and plots. runs: page.Run; left: those without a rotor to draw.
    constructor(live, scene, runs, clock, left = []) {
      this.element = live.querySelector('.player');
      this.transport = live.querySelector('.transport');
      Object.assign(this, {scene, runs, left, clock, visible: false, rig: undefined, rigs: []});
      const {rig} = scene;
      this.places = [...this.element.querySelectorAll('.player-run')];
      this.chosen = runs.length > 1 ? [0, 1] : [0];
      this.places.slice(this.chosen.length).forEach((place) => place.remove());
      this.places.length = this.chosen.length;
      this.element.classList.toggle('alone', this.chosen.length < 2);
      if (!rig.contact) this.element.querySelectorAll('.section, .unrolled-figure').forEach((e) => e.remove());
      this.readings = new page.Readings(this.places);
      this.listen();
      this.choose();
    }

    get shown() { return this.chosen.map((k) => this.runs[k]); }

    listen() {
      this.places.forEach((place, k) => {
        const select = place.querySelector('select');
        this.runs.forEach((run, r) => select.add(new Option(run.label, r, false, r === this.chosen[k])));
        select.addEventListener('change', () => { this.chosen[k] = Number(select.value); this.choose(); });
        const canvas = place.querySelector('canvas.rig');
        if (canvas) this.turnBy(canvas);
      });
      const on = (name, event, act) => this.transport.querySelector(name).addEventListener(event, act);
      on('.play', 'click', () => this.clock.play());
      on('.to-start', 'click', () => this.clock.seek(this.clock.from));
      on('.to-before', 'click', () => this.clock.toImpact(-1));
      on('.to-next', 'click', () => this.clock.toImpact(1));
      on('.seek', 'input', (event) => this.clock.seek(Number(event.target.value)));
      on('.slowing', 'change', (event) => { this.clock.slowing = event.target.checked; });
      on('.outline', 'change', () => this.draw());
      // Lists, boxes and buttons have keys of their own.
      const keys = (event) => {
        const {tagName, type} = event.target;
        if (tagName !== 'SELECT' && type !== 'checkbox' && !(tagName === 'BUTTON' && event.key === ' ')) this.clock.key(event);
      };
      this.element.addEventListener('keydown', keys);
      this.transport.addEventListener('keydown', keys);
      this.transport.querySelector('.outline-choice').hidden = this.chosen.length < 2 || !this.scene.rig.contact;
      Object.assign(this.transport.querySelector('.seek'), {min: this.clock.from, max: this.clock.to});
      const pace = this.transport.querySelector('.pace'), wanted = kFilm / (this.clock.to - this.clock.from);
      const first = kPaces.findIndex((p) => p >= wanted) === -1 ? kPaces.length - 1 : kPaces.findIndex((p) => p >= wanted);
      kPaces.forEach((p, k) => pace.add(new Option(p === 1 ? 'not' : '1 : ' + p.toLocaleString('en'), p, false, k === first)));
      pace.addEventListener('change', () => { this.clock.pace = 1 / Number(pace.value); });
      this.clock.pace = 1 / Number(pace.value);
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
      canvas.addEventListener('dblclick', () => { this.rig.turnBack(); this.draw(); });
    }

    // Other runs, other scales: forces and impulses in full are those of the first run that has any.
    choose() {
      const {rig} = this.scene, first = (values) => values.find((v) => v > 0) || 0;
      this.scales = {force: first(this.shown.map((run) => run.forces.usual)),
        impulse: first(this.shown.map((run) => run.largestImpulse)),
        control: Math.max(0, ...this.shown.map((run) => run.largest('control'))),
        current: Math.max(0, ...this.shown.map((run) => run.largest('current')))};
      this.clock.hard = [...new Set(this.shown.flatMap((run) => run.hardImpacts))].sort((a, b) => a - b);
      this.sections = rig.contact ? this.places.map((place) => new page.Section(place.querySelector('canvas.section'), rig, this.scales)) : [];
      this.unrolled = rig.contact ? new page.Unrolled(this.element.querySelector('canvas.unrolled'), rig, this.shown) : null;
      this.places.forEach((place, k) => { place.querySelector('.swatch').className = 'swatch side-' + this.shown[k].label; });
      this.element.querySelector('.player-note').textContent = this.note();
      this.draw();
    }

    // Null where there is no WebGL.
    makeRig() {
      if (this.rig !== undefined) return;
      this.rig = page.Rig.available() ? new page.Rig(this.scene.rig) : null;
      if (!this.rig) this.element.querySelectorAll('canvas.rig').forEach((canvas) => canvas.remove());
      this.element.querySelector('.player-note').textContent = this.note();
      this.draw();
    }

    note() {
      const {force, impulse, control, current} = this.scales, {rig} = this.scene, words = [];
      if (this.rig === null) words.push('This browser has no WebGL: the rig itself is not shown.');
      if (rig.contact) words.push(`Cross-section, which goes with the ring: displacements and clearance × ${rig.section_magnification.toLocaleString('en')}, bodies to scale with each other; ○ keyphasor, once a turn.`);
      if (!rig.has_shape && this.rig !== null) words.push('The scene gives modes, not a shaft: a plain bow stands for its shape.');
      if (force > 0) words.push(`Longest force arrow ${units.force(force)}${this.shown.length > 1 ? ' in both runs' : ''}; a double head: beyond it.`);
      if (impulse > 0) words.push(`Longest impulse stem ${units.impulse(impulse)}.`);
      if (control > 0) words.push(`Longest control arrow ${units.force(control)}.`);
      if (current > 0) words.push(`Bars beside the ring: coil currents, in full ${units.current(current)}, outwards positive.`);
      this.runs.concat(this.left).forEach((run) => { if (run.absent) words.push(run.absent); });
      return words.join(' ');
    }

    // s: the last turn of the rotor, as far as there is one.
    span(run, t) {
      const whole = this.clock.to - this.clock.from, speed = Math.abs(run.value('spin_speed', t) || 2 * Math.PI * this.scene.spin);
      return Math.min(0.25 * whole, speed > 0 ? 2 * Math.PI / speed : 0.05 * whole);
    }

    draw() {
      if (!this.visible && !page.printing) return;
      const {t} = this.clock, outlined = this.transport.querySelector('.outline').checked && this.shown.length > 1;
      const shown = this.shown.map((run) => ({run, pose: run.pose(t), span: this.span(run, t)}));
      this.sections.forEach((section, k) =>
        section.draw(shown[k].run, shown[k].pose, outlined ? shown[1 - k] : null, shown[k].span));
      if (this.unrolled) this.unrolled.draw(shown.filter(({run, pose}) => pose.gap !== null && run.ringKnown && run.within(t)), shown[0].span);
      this.readings.show(shown);
      if (!this.clock.playing) this.describe(shown);
      this.firstFlat = this.firstFlat || performance.now();
      this.showTime(t);
      // Flat pictures first: the rig asks for a WebGL context and its shaders.
      if (this.rig) {
        this.rigs = shown.map(({run, pose, span}, k) =>
          this.rig.draw(this.places[k].querySelector('canvas.rig'), run, pose, this.scales, span));
      }
      if (this.rig === undefined && page.printing) this.makeRig();
      else if (this.rig === undefined) setTimeout(() => this.makeRig());
      else this.firstDrawn = this.firstDrawn || performance.now();
    }

    // For who does not see the pictures.
    describe(shown) {
      shown.forEach(({run}, k) => {
        const list = [...this.places[k].querySelectorAll('.readings div')].map((row) => [...row.children].map((e) => e.textContent).join(' '));
        const words = `${run.label} at ${units.time(this.clock.t)}: ${list.join('; ')}`;
        const picture = this.places[k].querySelector('canvas.section') || this.places[k].querySelector('canvas.rig');
        if (picture) picture.setAttribute('aria-label', (picture.className === 'section' ? 'cross-section at the contact, ' : 'the rig, ') + words);
      });
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

    // What is shown, SI; a copy. first_flat, first_drawn: ms after the page's start, when all but the rig was drawn,
    // and when all of it was.
    state() {
      const {clock} = this, poses = this.shown.map((run) => run.pose(clock.t));
      return JSON.parse(JSON.stringify({time: clock.t, from: clock.from, to: clock.to, playing: clock.playing,
        slowing: clock.slowing, pace: clock.pace, pace_here: clock.paceAt(clock.t), hard: clock.hard,
        runs: this.shown.map((run) => run.label), poses, scales: this.scales, webgl: Boolean(this.rig), rigs: this.rigs,
        sections: this.sections.map((s) => s.drawn), unrolled: this.unrolled && this.unrolled.drawn, first_flat: this.firstFlat, first_drawn: this.firstDrawn}));
    }
  }
  return Player;
})();
