// The rig in WebGL (three.js): the bent shaft with all its modes, what sits on it, ring and actuators. One renderer draws
// every picture of the page off screen; each is copied to its own canvas. Axes: X along the shaft, Y = x, Z = y, up.
'use strict';
page.Rig = (() => {
  const {css} = page;
  const kSides = 20;           // of the shaft
  const kTrailPoints = 160;
  const kCut = [3.7, 7.9];     // rad: the part of a ring that is kept; what is cut away faces the camera
  const kView = {around: -0.45, above: 0.3};  // rad, of the camera
  let shared = null;           // {renderer, canvas}; false: there is no WebGL here

  function renderer() {
    if (shared !== null) return shared;
    shared = false;
    const canvas = document.createElement('canvas');
    // Asked for without three.js, which reports a failure as an error of the page.
    const context = canvas.getContext('webgl2', {antialias: true, alpha: true, preserveDrawingBuffer: true});
    if (context) {
      shared = new THREE.WebGLRenderer({canvas, context, antialias: true, alpha: true});
      shared.setClearColor(0, 0);
    }
    return shared;
  }

  class Rig {
    // values: of the scene's data. Only where available().
    constructor(values) {
      this.values = values;
      this.parts = page.rigParts(values, {sides: kSides, cut: kCut});
      this.scene = new THREE.Scene();
      this.camera = new THREE.PerspectiveCamera(26, 1, 0.1, 20);
      this.view = {...kView};
      this.scene.add(this.parts.group, new THREE.HemisphereLight(0xffffff, 0x8090a0, 0.55));
      const sun = new THREE.DirectionalLight(0xffffff, 0.5);
      sun.position.set(-0.5, -2, 3);
      this.scene.add(sun);
      this.trail = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
      this.trail.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * (kTrailPoints + 1)), 3));
      this.trail.frustumCulled = false;
      this.scene.add(this.trail);
      this.arrows = ['normal', 'friction'].map(() => {
        const arrow = new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 0.1, 0, 0.03, 0.02);
        this.scene.add(arrow);
        return arrow;
      });
    }
    static available() { return Boolean(renderer()); }

    // Drawing units of a displacement, m.
    displaced(metres) { return metres * this.values.unit * this.values.magnification; }

    // The shaft's centre line, magnified: [y, z] of every station.
    centreLine(run, pose) {
      const {z, modes_x: shapesX, modes_y: shapesY, bow} = this.values, scale = this.displaced(1);
      if (bow.length) return z.map((_, i) => [scale * bow[i] * pose.rotor[0], scale * bow[i] * pose.rotor[1]]);
      const x = run.bends.map((b) => b.at(pose.t, 0)), y = run.bends.map((b) => b.at(pose.t, 1));
      return z.map((_, i) => {
        let a = 0, b = 0;
        for (let k = 0; k < x.length; ++k) { a += shapesX[k][i] * x[k]; b += shapesY[k][i] * y[k]; }
        return [scale * a, scale * b];
      });
    }

    draw(canvas, run, pose, scales, span) {
      const {ctx, width, height} = page.sharp(canvas), gl = renderer();
      if (run.measured) return this.unseen(ctx, run, pose);
      const line = this.centreLine(run, pose);
      this.parts.pose(line, pose, this.displaced(1));
      this.parts.paint(css, run.label);
      this.drawTrail(run, pose.t, span);
      this.drawForces(pose, scales);
      gl.setPixelRatio(window.devicePixelRatio || 1);
      gl.setSize(width, height, false);
      this.aim(width / height);
      gl.render(this.scene, this.camera);
      ctx.drawImage(gl.domElement, 0, 0, width, height);
      ctx.font = page.font(12);
      ctx.fillStyle = css('--soft');
      ctx.fillText(`displacements × ${Number(this.values.magnification.toPrecision(3)).toLocaleString('en')}`, 8, height - 8);
      return {t: pose.t, stations: line.length, largest: line.reduce((most, p) => Math.max(most, Math.hypot(...p)), 0)};
    }

    // A record of one station: what the shaft does beside it is not known, and not drawn.
    unseen(ctx, run, pose) {
      ctx.font = page.font(12);
      ctx.fillStyle = css('--soft');
      ctx.fillText('measured at the contact alone: the shaft between is not known', 8, 20);
      return {t: pose.t, stations: 0, largest: 0};
    }

    aim(aspect) {
      const {around, above} = this.view, target = new THREE.Vector3(0.45, 0, -0.04);
      // As far as the whole length asks for, in narrow pictures farther.
      const far = Math.max(0.72 / aspect, 0.29) / Math.tan(0.5 * this.camera.fov * Math.PI / 180);
      const place = new THREE.Vector3(Math.sin(around) * Math.cos(above), -Math.cos(around) * Math.cos(above), Math.sin(above));
      this.camera.up.set(0, 0, 1);
      this.camera.position.copy(target).addScaledVector(place, far);
      this.camera.lookAt(target);
      this.camera.aspect = aspect;
      this.camera.updateProjectionMatrix();
    }

    drawTrail(run, t, span) {
      const {contact} = this.values;
      this.trail.visible = Boolean(contact);
      if (!contact) return;
      const places = this.trail.geometry.attributes.position, points = run.trail(t, span, kTrailPoints);
      points.forEach((p, k) => places.setXYZ(k, contact.z - 1.4 * contact.half_width, this.displaced(p.rotor[0]), this.displaced(p.rotor[1])));
      places.needsUpdate = true;
      this.trail.material.color.set(css('--' + run.label));
    }

    drawForces(pose, scales) {
      const {contact} = this.values, touching = contact && pose.mode !== null && pose.mode !== 'free' && scales.force > 0;
      const forces = touching ? [[pose.e.map((e) => -pose.normal * e), '--normal-force'],
        [[-pose.e[1] * pose.friction, pose.e[0] * pose.friction], '--friction-force']] : [];
      this.arrows.forEach((arrow, k) => {
        arrow.visible = Boolean(forces[k]) && Math.hypot(...forces[k][0]) > 0;
        if (!arrow.visible) return;
        const [[y, z], color] = forces[k], size = Math.hypot(y, z);
        const bore = contact.radius + this.displaced(this.values.clearance), reach = 3 * contact.radius * Math.min(1, size / scales.force);
        arrow.position.set(contact.z - 1.5 * contact.half_width, this.displaced(pose.ring[0]) + bore * pose.e[0], this.displaced(pose.ring[1]) + bore * pose.e[1]);
        arrow.setDirection(new THREE.Vector3(0, y / size, z / size));
        arrow.setLength(Math.max(reach, 1e-4), Math.min(0.03, 0.6 * reach), Math.min(0.02, 0.4 * reach));
        arrow.setColor(new THREE.Color(css(color)));
      });
    }

    turnBack() { this.view = {...kView}; }
    turn(right, up) {
      this.view.around += right;
      this.view.above = Math.min(1.5, Math.max(-1.5, this.view.above + up));
    }
  }
  return Rig;
})();
