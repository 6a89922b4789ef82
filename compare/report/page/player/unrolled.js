// The gap unrolled: over the angle, how far the rotor's surface is from the ring's, in micrometres to millimetres on a
// logarithmic scale. Surfaces of two circles whose centres are delta apart towards psi: to first order in the clearance
//   gap(theta) = clearance - delta cos(theta - psi),
// least at psi, where it is the gap. Below the contact's line penetration, to the same scale.
'use strict';
page.Unrolled = (() => {
  const kTolerances = 10 / 3;  // of the gap's: less is drawn as contact; 0.1 um where the clearance is common
  const kRoom = 0.3;     // decades below the line without penetration: for the marks of impacts
  const kPoints = 361, kTrailPoints = 400;
  const {css} = page;

  class Unrolled {
    constructor(canvas, rig, runs) {
      Object.assign(this, {canvas, rig});
      this.finest = kTolerances * rig.gap_tolerance;  // m
      // Decades above the line, to twice the clearance, and below it, where a run penetrates.
      let deepest = 0;
      for (const run of runs) {
        const track = run.tracks.gap;
        if (track) track.unpack();
        if (track) track.values[0].forEach((gap) => { deepest = Math.max(deepest, -gap); });
      }
      this.above = Math.log10(2.2 * rig.clearance / this.finest);
      this.deep = deepest > this.finest;
      this.below = this.deep ? Math.min(Math.log10(deepest / this.finest) + 0.1, this.above) : kRoom;
      this.drawn = {};
    }

    layout() {
      const {ctx, width, height} = page.sharp(this.canvas);
      const left = 52, right = 10, top = 10, bottom = 30;
      const decade = (height - top - bottom) / (this.above + this.below);
      const line = top + this.above * decade;
      return {ctx, width, height, left, right, top, bottom, decade, line,
        x: (angle) => left + (width - left - right) * (angle / (2 * Math.PI) + 0.5),
        y: (gap) => line - Math.sign(gap) * decade * Math.max(0, Math.log10(Math.abs(gap) / this.finest) || 0)};
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
        const color = css('--' + run.label);
        this.surface(l, pose, color, k);
        this.trail(l, run, pose.t, span, color);
        this.impacts(l, run, pose.t, span, color);
      });
      shown.forEach(({run, pose}, k) => this.now(l, run, pose, css('--' + run.label), k));
      ctx.restore();
    }

    grid(l) {
      const {ctx} = l;
      ctx.font = page.font(11);
      ctx.lineWidth = 1;
      const row = (y, words, color) => {
        ctx.strokeStyle = color;
        ctx.beginPath();
        ctx.moveTo(l.left, y);
        ctx.lineTo(l.width - l.right, y);
        ctx.stroke();
        ctx.fillStyle = css('--soft');
        ctx.textAlign = 'right';
        ctx.fillText(words, l.left - 6, y + 4);
      };
      for (let d = 1; d <= this.above; ++d) row(l.line - d * l.decade, page.units.length(this.finest * 10 ** d), css('--hair'));
      for (let d = 1; this.deep && d <= this.below; ++d) row(l.line + d * l.decade, '−' + page.units.length(this.finest * 10 ** d), css('--hair'));
      if (this.deep) {
        ctx.fillStyle = css('--ring');
        ctx.globalAlpha = 0.5;
        ctx.fillRect(l.left, l.line, l.width - l.left - l.right, l.height - l.bottom - l.line);
        ctx.globalAlpha = 1;
      }
      row(l.y(this.rig.clearance), 'δ₀', css('--line'));
      row(l.line, 'contact', css('--ring-edge'));
      ctx.textAlign = 'center';
      for (let a = -180; a <= 180; a += 90) {
        const x = l.x(a * Math.PI / 180);
        ctx.strokeStyle = css('--hair');
        ctx.beginPath();
        ctx.moveTo(x, l.top);
        ctx.lineTo(x, l.height - l.bottom);
        ctx.stroke();
        ctx.fillStyle = css('--soft');
        ctx.fillText((a === 0 ? '0°: +x' : a === 90 ? '90°: +y' : a + '°').replace('-', '−'),
          Math.min(Math.max(x, l.left + 16), l.width - l.right - 16), l.height - 10);
      }
      ctx.textAlign = 'left';
    }

    surface(l, pose, color, k) {
      const {ctx} = l, delta = this.rig.clearance - pose.gap;
      ctx.strokeStyle = color;
      ctx.lineWidth = 1.2;
      ctx.globalAlpha = 0.75;
      ctx.setLineDash(k === 0 ? [] : [6, 4]);
      ctx.beginPath();
      for (let i = 0; i < kPoints; ++i) {
        const theta = -Math.PI + 2 * Math.PI * i / (kPoints - 1);
        ctx.lineTo(l.x(theta), l.y(this.rig.clearance - delta * Math.cos(theta - pose.angle)));
      }
      ctx.stroke();
      ctx.setLineDash([]);
      ctx.globalAlpha = 1;
    }

    // The way of the least gap, until now.
    trail(l, run, t, span, color) {
      // Every knot of the gap: a touch of a few microseconds is no more than one or two.
      const points = run.tracks.gap.instants(t - span, t, kTrailPoints).map((time) => run.pose(time));
      if (points.length < 2) return;
      // Not from one edge of the picture to the other, round the back.
      page.fading(l.ctx, points.map((p) => [l.x(p.angle), l.y(p.gap)]), color, 2.2,
        (k) => 1 - (t - points[k].t) / span, (k) => Math.abs(points[k].angle - points[k - 1].angle) < Math.PI);
    }

    impacts(l, run, t, span, color) {
      const {ctx} = l;
      for (let k = run.impactsUntil(t) - 1; k >= 0 && run.impacts[k].t > t - span; --k) {
        const impact = run.impacts[k], x = l.x(impact.angle);
        ctx.globalAlpha = 1 - 0.85 * (t - impact.t) / span;
        ctx.fillStyle = color;
        ctx.beginPath();
        ctx.moveTo(x, l.line);
        ctx.lineTo(x - 5, l.line + 8);
        ctx.lineTo(x + 5, l.line + 8);
        ctx.fill();
      }
      ctx.globalAlpha = 1;
    }

    // The first run a disc, the second a square.
    now(l, run, pose, color, k) {
      const {ctx} = l, x = l.x(pose.angle), y = l.y(pose.gap);
      ctx.fillStyle = color;
      ctx.strokeStyle = css('--paper');
      ctx.lineWidth = 1.5;
      ctx.beginPath();
      if (k === 0) ctx.arc(x, y, 6, 0, 2 * Math.PI); else ctx.rect(x - 5, y - 5, 10, 10);
      ctx.fill();
      ctx.stroke();
      const words = run.label + ' ' + page.units.gap(pose.gap, this.rig.gap_tolerance);
      ctx.font = page.font(12, 600);
      const wide = ctx.measureText(words).width;
      ctx.fillStyle = color;
      const beside = x + 12 + wide > l.width - l.right ? x - 12 - wide : x + 12;
      ctx.fillText(words, beside, Math.max(y - 6 - 14 * k, 24 - 12 * k));
      this.drawn.points.push({run: run.label, angle: pose.angle, gap: pose.gap, y});
      this.drawn.line = l.line;
    }
  }
  return Unrolled;
})();
