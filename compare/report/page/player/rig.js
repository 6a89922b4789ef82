// The rig in WebGL (three.js): the bent shaft with all its modes, what sits on it, ring and actuators. One renderer draws
// every picture of the page off screen; each is copied to its own canvas. Axes: X along the shaft, Y = x, Z = y, up.
import * as THREE from 'three';
import {css, number} from '../style.js';
import {font, sharp} from './canvas.js';
import {rigParts} from './rig_parts.js';

const kSides = 20;           // number of sides of the drawn shaft
const kTrailPoints = 160;
const kCut = [3.7, 7.9];     // rad: the part of a ring that is kept; what is cut away faces the camera
const kView = {around: -0.45, above: 0.3};  // rad, of the camera
let shared = null;           // {renderer, canvas}; false: there is no WebGL here

function renderer() {
  if (shared !== null) return shared;
  shared = false;
  const canvas = document.createElement('canvas');
  // The context is requested without three.js, which would report a failure as an error of the page.
  const context = canvas.getContext('webgl2', {antialias: true, alpha: true, preserveDrawingBuffer: true});
  if (context) {
    shared = new THREE.WebGLRenderer({canvas, context, antialias: true, alpha: true});
    shared.setClearColor(0, 0);
  }
  return shared;
}

export class Rig {
  // The argument is a scene's data. Call it only if available().
  constructor({rig: values, contacts}) {
    this.values = values;
    this.contacts = contacts.filter((contact) => contact.touches);
    this.parts = rigParts(values, this.contacts, {sides: kSides, cut: kCut});
    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(26, 1, 0.1, 20);
    this.view = {...kView};
    this.scene.add(this.parts.group, new THREE.HemisphereLight(0xffffff, 0x8090a0, 0.55));
    const sun = new THREE.DirectionalLight(0xffffff, 0.5);
    sun.position.set(-0.5, -2, 3);
    this.scene.add(sun);
    // Each contact has the rotor's trail and the arrows of normal and friction force.
    this.trails = this.contacts.map(() => {
      const trail = new THREE.Line(new THREE.BufferGeometry(), new THREE.LineBasicMaterial());
      trail.geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(3 * (kTrailPoints + 1)), 3));
      trail.frustumCulled = false;
      return trail;
    });
    this.arrows = this.contacts.map(() => [0, 1].map(() => new THREE.ArrowHelper(new THREE.Vector3(0, 0, 1), new THREE.Vector3(), 0.1, 0, 0.03, 0.02)));
    for (const mark of [...this.trails, ...this.arrows.flat()]) this.scene.add(mark);
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

  // poses: at each contact.
  draw(canvas, run, poses, scales, span) {
    const [pose] = poses;
    const {ctx, width, height} = sharp(canvas), gl = renderer();
    if (run.measured) return this.unseen(ctx, pose);
    const line = this.centreLine(run, pose);
    this.parts.pose(line, poses, this.displaced(1));
    this.parts.paint(css, run.label);
    this.contacts.forEach((contact, c) => {
      this.drawTrail(this.trails[c], contact, run.contacts[c], pose.t, span);
      this.drawForces(this.arrows[c], contact, poses[c], scales);
    });
    gl.setPixelRatio(window.devicePixelRatio || 1);
    gl.setSize(width, height, false);
    this.aim(width / height);
    gl.render(this.scene, this.camera);
    if (width > 0 && height > 0) ctx.drawImage(gl.domElement, 0, 0, width, height);
    ctx.font = font(12);
    ctx.fillStyle = css('--soft');
    ctx.fillText(`displacements × ${number(this.values.magnification, 3)}`, 8, height - 8);
    return {t: pose.t, stations: line.length, largest: line.reduce((most, p) => Math.max(most, Math.hypot(...p)), 0)};
  }

  // A measured record has one station; the rest of the shaft is unknown, so it is not drawn.
  unseen(ctx, pose) {
    ctx.font = font(12);
    ctx.fillStyle = css('--soft');
    ctx.fillText('measured at the contact alone: the shaft between is not known', 8, 20);
    return {t: pose.t, stations: 0, largest: 0};
  }

  aim(aspect) {
    const {around, above} = this.view, target = new THREE.Vector3(0.45, 0, -0.04);
    // The camera is so far away that the whole length is visible, farther in narrow pictures.
    const far = Math.max(0.72 / aspect, 0.29) / Math.tan(0.5 * this.camera.fov * Math.PI / 180);
    const place = new THREE.Vector3(Math.sin(around) * Math.cos(above), -Math.cos(around) * Math.cos(above), Math.sin(above));
    this.camera.up.set(0, 0, 1);
    this.camera.position.copy(target).addScaledVector(place, far);
    this.camera.lookAt(target);
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
  }

  drawTrail(trail, contact, run, t, span) {
    const places = trail.geometry.attributes.position, x = contact.z - 1.4 * contact.half_width;
    run.trail(t, span, kTrailPoints).forEach((p, k) => { places.setXYZ(k, x, this.displaced(p.rotor[0]), this.displaced(p.rotor[1])); });
    places.needsUpdate = true;
    trail.material.color.set(css(`--${run.label}`));
  }

  drawForces(arrows, contact, pose, scales) {
    const touching = pose.mode !== null && pose.mode !== 'free' && scales.force > 0;
    const forces = touching ? [[pose.e.map((e) => -pose.normal * e), '--normal-force'],
      [[-pose.e[1] * pose.friction, pose.e[0] * pose.friction], '--friction-force']] : [];
    arrows.forEach((arrow, k) => {
      arrow.visible = Boolean(forces[k]) && Math.hypot(...forces[k][0]) > 0;
      if (!arrow.visible) return;
      const [[y, z], color] = forces[k], size = Math.hypot(y, z);
      const bore = contact.drawn_radius + this.displaced(contact.clearance), reach = 3 * contact.drawn_radius * Math.min(1, size / scales.force);
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
