// The plots of a scene's runs, one row each. `over`: the abscissa, which selects how traces.js draws a plot. "time": a
// series; "impacts" and "law": one point per impact, over time or on a law; "path": on the characteristic of what drives the
// run; "turns": positions over the last turns; "whirl" and "spread": independent of the time window; "runup": over the spin
// speed. `has`: whether there is data for it, of a view {scene, runs, contact, impacts and track of a run} of one
// contact. A plot stands once, or, with `each`, once for each contact. A new plot is a line here, and
// a function in a module of its own and a line in traces.js if no other of its kind draws it.
const always = () => true;
const touches = ({contact}) => contact.touches;
// A track of two knots is a constant, and a few points do not show a law, so such a plot is left out.
const kFew = 3;
const moves = (name) => ({runs, track}) => runs.some((run) => track(run, name)?.knots >= kFew);
const touchesAnd = (has) => (view) => view.contact.touches && has(view);
const strikes = ({contact, runs, impacts}) => contact.touches && runs.some((run) => impacts(run).t.length >= kFew);
const rubs = (view) => view.contact.rubs && strikes(view);
const hasWhirl = (name) => ({runs}) => runs.some(({whirl}) => whirl[name]);
const drivenByMotor = (view) => Boolean(view.scene.motor) && moves('motor_torque')(view);
const measured = (name) => ({scene}) => scene.sides.some((side) => side.measured && side.tracks[name]);

const kinds = [
  {key: 'gap', title: 'Gap', unit: 'µm', text: '0: contact; below 0: penetration', shape: 'wide', over: 'time', each: true, has: touchesAnd(moves('gap'))},
  {key: 'gap_rate', title: 'Gap rate', unit: 'mm/s', text: 'negative while the gap closes', figure: 8, over: 'time', each: true, has: touchesAnd(moves('gap_rate'))},
  {key: 'rotor_x', title: 'Rotor', unit: 'µm', text: 'along x', figure: 9, controlled: '; dotted: without control', over: 'time', each: true, has: moves('rotor')},
  {key: 'normal_force', title: 'Normal force', unit: 'N', text: 'of lasting contact; impulses of the rigid law\'s impacts are below', over: 'time', each: true, has: touchesAnd(moves('normal'))},
  {key: 'sample_force', title: 'Force of a sample', unit: 'N', shape: 'wide', over: 'time', has: moves('force'),
    text: 'the signal of a force sensor: the force of each run, impacts included, averaged over the samples of the record'},
  {key: 'control', title: 'Control force', unit: 'N', text: 'magnitude of the actuators\' force on the ring', over: 'time', each: true, has: moves('control')},
  {key: 'impacts', title: 'Impacts', unit: 'mN s', text: 'normal impulse of each impact or contact episode', over: 'impacts', each: true, has: strikes},
  {key: 'friction_force', title: 'Friction force', unit: 'N', text: 'on the rotor, along the ring', over: 'time', each: true, has: touchesAnd(moves('friction'))},
  {key: 'friction_impacts', title: 'Friction of impacts', unit: 'mN s', text: 'magnitude of the tangential impulse of each impact', over: 'impacts', each: true, has: rubs},
  {key: 'normal_law', title: 'Normal contact law', unit: 'm/s', shape: 'square', over: 'law', each: true, has: strikes,
    text: 'gap rates before and after each impact; dashed: restitution without the influence of friction'},
  {key: 'friction_law', title: 'Friction law', shape: 'square', over: 'law', each: true, has: rubs,
    text: 'tangential impulse / (friction × normal impulse) of each impact; dashed: Coulomb\'s law', figure: 5},
  {key: 'spin', title: 'Spin speed', unit: 'rpm', text: 'speed of the rotor, which friction in the contact can slow', over: 'time', has: moves('spin_speed')},
  {key: 'ring_speed', title: 'Ring speed', unit: 'rpm', text: 'speed at which friction and drag turn the ring', over: 'time', each: true, has: moves('ring_speed')},
  {key: 'torsion', title: 'Torsion', unit: 'mrad', text: 'twist of the shaft at the contact', over: 'time', has: moves('torsion')},
  {key: 'current', title: 'Coil current', unit: 'A', text: 'magnitude of the control currents of the two axes', over: 'time', each: true, has: moves('current')},
  {key: 'actuator', title: 'Actuator', unit: 'N', shape: 'square', over: 'path', each: true, has: moves('current'),
    text: 'force of axis 1 over its current, on the characteristic F(s, i)', figure: 3},
  {key: 'motor', title: 'Motor', unit: 'N m', shape: 'square', over: 'path', has: drivenByMotor,
    text: 'torque over speed; dashed: the motor\'s characteristic', figure: 6},
  {key: 'force_spread', title: 'Histogram of the force', unit: '% of the time', over: 'spread', each: true, has: touchesAnd(moves('normal')),
    text: 'distribution of the normal force over time; a steady rub gives a peak, bouncing a broad tail'},
  {key: 'impulse_spread', title: 'Exceedance of impulses', over: 'spread', each: true, has: strikes,
    text: 'number of impacts that reach an impulse; a long tail means that a few hard impacts dominate'},
  {key: 'orbit', title: 'Orbits', unit: 'µm', shape: 'square', over: 'turns', each: true, has: always,
    text: 'rotor solid, ring dotted, over the last turns or the time zoomed to. Diamonds: the rotor\'s mark passes +x; a single diamond ' +
      'means whirl at 1×. Arrows: direction of the whirl'},
  {key: 'relative', title: 'Rotor in the ring', unit: 'µm', shape: 'square', over: 'turns', each: true, has: touches,
    text: 'relative to the ring\'s centre; dashed: the clearance'},
  {key: 'measured_minus', title: 'Measured minus run', unit: 'µm', shape: 'wide', over: 'time', has: measured('rotor'),
    text: 'along x, at the samples of the record; a constant difference comes from a sensor\'s offset, a wave from an error in amplitude or phase'},
  {key: 'residual', title: 'Away from the first run', unit: 'µm', over: 'time', has: ({runs}) => runs.length > 1,
    text: 'distance of the rotor from its place in the first run; in chaotic motion it grows to the size of the orbit'},
  {key: 'spectrum', title: 'Full spectrum', unit: 'µm', over: 'whirl', has: hasWhirl('spectrum'),
    text: 'second half of the run: forward whirl above 0 Hz, backward whirl below; dashed: spin speed'},
  {key: 'waterfall', title: 'Waterfall', unit: 'µm', over: 'whirl', has: hasWhirl('waterfall'),
    text: 'full spectrum over the time, for the first run shown'},
  {key: 'cascade', title: 'Cascade', unit: 'µm', shape: 'wide tall', over: 'runup', has: hasWhirl('cascade'),
    text: 'full spectra over the changing speed, for the first run shown: forward whirl right, backward whirl left. A ridge along 1× or 2× ' +
      'follows the spin; a vertical ridge is a natural frequency'},
  {key: 'orders', title: '1× and 2× over the speed', unit: 'µm', shape: 'wide tall', over: 'runup', has: hasWhirl('orders'),
    text: 'amplitude, and phase relative to the rotor\'s mark, at a probe along x, over four turns. At a critical speed 1× peaks and its phase ' +
      'falls by 180°; thin: 2×'},
  {key: 'orders_polar', title: 'Polar plot of 1×', unit: 'µm', shape: 'square', over: 'runup', has: hasWhirl('orders'),
    text: 'the same response in polar form, in the rotor\'s frame; the mark is to the right. Each loop is a critical speed'},
  {key: 'poincare', title: 'Poincaré points', unit: 'µm', shape: 'square', over: 'whirl', has: hasWhirl('poincare'),
    text: 'position of the rotor once per turn, second half of the run: one point means synchronous motion, a cloud chaos'},
];

// figure: the number of the same plot in the paper, for the paper's scenes.
const textOf = ({text, figure, controlled}, {name, uncontrolled}) =>
  text + (controlled && uncontrolled ? controlled : '') + (figure && name?.startsWith('paper_') ? ` (paper, Fig. ${figure})` : '');

// The plots of several contacts begin a row.
const shapeOf = ({shape, each}, contact, count) => [shape, each && count > 1 && contact === 0 && 'row'].filter(Boolean).join(' ');

// The plots of a scene, in their order. contact: the number of the contact; place: the contact, if there are several.
export function runPlots(scene) {
  const {contacts} = scene, runs = scene.sides.filter((side) => !side.measured && Object.keys(side.tracks).length > 0);
  const viewOf = (k) => ({scene, runs, contact: contacts[k], impacts: (run) => run.impacts[k],
    track: (run, name) => run.tracks[k > 0 ? `contact${k + 1}_${name}` : name]});
  return kinds.flatMap((kind) => contacts.slice(0, kind.each ? contacts.length : 1).flatMap((place, contact) =>
    (runs.length && kind.has(viewOf(contact)) ? [{...kind, text: textOf(kind, scene), shape: shapeOf(kind, contact, contacts.length), contact, place: kind.each && contacts.length > 1 && place}] : [])));
}
