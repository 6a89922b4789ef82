// A scene of a page: its runs, its clock, and the plots and the player that follow it.
import {AddressWriter, stateIn} from './address.js';
import {Clock} from './player/clock.js';
import {Player} from './player/player.js';
import {runOf} from './player/run.js';
import {ScenePlots} from './plots.js';
import {WhatIf} from './what_if.js';

export class LiveScene {
  constructor(element, scene) {
    this.scene = scene;
    this.runs = scene.sides.map((side) => runOf(side, scene));
    const {from, to} = scene.windows[0];
    this.clock = new Clock(from, to, (t) => this.show(t), () => {
      this.player?.showPlaying();
      this.told();
    });
    const seek = (t, clicked = true) => {
      this.clock.seek(t);
      if (this.player && clicked) this.player.element.focus({preventScroll: true});
    };
    this.plots = new ScenePlots(element, scene, this.runs, {seek, look: (t) => this.look(t), changed: () => this.told()});
    this.address = new AddressWriter(element.id);
    this.player = null;
    const asked = element.querySelector('.what-if');
    if (asked) this.whatIf = new WhatIf(asked, {text: scene.text, ...scene.what_if}, (answer) => this.join(answer));
    const live = element.querySelector('.live'), moving = this.runs.filter((run) => run.has('rotor'));
    if (scene.rig && moving.length) this.player = new Player(live, scene, moving, this.clock, this.runs.filter((run) => !run.has('rotor')));
    else for (const part of live.querySelectorAll('.player, .transport')) part.remove();
    // The page starts shortly after the first touch.
    const touch = this.clock.hard[0];
    this.clock.t = touch === undefined ? from : Math.min(to, touch + 0.25 * this.player.span(this.player.shown[0], touch));
    const linked = stateIn(location.hash, element.id);
    if (!linked) return;
    this.plots.restore(linked);
    if (linked.t !== undefined) this.clock.t = Math.min(to, Math.max(from, linked.t));
    element.scrollIntoView();
  }
  // Shows a run that was computed in the page; it replaces the previous one. contacts: the data of each contact that differ
  // from the scene's.
  join({side, contacts}) {
    const {sides} = this.scene, at = sides.findIndex(({label}) => label === side.label), k = at < 0 ? sides.length : at;
    sides[k] = side;
    this.runs[k] = runOf(side, {contacts: this.scene.contacts.map((contact, c) => ({...contact, ...contacts[c]}))});
    this.plots.join(side.label);
    this.player?.join(this.runs[k]);
    this.drawAll();
  }
  // Call it when the reader has changed the time, the zoom or the shown runs. It does nothing until the page is drawn.
  told() {
    if (this.isDrawn) this.address.write({t: this.clock.t, range: this.plots.range, hidden: this.plots.hidden});
  }
  // Draws the player, even if it is not near the screen.
  begin() {
    if (!this.player) return;
    this.player.visible = true;
    this.player.draw();
  }
  show(t) {
    if (t !== this.shown && !this.clock.playing) this.told();
    this.shown = t;
    this.plots.cursor(t);
    this.player?.look(null);
  }
  // t: the instant under the pointer, or null when the pointer leaves. All plots mark it, and the player shows it unless it is
  // playing.
  look(t) {
    if (t === this.plots.looked || this.clock.playing) return;
    this.plots.cursor(this.clock.t, t);
    this.player?.look(t);
  }
  drawAll() {
    if (window.Plotly) this.plots.drawAll();
    this.player?.note();
    this.show(this.clock.t);
    this.isDrawn = true;
  }
}
