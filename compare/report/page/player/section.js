// The cross-section at the contact, on a canvas: circles with the clearance magnified, so that they touch when rotor
// and ring do; forces and impulses to the scales that all runs share; orbit with trail and keyphasor.
'use strict';
page.Section = (() => {
  const kMargin = 1.1;
  const kRingWidth = 0.42;   // of the rotor's radius
  const kForceReach = 0.85;  // of the rotor's radius: an arrow of the scale's full force
  const kTrailPoints = 240;
  const kLegend = 50;        // px, below
  const {css} = page;

  class Section {
    // rig: of the scene. scales: of player.js, shared by all sections.
    constructor(canvas, rig, scales) {
      Object.assign(this, {canvas, rig, scales});
      this.drawn = {};
    }

    // Pixels: R rotor's radius; `magnified` of a metre of displacement.
    layout() {
      const {canvas, rig} = this;
      const ratio = rig.section_magnification / rig.radius;  // of the rotor's radius, a metre displaced
      const half = kMargin * (1 + ratio * rig.clearance + kRingWidth);
      const {ctx, width, height} = page.sharp(canvas);
      const middle = 0.5 * (height - kLegend), radius = Math.min(0.5 * width, middle) / half;
      return {ctx, width, height, middle, radius, magnified: ratio * radius};
    }

    draw(run, pose, other, span) {
      const l = this.layout(), {ctx} = l;
      this.drawn = {t: pose.t, touching: pose.mode !== null && pose.mode !== 'free', arrows: [], stems: 0, outline: Boolean(other)};
      if (!run.within(pose.t)) return;  // a record without samples here: nothing is known, nothing is drawn
      Object.assign(this.drawn, {rotor: true, ring: run.ringKnown});
      ctx.save();
      // y upwards, as in the scene; the picture goes with the ring, and the axes show where its place at rest is.
      ctx.translate(l.width / 2 - l.magnified * pose.ring[0], l.middle + l.magnified * pose.ring[1]);
      ctx.scale(1, -1);
      this.axes(l, pose);
      if (run.ringKnown) this.ring(l, pose);
      this.rotor(l, run, pose);
      if (other && other.run.within(pose.t)) this.outline(l, other.run, other.pose);
      this.trail(l, run, pose.t, span);
      this.stems(l, run, pose, span);
      this.forces(l, pose);
      if (pose.current) this.currents(l, pose);
      this.axisNames(l, pose);
      ctx.restore();
      this.legend(l);
    }

    at(l, place) { return [l.magnified * place[0], l.magnified * place[1]]; }
    circle(ctx, [x, y], radius, stroke, width, dash = []) {
      ctx.beginPath();
      ctx.arc(x, y, radius, 0, 2 * Math.PI);
      ctx.strokeStyle = stroke;
      ctx.lineWidth = width;
      ctx.setLineDash(dash);
      ctx.stroke();
      ctx.setLineDash([]);
    }

    axes(l, pose) {
      const {ctx, width, middle} = l, [x, y] = this.at(l, pose.ring);
      ctx.strokeStyle = css('--line');
      ctx.lineWidth = 1;
      ctx.beginPath();
      ctx.moveTo(x - width / 2, 0); ctx.lineTo(x + width / 2, 0);
      ctx.moveTo(0, y - middle); ctx.lineTo(0, y + middle);
      ctx.stroke();
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
      ctx.font = page.font(12);
      ctx.fillText(words, 0, 0);
      ctx.restore();
    }

    ring(l, pose) {
      const {ctx} = l, [x, y] = this.at(l, pose.ring);
      const bore = l.radius + l.magnified * this.rig.clearance, outer = bore + kRingWidth * l.radius;
      ctx.beginPath();
      ctx.arc(x, y, outer, 0, 2 * Math.PI);
      ctx.arc(x, y, bore, 0, 2 * Math.PI, true);
      ctx.fillStyle = css('--ring');
      ctx.fill();
      this.circle(ctx, [x, y], bore, css('--ring-edge'), 1.5);
      this.circle(ctx, [x, y], outer, css('--ring-edge'), 1);
      if (pose.ringSpin !== null) this.mark(ctx, [x, y], bore + 0.1 * l.radius, outer - 0.1 * l.radius, pose.ringSpin, 0.09);
    }
    mark(ctx, [x, y], inner, outer, angle, half) {
      ctx.beginPath();
      ctx.arc(x, y, outer, angle - half, angle + half);
      ctx.arc(x, y, inner, angle + half, angle - half, true);
      ctx.closePath();
      ctx.fillStyle = css('--mark');
      ctx.fill();
    }

    rotor(l, run, pose) {
      const {ctx} = l, place = this.at(l, pose.rotor);
      ctx.beginPath();
      ctx.arc(place[0], place[1], l.radius, 0, 2 * Math.PI);
      ctx.fillStyle = css('--rotor');
      ctx.fill();
      this.circle(ctx, place, l.radius, css('--' + run.label), 2);
      if (pose.spin !== null) this.mark(ctx, place, 0.62 * l.radius, 0.96 * l.radius, pose.spin, 0.13);
    }

    outline(l, run, pose) {
      const color = css('--' + run.label);
      this.circle(l.ctx, this.at(l, pose.rotor), l.radius, color, 1.5, [7, 4]);
      if (run.has('ring')) this.circle(l.ctx, this.at(l, pose.ring), l.radius + l.magnified * this.rig.clearance, color, 1, [2, 4]);
      const [x, y] = this.at(l, pose.rotor);
      l.ctx.fillStyle = color;
      l.ctx.fillRect(x - 3, y - 3, 6, 6);
    }

    trail(l, run, t, span) {
      // In the ring, and so within the dashed circle: the ring has moved meanwhile.
      const {ctx} = l, points = run.trail(t, span, kTrailPoints), now = points[points.length - 1];
      const inRing = (p) => this.at(l, [p.rotor[0] - p.ring[0] + now.ring[0], p.rotor[1] - p.ring[1] + now.ring[1]]);
      const places = points.map(inRing);
      // Where the rotor's centre may go.
      if (run.ringKnown) this.circle(ctx, this.at(l, now.ring), l.magnified * this.rig.clearance, css('--soft'), 1, [4, 4]);
      page.fading(ctx, places, css('--' + run.label), 2);
      const pulses = run.pulses(points[0].t, t);
      for (const pulse of pulses) this.circle(ctx, inRing(run.pose(pulse)), 4.5, css('--ink'), 1.5);
      ctx.beginPath();
      ctx.arc(...places[places.length - 1], 4, 0, 2 * Math.PI);
      ctx.fillStyle = css('--' + run.label);
      ctx.fill();
      Object.assign(this.drawn, {trail: points.length, pulses: pulses.length});
    }

    // Impacts of the trail's time: from the bore outwards, fading.
    stems(l, run, pose, span) {
      const {ctx} = l, bore = l.radius + l.magnified * this.rig.clearance, [x, y] = this.at(l, pose.ring);
      for (let k = run.impactsUntil(pose.t) - 1; k >= 0 && run.impacts[k].t > pose.t - span; --k) {
        const impact = run.impacts[k], share = Math.min(1, impact.normal / this.scales.impulse);
        const c = Math.cos(impact.angle), s = Math.sin(impact.angle), reach = bore + share * kRingWidth * l.radius;
        ctx.globalAlpha = 1 - 0.85 * (pose.t - impact.t) / span;
        ctx.strokeStyle = css('--impact');
        ctx.lineWidth = 3;
        ctx.beginPath();
        ctx.moveTo(x + bore * c, y + bore * s);
        ctx.lineTo(x + reach * c, y + reach * s);
        ctx.stroke();
        if (impact.normal > this.scales.impulse * (1 + 1e-9)) this.clipped(ctx, [x + reach * c, y + reach * s], [c, s], css('--impact'));
        ++this.drawn.stems;
      }
      ctx.globalAlpha = 1;
    }

    forces(l, pose) {
      const [x, y] = this.at(l, pose.ring), bore = l.radius + l.magnified * this.rig.clearance;
      if (pose.control) this.arrow(l, 'control', [x, y], pose.control, this.scales.control, css('--control'));
      if (!this.drawn.touching) return;
      const touch = [x + bore * pose.e[0], y + bore * pose.e[1]], across = [-pose.e[1], pose.e[0]];
      this.arrow(l, 'normal', touch, pose.e.map((e) => -pose.normal * e), this.scales.force, css('--normal-force'));
      this.arrow(l, 'friction', touch, across.map((e) => pose.friction * e), this.scales.force, css('--friction-force'));
      l.ctx.beginPath();
      l.ctx.arc(touch[0], touch[1], 4.5, 0, 2 * Math.PI);
      l.ctx.fillStyle = css('--normal-force');
      l.ctx.fill();
    }

    // Coil currents beside the ring, on the actuators' axes (1, 1) and (-1, 1): outwards positive.
    currents(l, pose) {
      const {ctx} = l, [x, y] = this.at(l, pose.ring), outer = l.radius + l.magnified * this.rig.clearance + kRingWidth * l.radius;
      const half = 0.16 * l.radius, middle = outer + 0.1 * l.radius + half;
      this.drawn.currents = pose.current.map((current, k) => {
        const c = (k === 0 ? 1 : -1) * Math.SQRT1_2, s = Math.SQRT1_2, reach = half * Math.min(1, Math.abs(current) / this.scales.current);
        const piece = (from, to, width, color) => {
          ctx.strokeStyle = color;
          ctx.lineWidth = width;
          ctx.beginPath();
          ctx.moveTo(x + from * c, y + from * s);
          ctx.lineTo(x + to * c, y + to * s);
          ctx.stroke();
        };
        piece(middle - half, middle + half, 7, css('--hair'));
        piece(middle, middle + Math.sign(current) * reach, 7, css('--control'));
        piece(middle - 1, middle + 1, 11, css('--soft'));
        return Math.sign(current) * reach;
      });
    }

    // A force from a place; one beyond the scale ends in a double head.
    arrow(l, name, from, force, full, color) {
      const size = Math.hypot(force[0], force[1]), {ctx} = l;
      if (!(size > 0) || !(full > 0)) return;
      const share = Math.min(1, size / full), reach = share * kForceReach * l.radius;
      this.drawn.arrows.push({name, newtons: size, pixels: reach, clipped: size > full * (1 + 1e-9)});
      if (reach < 2) return;
      const direction = [force[0] / size, force[1] / size];
      const head = [from[0] + reach * direction[0], from[1] + reach * direction[1]];
      ctx.strokeStyle = ctx.fillStyle = color;
      ctx.lineWidth = 3;
      ctx.beginPath();
      ctx.moveTo(...from);
      ctx.lineTo(head[0] - Math.min(7, reach) * direction[0], head[1] - Math.min(7, reach) * direction[1]);
      ctx.stroke();
      this.head(ctx, head, direction, Math.min(10, reach));
      if (size > full * (1 + 1e-9)) this.clipped(ctx, head, direction, color);
    }
    head(ctx, [x, y], [c, s], size) {
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.lineTo(x - size * c + 0.5 * size * s, y - size * s - 0.5 * size * c);
      ctx.lineTo(x - size * c - 0.5 * size * s, y - size * s + 0.5 * size * c);
      ctx.fill();
    }
    clipped(ctx, [x, y], [c, s], color) {
      ctx.fillStyle = color;
      this.head(ctx, [x + 9 * c, y + 9 * s], [c, s], 10);
    }

    // What a length of the picture stands for.
    legend(l) {
      const {ctx, height} = l, {force, impulse} = this.scales, {units} = page;
      const gap = l.magnified * this.rig.clearance;
      const row = (k, pixels, color, words) => {
        const y = height - 10 - 15 * k;
        ctx.font = page.font(11);
        ctx.fillStyle = color;
        ctx.fillRect(8, y - 5, pixels, 3);
        ctx.fillStyle = css('--soft');
        ctx.fillText(words, 14 + pixels, y);
      };
      let k = 0;
      row(k++, gap, css('--soft'), units.length(this.rig.clearance) + ' clearance');
      if (force > 0) row(k++, 0.3 * kForceReach * l.radius, css('--normal-force'), units.force(0.3 * force) + ' force');
      if (impulse > 0) row(k++, kRingWidth * l.radius, css('--impact'), units.impulse(impulse) + ' impact');
    }
  }
  return Section;
})();
