// The cross-section at the contact, on a canvas: circles with the clearance magnified, so that they touch when rotor
// and ring do; forces and impulses in the common scales of all runs; the orbit with trail and keyphasor.
import {css} from '../style.js';
import {circle, disc, fading, font, polygon, sector, sharp, stroke} from './canvas.js';
import {units} from './units.js';

const kMargin = 1.1;
const kRingWidth = 0.42;   // relative to the rotor's radius
const kForceReach = 0.85;  // length of the longest force arrow, relative to the rotor's radius
const kTrailPoints = 240;
const kLegend = 50;        // px, height of the legend below the picture

export class Section {
  // contact: of the scene. scales: of player.js, shared by all sections.
  constructor(canvas, contact, scales) {
    Object.assign(this, {canvas, contact, scales});
    this.drawn = {};
  }

  // Lengths in pixels. radius: of the rotor. magnified: pixels per metre of displacement.
  layout() {
    const {canvas, contact} = this;
    const ratio = contact.section_magnification / contact.radius;  // of the rotor's radius, a metre displaced
    const half = kMargin * (1 + ratio * contact.clearance + kRingWidth);
    const {ctx, width, height} = sharp(canvas);
    const middle = 0.5 * (height - kLegend), radius = Math.min(0.5 * width, middle) / half;
    return {ctx, width, height, middle, radius, magnified: ratio * radius};
  }

  draw(run, pose, other, span) {
    const l = this.layout(), {ctx} = l;
    l.bore = this.bore(l, run);
    this.drawn = {t: pose.t, touching: pose.mode !== null && pose.mode !== 'free', arrows: [], stems: 0, outline: Boolean(other)};
    if (!run.within(pose.t)) return;  // a record without samples here: nothing is known, nothing is drawn
    Object.assign(this.drawn, {rotor: true, ring: run.ringKnown});
    ctx.save();
    // y points upwards, as in the scene. The picture follows the ring; the axes show the ring's position at rest.
    ctx.translate(l.width / 2 - l.magnified * pose.ring[0], l.middle + l.magnified * pose.ring[1]);
    ctx.scale(1, -1);
    this.axes(l, pose);
    if (run.ringKnown) this.ring(l, pose);
    this.rotor(l, run, pose);
    if (other?.run.within(pose.t)) this.outline(l, other.run, other.pose);
    this.trail(l, run, pose.t, span);
    this.stems(l, run, pose, span);
    this.forces(l, pose);
    if (pose.current) this.currents(l, pose);
    this.axisNames(l, pose);
    ctx.restore();
    this.legend(l, run);
  }

  at(l, place) { return [l.magnified * place[0], l.magnified * place[1]]; }
  bore(l, {clearance}) { return l.radius + l.magnified * clearance; }

  axes(l, pose) {
    const [x, y] = this.at(l, pose.ring);
    stroke(l.ctx, [[x - l.width / 2, 0], [x + l.width / 2, 0]], css('--line'), 1);
    stroke(l.ctx, [[0, y - l.middle], [0, y + l.middle]], css('--line'), 1);
  }
  axisNames(l, pose) {
    const {ctx, width, middle} = l, [x, y] = this.at(l, pose.ring);
    const keep = (place, half) => Math.min(half - 14, Math.max(-half + 6, place));
    this.text(ctx, 'x', x + width / 2 - 12, y + keep(5 - y, middle));
    this.text(ctx, 'y', x + keep(6 - x, width / 2), y + middle - 12);
  }
  text(ctx, words, x, y, color = css('--soft')) {
    ctx.save();
    ctx.translate(x, y);
    ctx.scale(1, -1);
    ctx.fillStyle = color;
    ctx.font = font(12);
    ctx.fillText(words, 0, 0);
    ctx.restore();
  }

  ring(l, pose) {
    const {ctx} = l, place = this.at(l, pose.ring), bore = l.bore, outer = bore + kRingWidth * l.radius;
    sector(ctx, place, bore, outer, 0, Math.PI, css('--ring'));
    circle(ctx, place, bore, css('--ring-edge'), 1.5);
    circle(ctx, place, outer, css('--ring-edge'), 1);
    if (pose.ringSpin !== null) sector(ctx, place, bore + 0.1 * l.radius, outer - 0.1 * l.radius, pose.ringSpin, 0.09, css('--mark'));
  }

  rotor(l, run, pose) {
    const {ctx} = l, place = this.at(l, pose.rotor);
    disc(ctx, place, l.radius, css('--rotor'));
    circle(ctx, place, l.radius, css(`--${run.label}`), 2);
    if (pose.spin !== null) sector(ctx, place, 0.62 * l.radius, 0.96 * l.radius, pose.spin, 0.13, css('--mark'));
  }

  outline(l, run, pose) {
    const color = css(`--${run.label}`), [x, y] = this.at(l, pose.rotor);
    circle(l.ctx, [x, y], l.radius, color, 1.5, [7, 4]);
    if (run.has('ring')) circle(l.ctx, this.at(l, pose.ring), this.bore(l, run), color, 1, [2, 4]);
    l.ctx.fillStyle = color;
    l.ctx.fillRect(x - 3, y - 3, 6, 6);
  }

  trail(l, run, t, span) {
    // The trail is relative to the ring, which has moved meanwhile, so that the trail stays within the dashed circle.
    const {ctx} = l, points = run.trail(t, span, kTrailPoints), now = points[points.length - 1], color = css(`--${run.label}`);
    const inRing = (p) => this.at(l, [0, 1].map((c) => p.rotor[c] - p.ring[c] + now.ring[c]));
    // The circle that limits the rotor's centre.
    if (run.ringKnown) circle(ctx, this.at(l, now.ring), l.magnified * run.clearance, css('--soft'), 1, [4, 4]);
    fading(ctx, points.map(inRing), color, 2);
    const pulses = run.pulses(points[0].t, t);
    for (const pulse of pulses) circle(ctx, inRing(run.pose(pulse)), 4.5, css('--ink'), 1.5);
    disc(ctx, inRing(now), 4, color);
    Object.assign(this.drawn, {trail: points.length, pulses: pulses.length});
  }

  // Draws the impacts during the trail's time as fading stems from the bore outwards.
  stems(l, run, pose, span) {
    const {ctx} = l, bore = l.bore, [x, y] = this.at(l, pose.ring), color = css('--impact');
    for (const impact of run.impactsBetween(pose.t - span, pose.t)) {
      const share = Math.min(1, impact.normal / this.scales.impulse), way = [Math.cos(impact.angle), Math.sin(impact.angle)];
      const [from, to] = [bore, bore + share * kRingWidth * l.radius].map((reach) => [x + reach * way[0], y + reach * way[1]]);
      ctx.globalAlpha = 1 - 0.85 * (pose.t - impact.t) / span;
      stroke(ctx, [from, to], color, 3);
      if (impact.normal > this.scales.impulse * (1 + 1e-9)) this.clipped(ctx, to, way, color);
      ++this.drawn.stems;
    }
    ctx.globalAlpha = 1;
  }

  forces(l, pose) {
    const [x, y] = this.at(l, pose.ring), bore = l.bore;
    if (pose.control) this.arrow(l, 'control', [x, y], pose.control, this.scales.control, css('--control'));
    if (!this.drawn.touching) return;
    const touch = [x + bore * pose.e[0], y + bore * pose.e[1]], across = [-pose.e[1], pose.e[0]];
    this.arrow(l, 'normal', touch, pose.e.map((e) => -pose.normal * e), this.scales.force, css('--normal-force'));
    this.arrow(l, 'friction', touch, across.map((e) => pose.friction * e), this.scales.force, css('--friction-force'));
    disc(l.ctx, touch, 4.5, css('--normal-force'));
  }

  // Coil currents beside the ring, on the actuators' axes (1, 1) and (-1, 1): outwards positive.
  currents(l, pose) {
    const [x, y] = this.at(l, pose.ring), half = 0.16 * l.radius, middle = l.bore + (kRingWidth + 0.1) * l.radius + half;
    this.drawn.currents = pose.current.map((current, k) => {
      const c = (k === 0 ? 1 : -1) * Math.SQRT1_2, s = Math.SQRT1_2, reach = Math.sign(current) * half * Math.min(1, Math.abs(current) / this.scales.current);
      const piece = (from, to, width, color) => stroke(l.ctx, [[x + from * c, y + from * s], [x + to * c, y + to * s]], color, width);
      piece(middle - half, middle + half, 7, css('--hair'));
      piece(middle, middle + reach, 7, css('--control'));
      piece(middle - 1, middle + 1, 11, css('--soft'));
      return reach;
    });
  }

  // Draws a force as an arrow; a force beyond the scale has a double head.
  arrow(l, name, from, force, full, color) {
    const size = Math.hypot(force[0], force[1]), {ctx} = l;
    if (!(size > 0) || !(full > 0)) return;
    const reach = Math.min(1, size / full) * kForceReach * l.radius, clipped = size > full * (1 + 1e-9);
    this.drawn.arrows.push({name, newtons: size, pixels: reach, clipped});
    if (reach < 2) return;
    const [c, s] = [force[0] / size, force[1] / size], along = (way) => [from[0] + way * c, from[1] + way * s];
    stroke(ctx, [from, along(reach - Math.min(7, reach))], color, 3);
    this.head(ctx, along(reach), [c, s], Math.min(10, reach), color);
    if (clipped) this.clipped(ctx, along(reach), [c, s], color);
  }
  head(ctx, [x, y], [c, s], size, color) {
    polygon(ctx, [[x, y], [x - size * c + 0.5 * size * s, y - size * s - 0.5 * size * c], [x - size * c - 0.5 * size * s, y - size * s + 0.5 * size * c]], color);
  }
  clipped(ctx, [x, y], [c, s], color) { this.head(ctx, [x + 9 * c, y + 9 * s], [c, s], 10, color); }

  // The scale bars below the picture.
  legend(l, {clearance}) {
    const {ctx, height} = l, {force, impulse} = this.scales;
    const gap = l.magnified * clearance;
    const row = (k, pixels, color, words) => {
      const y = height - 10 - 15 * k;
      ctx.font = font(11);
      ctx.fillStyle = color;
      ctx.fillRect(8, y - 5, pixels, 3);
      ctx.fillStyle = css('--soft');
      ctx.fillText(words, 14 + pixels, y);
    };
    let k = 0;
    row(k++, gap, css('--soft'), `${units.length(clearance)} clearance`);
    if (force > 0) row(k++, 0.3 * kForceReach * l.radius, css('--normal-force'), `${units.force(0.3 * force)} force`);
    if (impulse > 0) row(k++, kRingWidth * l.radius, css('--impact'), `${units.impulse(impulse)} impact`);
  }
}
