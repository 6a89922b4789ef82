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
const measured = (name) => ({scene}) => scene.sides.some((side) => side.measured && side.tracks[name]);

const kinds = [
  {key: 'gap', title: 'Gap', unit: 'µm', text: '0: contact; below 0: penetration', shape: 'wide', over: 'time', each: true, has: touchesAnd(moves('gap'))},
  {key: 'gap_rate', title: 'Gap rate', unit: 'mm/s', text: 'what control brings to 0', figure: 8, over: 'time', each: true, has: touchesAnd(moves('gap'))},
  {key: 'rotor_x', title: 'Rotor', unit: 'µm', text: 'along x; dotted, where there is control: without it', figure: 9, over: 'time', each: true, has: moves('rotor')},
  {key: 'normal_force', title: 'Normal force', unit: 'N', text: 'of lasting contact; impulses of the rigid law\'s impacts are below', over: 'time', each: true, has: touchesAnd(moves('normal'))},
  {key: 'sample_force', title: 'Force of a sample', unit: 'N', shape: 'wide', over: 'time', has: moves('force'),
    text: 'what the force sensor sees: of every run averaged over the record\'s samples, impacts included'},
  {key: 'friction_force', title: 'Friction force', unit: 'N', text: 'on the rotor, along the ring', over: 'time', each: true, has: touchesAnd(moves('friction'))},
  {key: 'impacts', title: 'Impacts', unit: 'mN s', text: 'normal impulse of each impact or contact episode', over: 'impacts', each: true, has: strikes},
  {key: 'friction_impacts', title: 'Friction of impacts', unit: 'mN s', text: 'size of the tangential impulse of each', over: 'impacts', each: true, has: rubs},
  {key: 'normal_law', title: 'Normal contact law', unit: 'm/s', shape: 'square', over: 'law', each: true, has: strikes,
    text: 'gap rates before and after each impact; dashed: the restitution where friction has no part'},
  {key: 'friction_law', title: 'Friction law', shape: 'square', over: 'law', each: true, has: rubs,
    text: 'of each impact, tangential over friction times normal impulse; dashed: Coulomb\'s', figure: 5},
  {key: 'spin', title: 'Spin speed', unit: 'rpm', text: 'what friction takes from the drive', over: 'time', has: moves('spin_speed')},
  {key: 'ring_speed', title: 'Ring speed', unit: 'rpm', text: 'what friction and drag make of the ring that turns', over: 'time', each: true, has: moves('ring_speed')},
  {key: 'torsion', title: 'Torsion', unit: 'mrad', text: 'twist of the shaft at the contact', over: 'time', has: moves('torsion')},
  {key: 'control', title: 'Control force', unit: 'N', text: 'magnitude of the actuators\' force on the ring', over: 'time', each: true, has: moves('control')},
  {key: 'current', title: 'Coil current', unit: 'A', text: 'magnitude of the control currents of the two axes', over: 'time', each: true, has: moves('current')},
  {key: 'actuator', title: 'Actuator', unit: 'N', shape: 'square', over: 'path', each: true, has: moves('current'),
    text: 'force of axis 1 over its current, on the characteristic F(s, i)', figure: 3},
  {key: 'motor', title: 'Motor', unit: 'N m', shape: 'square', over: 'path', has: moves('motor_torque'),
    text: 'torque over speed; dashed: the motor\'s characteristic', figure: 6},
  {key: 'force_spread', title: 'Histogram of the force', unit: '% of the time', over: 'spread', each: true, has: touchesAnd(moves('normal')),
    text: 'distribution of the normal force over time: a rub that lasts is a peak, bouncing a slope'},
  {key: 'impulse_spread', title: 'Exceedance of impulses', over: 'spread', each: true, has: strikes,
    text: 'how many impacts reach an impulse; the longer the tail, the more a few hard ones decide'},
  {key: 'orbit', title: 'Orbits', unit: 'µm', shape: 'square', over: 'turns', each: true, has: always,
    text: 'rotor solid, ring dotted; the last turns, or the time zoomed to; diamonds: the mark on the rotor passes +x, one that stays is 1×; ' +
      'arrows and words: with the spin or against it'},
  {key: 'relative', title: 'Rotor in the ring', unit: 'µm', shape: 'square', over: 'turns', each: true, has: touches,
    text: 'relative to the ring\'s centre; dashed: the clearance'},
  {key: 'measured_minus', title: 'Measured minus run', unit: 'µm', shape: 'wide', over: 'time', has: measured('rotor'),
    text: 'along x, at the record\'s samples: 0 where the run is the record; a constant is a sensor\'s zero, a wave an amplitude or a phase that is off'},
  {key: 'residual', title: 'Away from the first run', unit: 'µm', over: 'time', has: ({runs}) => runs.length > 1,
    text: 'distance of a run\'s rotor from the first run\'s; in chaos it grows to the orbit\'s size'},
  {key: 'spectrum', title: 'Full spectrum', unit: 'µm', over: 'whirl', has: hasWhirl('spectrum'),
    text: 'of the second half: forward whirl above 0 Hz, backward below; dashed: the spin'},
  {key: 'waterfall', title: 'Waterfall', unit: 'µm', over: 'whirl', has: hasWhirl('waterfall'),
    text: 'the full spectrum over the run, of the first run shown'},
  {key: 'cascade', title: 'Cascade', unit: 'µm', shape: 'wide tall', over: 'runup', has: hasWhirl('cascade'),
    text: 'full spectra over the speed as it changes, forward whirl right, backward left; a ridge along 1× or 2× is bound to the spin, ' +
      'an upright one is a natural frequency that rings; of the first run shown'},
  {key: 'orders', title: '1× and 2× over the speed', unit: 'µm', shape: 'wide tall', over: 'runup', has: hasWhirl('orders'),
    text: 'amplitude and phase against the mark on the rotor, as a probe along x has them, over four turns; where 1× peaks and falls by ' +
      'half a turn a critical speed is passed; thin: 2×'},
  {key: 'orders_polar', title: 'Polar plot of 1×', unit: 'µm', shape: 'square', over: 'runup', has: hasWhirl('orders'),
    text: 'the same as the high spot goes on the rotor, the mark to the right: a loop is a critical speed'},
  {key: 'poincare', title: 'Poincaré points', unit: 'µm', shape: 'square', over: 'whirl', has: hasWhirl('poincare'),
    text: 'the rotor once a turn, second half: a point is synchronous, a cloud chaos'},
];

// figure: the number of the same plot in the paper, for the paper's scenes.
const textOf = ({text, figure}, {name}) => (figure && name?.startsWith('paper_') ? `${text} (paper, Fig. ${figure})` : text);

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
