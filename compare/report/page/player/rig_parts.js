// The bodies of the rig, each as the scene gives it, and how they follow the poses at its contacts.
import * as THREE from 'three';

// values, contacts: of the scene's data.
export function rigParts(values, contacts, {sides, cut}) {
  const group = new THREE.Group(), painted = [], followers = [];
  const {unit, z: stations, span_radius: radii} = values;
  const bores = contacts.map((contact) => contact.drawn_radius + contact.clearance * unit * values.magnification);

  function body(geometry, color) {
    const material = new THREE.MeshLambertMaterial({side: THREE.DoubleSide});
    painted.push({material, color});
    return new THREE.Mesh(geometry, material);
  }
  // A cylinder, or part of one, whose axis is X.
  const solid = (radius, half, from = 0, wide = 2 * Math.PI) =>
    new THREE.CylinderGeometry(radius, radius, 2 * half, 48, 1, false, from, wide).rotateZ(Math.PI / 2);
  // A ring about X from inner to outer radius, or a part of one; angles from +Y towards +Z.
  function annulus(inner, outer, half, [from, to] = [0, 2 * Math.PI]) {
    const points = [], normals = [], faces = [], steps = Math.ceil(10 * (to - from));
    // A strip between two edges [X, radius] round the ring, with normals (X, radial).
    const strip = (a, b, along, out) => {
      for (let k = 0; k <= steps; ++k) {
        const angle = from + (to - from) * k / steps, c = Math.cos(angle), s = Math.sin(angle), at = points.length / 3;
        points.push(a[0], a[1] * c, a[1] * s, b[0], b[1] * c, b[1] * s);
        normals.push(along, out * c, out * s, along, out * c, out * s);
        if (k < steps) faces.push(at, at + 1, at + 2, at + 1, at + 3, at + 2);
      }
    };
    strip([-half, outer], [half, outer], 0, 1);
    strip([-half, inner], [half, inner], 0, -1);
    strip([half, inner], [half, outer], 1, 0);
    strip([-half, inner], [-half, outer], -1, 0);
    if (to - from < 6.28) {
      for (const [angle, side] of [[from, -1], [to, 1]]) {
        const c = Math.cos(angle), s = Math.sin(angle), at = points.length / 3;
        for (const [x, r] of [[-half, inner], [half, inner], [-half, outer], [half, outer]]) {
          points.push(x, r * c, r * s);
          normals.push(0, -side * s, side * c);
        }
        faces.push(at, at + 1, at + 2, at + 1, at + 3, at + 2);
      }
    }
    const geometry = new THREE.BufferGeometry();
    geometry.setIndex(faces);
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(points), 3));
    geometry.setAttribute('normal', new THREE.BufferAttribute(new Float32Array(normals), 3));
    return geometry;
  }

  // [y, z] of the centre line at a station, and its slopes there.
  function lineAt(line, station) {
    let k = 1;
    while (k + 1 < stations.length && stations[k] < station) ++k;
    const h = stations[k] - stations[k - 1], s = (station - stations[k - 1]) / h;
    return {place: [0, 1].map((c) => (1 - s) * line[k - 1][c] + s * line[k][c]),
      slope: [0, 1].map((c) => (line[k][c] - line[k - 1][c]) / h)};
  }

  // -------------------------------------------------- the shaft: two circles of points a span, for steps of diameter
  const circles = 2 * radii.length, shaft = new THREE.BufferGeometry();
  const places = new Float32Array(3 * circles * sides), normals = new Float32Array(places.length), faces = [];
  for (let span = 0; span < radii.length; ++span) {
    for (let i = 0; i < sides; ++i) {
      const a = 2 * span * sides + i, b = 2 * span * sides + (i + 1) % sides;
      faces.push(a, b, a + sides, b, b + sides, a + sides);
    }
  }
  shaft.setIndex(faces);
  shaft.setAttribute('position', new THREE.BufferAttribute(places, 3));
  shaft.setAttribute('normal', new THREE.BufferAttribute(normals, 3));
  const shaftBody = body(shaft, '--shaft');
  shaftBody.frustumCulled = false;
  group.add(shaftBody);
  followers.push((line) => {
    for (let circle = 0; circle < circles; ++circle) {
      const station = (circle + 1) >> 1, r = radii[circle >> 1], [y, z] = line[station];
      for (let i = 0; i < sides; ++i) {
        const angle = 2 * Math.PI * i / sides, c = Math.cos(angle), s = Math.sin(angle), at = 3 * (circle * sides + i);
        places[at] = stations[station]; places[at + 1] = y + r * c; places[at + 2] = z + r * s;
        normals[at] = 0; normals[at + 1] = c; normals[at + 2] = s;
      }
    }
    shaft.attributes.position.needsUpdate = shaft.attributes.normal.needsUpdate = true;
  });

  // -------------------------------------------------- bodies on the shaft: they move, tilt and turn with it
  function onShaft(station, radius, half, color) {
    const turning = new THREE.Group();
    turning.add(body(solid(radius, half), color));
    // The mark that turns: a sector on the faces and the rim, at +x for a spin angle of 0.
    turning.add(body(annulus(0.45 * radius, 1.01 * radius, 1.02 * half, [-0.16, 0.16]), '--mark'));
    group.add(turning);
    const axis = new THREE.Vector3(), x = new THREE.Vector3(1, 0, 0), tilt = new THREE.Quaternion(), spin = new THREE.Quaternion();
    followers.push((line, [pose]) => {
      const {place, slope} = lineAt(line, station);
      turning.position.set(station, place[0], place[1]);
      tilt.setFromUnitVectors(x, axis.set(1, slope[0], slope[1]).normalize());
      turning.quaternion.copy(tilt).multiply(spin.setFromAxisAngle(x, pose.spin));
    });
  }
  values.discs.forEach((disc) => {
    // A disc at the contact's station is the body that touches, drawn as that.
    if (contacts.some((contact) => Math.abs(disc.z - contact.z) < 1e-3 && disc.radius < 1.2 * contact.drawn_radius)) return;
    onShaft(disc.z, disc.radius, disc.half_width, '--disc');
  });
  for (const contact of contacts) onShaft(contact.z, contact.drawn_radius, 1.25 * contact.half_width, '--rotor-body');

  // -------------------------------------------------- supports
  const floor = Math.min(-0.16, ...values.discs.map((d) => -d.radius - 0.03), ...contacts.map(({drawn_radius: radius}, c) => -bores[c] - 0.5 * radius - 0.05), 0);
  values.bearings.forEach((station) => {
    const bore = 1.08 * Math.max(...radii);
    const ring = body(annulus(bore, 2.3 * bore, 0.016), '--housing');
    ring.position.x = station;
    const foot = body(new THREE.BoxGeometry(0.03, 0.03, -floor - 2.2 * bore), '--housing');
    foot.position.set(station, 0, 0.5 * (floor - 2.2 * bore));
    group.add(ring, foot);
  });
  if (values.bearings.length) {
    const plate = body(new THREE.BoxGeometry(1.06, 0.24, 0.012), '--plate');
    plate.position.set(0.5, 0, floor - 0.006);
    group.add(plate);
  }
  if (values.motor !== null) {
    const motor = body(solid(0.05, 0.05), '--motor');
    motor.position.x = values.motor < 0.5 ? values.motor - 0.06 : values.motor + 0.06;
    group.add(motor);
  }
  for (const m of values.magnetic_bearings) {
    const magnet = body(annulus(m.bore, m.outer, m.half_width, cut), '--copper');
    magnet.position.x = m.z;
    group.add(magnet);
  }

  // -------------------------------------------------- each ring, and the two axes that its actuators push along
  contacts.forEach((contact, c) => {
    const bore = bores[c], outer = bore + 0.45 * contact.drawn_radius;
    const ring = new THREE.Group();
    ring.add(body(annulus(bore, outer, contact.half_width, cut), '--ring-body'));
    const mark = contact.ring_turns ? body(annulus(bore, 1.01 * outer, 1.03 * contact.half_width, [-0.1, 0.1]), '--mark') : null;
    if (mark) ring.add(mark);
    const push = !contact.actuators ? [] : [1.25 * Math.PI, 1.75 * Math.PI].map((angle) =>
      ({angle, rod: body(new THREE.CylinderGeometry(0.006, 0.006, 0.07, 12).rotateX(angle), '--copper')}));
    group.add(ring, ...push.map(({rod}) => rod));
    followers.push((_line, poses, scale) => {
      const [y, z] = poses[c].ring.map((place) => scale * place);
      ring.position.set(contact.z, y, z);
      if (mark) mark.rotation.x = poses[c].ringSpin || 0;
      for (const {rod, angle} of push) rod.position.set(contact.z, (outer + 0.035) * Math.cos(angle) + y, (outer + 0.035) * Math.sin(angle) + z);
    });
  });

  return {
    group,
    pose: (line, poses, scale) => { for (const follow of followers) follow(line, poses, scale); },
    paint: (css) => { for (const {material, color} of painted) material.color.set(css(color)); },
  };
}
