// A scene of a page: its runs, its clock, and the plots and the player that follow it.
import {Clock} from './player/clock.js';
import {Player} from './player/player.js';
import {runOf} from './player/run.js';
import {ScenePlots} from './plots.js';

export class LiveScene {
  constructor(element, scene) {
    this.runs = scene.sides.map((side) => runOf(side, scene));
    const {from, to} = scene.windows[0];
    this.clock = new Clock(from, to, (t) => this.show(t), () => this.player?.showPlaying());
    this.plots = new ScenePlots(element, scene, this.runs, (t) => {
      this.clock.seek(t);
      if (this.player) this.player.element.focus({preventScroll: true});
    });
    this.player = null;
    const live = element.querySelector('.live'), moving = this.runs.filter((run) => run.has('rotor'));
    if (scene.rig && moving.length) this.player = new Player(live, scene, moving, this.clock, this.runs.filter((run) => !run.has('rotor')));
    else for (const part of live.querySelectorAll('.player, .transport')) part.remove();
    // The first touch is worth seeing first, and a little of what comes of it.
    const touch = this.clock.hard[0];
    this.clock.t = touch === undefined ? from : Math.min(to, touch + 0.25 * this.player.span(this.player.shown[0], touch));
  }
  // Draws the player, near the screen or not.
  begin() {
    if (!this.player) return;
    this.player.visible = true;
    this.player.draw();
  }
  show(t) {
    this.plots.cursor(t);
    if (!this.player) return;
    this.player.draw();
    this.player.showTime(t);
  }
  drawAll() {
    if (window.Plotly) this.plots.drawAll();
    this.show(this.clock.t);
  }
}
