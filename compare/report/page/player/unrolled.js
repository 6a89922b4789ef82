// The unrolled gap: the distance between the surfaces of rotor and ring over the angle, on a logarithmic scale from micrometres
// to millimetres. For two circles whose centres are delta apart in the direction psi it is, to first order in the clearance,
//   gap(theta) = clearance - delta cos(theta - psi).
// It is smallest at psi, where it equals the gap. Penetration is below the contact's line, in the same scale.
import {css} from '../style.js';
import {fading, font, polygon, sharp, stroke} from './canvas.js';
import {units} from './units.js';

const kTolerances = 10 / 3;  // times the gap's tolerance (0.1 um for a usual clearance): a smaller gap is drawn as contact
const kRoom = 0.3;     // decades below the line without penetration, for the marks of impacts
const kPoints = 361, kTrailPoints = 400;

// The scale of gaps, in decades from the line of contact: up to twice the clearance, and below the line if a run penetrates.
export function unrolledScale({clearance, gap_tolerance: tolerance}, deepest) {
  const finest = kTolerances * tolerance, deep = deepest > finest;
  const above = Math.log10(2.2 * clearance / finest);
  const below = deep ? Math.min(Math.log10(deepest / finest) + 0.1, above) : kRoom;
  return {finest, deep, above, below, decades: (gap) => Math.sign(gap) * Math.max(0, Math.log10(Math.abs(gap) / finest) || 0)};
}
// The gap between the surfaces at the angle theta; the least gap is at pose.angle.
export const gapAt = (clearance, pose, theta) => clearance - (clearance - pose.gap) * Math.cos(theta - pose.angle);

export class Unrolled {
  constructor(canvas, contact, runs) {
    Object.assign(this, {canvas, contact});
    const deepest = Math.max(0, ...runs.map((run) => run.deepest));
    Object.assign(this, unrolledScale(contact, deepest));
    this.drawn = {};
  }

  layout() {
    const {ctx, width, height} = sharp(this.canvas), letters = units.length(10 * this.finest).length;
    const left = Math.max(52, 14 + 6.4 * letters), right = 10, top = 10, bottom = 30;
    const decade = (height - top - bottom) / (this.above + this.below);
    const line = top + this.above * decade;
    return {ctx, width, height, left, right, top, bottom, decade, line,
      x: (angle) => left + (width - left - right) * (angle / (2 * Math.PI) + 0.5),
      y: (gap) => line - decade * this.decades(gap)};
  }

  // shown: [{run, pose}], the last in front.
  draw(shown, span) {
    const l = this.layout();
    this.drawn = {t: shown.length ? shown[0].pose.t : null, points: []};
    this.grid(l);
    const {ctx} = l;
    ctx.save();
    ctx.beginPath();
    ctx.rect(l.left, 0, l.width - l.left - l.right, l.height - l.bottom + 6);
    ctx.clip();
    shown.forEach(({run, pose}, k) => {
      const color = css(`--${run.label}`);
      this.surface(l, run, pose, color, k);
      this.trail(l, run, pose.t, span, color);
      this.impacts(l, run, pose.t, span, color);
    });
    shown.forEach(({run, pose}, k) => { this.now(l, run, pose, css(`--${run.label}`), k); });
    ctx.restore();
  }

  grid(l) {
    const {ctx} = l, {length} = units, wide = [l.left, l.width - l.right];
    ctx.font = font(11);
    const row = (y, words, color) => {
      stroke(ctx, wide.map((x) => [x, y]), color, 1);
      ctx.fillStyle = css('--soft');
      ctx.textAlign = 'right';
      ctx.fillText(words, l.left - 6, y + 4);
    };
    for (let d = 1; d <= this.above; ++d) row(l.line - d * l.decade, length(this.finest * 10 ** d), css('--hair'));
    for (let d = 1; this.deep && d <= this.below; ++d) row(l.line + d * l.decade, `−${length(this.finest * 10 ** d)}`, css('--hair'));
    if (this.deep) {
      ctx.fillStyle = css('--ring');
      ctx.globalAlpha = 0.5;
      ctx.fillRect(l.left, l.line, l.width - l.left - l.right, l.height - l.bottom - l.line);
      ctx.globalAlpha = 1;
    }
    row(l.y(this.contact.clearance), 'δ₀', css('--line'));
    row(l.line, 'contact', css('--ring-edge'));
    ctx.textAlign = 'center';
    for (let a = -180; a <= 180; a += 90) {
      const x = l.x(a * Math.PI / 180);
      stroke(ctx, [[x, l.top], [x, l.height - l.bottom]], css('--hair'), 1);
      ctx.fillStyle = css('--soft');
      ctx.fillText((a === 0 ? '0°: +x' : a === 90 ? '90°: +y' : `${a}°`).replace('-', '−'),
        Math.min(Math.max(x, l.left + 16), l.width - l.right - 16), l.height - 10);
    }
    ctx.textAlign = 'left';
  }

  surface(l, run, pose, color, k) {
    const angles = Array.from({length: kPoints}, (_, i) => -Math.PI + 2 * Math.PI * i / (kPoints - 1));
    l.ctx.globalAlpha = 0.75;
    stroke(l.ctx, angles.map((theta) => [l.x(theta), l.y(gapAt(run.clearance, pose, theta))]), color, 1.2, k === 0 ? [] : [6, 4]);
    l.ctx.globalAlpha = 1;
  }

  // Draws the path of the least gap up to now.
  trail(l, run, t, span, color) {
    // Uses every knot of the gap, because a touch of a few microseconds has only one or two.
    const points = run.tracks.gap.instants(t - span, t, kTrailPoints).map((time) => run.pose(time));
    if (points.length < 2) return;
    // No line connects the two edges of the picture where the angle wraps around.
    fading(l.ctx, points.map((p) => [l.x(p.angle), l.y(p.gap)]), color, 2.2,
      (k) => 1 - (t - points[k].t) / span, (k) => Math.abs(points[k].angle - points[k - 1].angle) < Math.PI);
  }

  impacts(l, run, t, span, color) {
    for (const impact of run.impactsBetween(t - span, t)) {
      const x = l.x(impact.angle);
      l.ctx.globalAlpha = 1 - 0.85 * (t - impact.t) / span;
      polygon(l.ctx, [[x, l.line], [x - 5, l.line + 8], [x + 5, l.line + 8]], color);
    }
    l.ctx.globalAlpha = 1;
  }

  // Marks the present position: a disc for the first run, a square for the second.
  now(l, run, pose, color, k) {
    const {ctx} = l, x = l.x(pose.angle), y = l.y(pose.gap);
    ctx.fillStyle = color;
    ctx.strokeStyle = css('--paper');
    ctx.lineWidth = 1.5;
    ctx.beginPath();
    if (k === 0) ctx.arc(x, y, 6, 0, 2 * Math.PI); else ctx.rect(x - 5, y - 5, 10, 10);
    ctx.fill();
    ctx.stroke();
    const words = `${run.label} ${units.gap(pose.gap, this.contact.gap_tolerance)}`;
    ctx.font = font(12, 600);
    const wide = ctx.measureText(words).width;
    ctx.fillStyle = color;
    ctx.fillText(words, x + 12 + wide > l.width - l.right ? x - 12 - wide : x + 12, Math.max(y - 6 - 14 * k, 24 - 12 * k));
    this.drawn.points.push({run: run.label, angle: pose.angle, gap: pose.gap, y});
    this.drawn.line = l.line;
  }
}
