// The time that all pictures of a scene show. It can be set, stepped and played, and it slows down near impacts.
import {countUntil} from '../scales.js';

const kSlower = 10;             // factor of the slow motion at an impact
const kNear = 0.05, kFar = 0.2; // s of film at full pace: slowest within kNear of an impact, full pace beyond kFar

export class Clock {
  // from, to: s of the run. show(t) is called to draw; changed() is called when playing starts or stops.
  constructor(from, to, show, changed) {
    Object.assign(this, {from, to, show, changed});
    this.t = from;
    this.playing = false;
    this.slowing = true;
    this.pace = 1;  // s of the run in a second
    this.hard = []; // times to slow down at, ascending
  }

  seek(t) {
    this.t = Math.min(this.to, Math.max(this.from, t));
    this.show(this.t);
  }

  play(on = !this.playing) {
    if (on === this.playing) return;
    this.playing = on;
    if (on && this.t >= this.to) this.t = this.from;
    this.last = null;
    if (on) requestAnimationFrame((now) => this.frame(now));
    this.changed();
  }

  frame(now) {
    if (!this.playing) return;
    // A page in the background gets no frames, and the clock does not catch up afterwards.
    const passed = this.last === null ? 0 : Math.min(0.1, (now - this.last) / 1000);
    this.last = now;
    this.seek(this.t + passed * this.paceAt(this.t));
    if (this.t >= this.to) this.play(false);
    else requestAnimationFrame((next) => this.frame(next));
  }

  // s of the run per second at t.
  paceAt(t) {
    if (!this.slowing) return this.pace;
    const away = this.toNearestImpact(t) / this.pace;
    const share = Math.min(1, Math.max(0, (kFar - away) / (kFar - kNear)));
    return this.pace / kSlower ** share;
  }

  toNearestImpact(t) {
    const all = this.hard, low = countUntil(all, t);
    const after = low < all.length ? all[low] - t : Infinity;
    return Math.min(after, low > 0 ? t - all[low - 1] : Infinity);
  }

  // Goes to the next or the previous impact at which the clock slows down.
  toImpact(direction) {
    const tick = 1e-9 * (this.to - this.from);
    const next = direction > 0 ? this.hard.find((t) => t > this.t + tick) : this.hard.filter((t) => t < this.t - tick).pop();
    if (next !== undefined) this.seek(next);
  }

  // Keys as in any player: space, arrows (a frame; with shift ten), page keys (the impacts), home, end.
  key(event) {
    const frame = this.pace / 25 * (event.shiftKey ? 10 : 1);
    const acts = {' ': () => this.play(), ArrowLeft: () => this.seek(this.t - frame),
      ArrowRight: () => this.seek(this.t + frame), Home: () => this.seek(this.from), End: () => this.seek(this.to),
      PageUp: () => this.toImpact(-1), PageDown: () => this.toImpact(1)};
    if (!acts[event.key] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    acts[event.key]();
  }
}
