// The free rotor as its plots take it, in rpm, Hz, %, mm and µm, from the SI values of compare/modes/page_data.h.
import {hz, micro, milli, rpm} from './factors.js';
import {short} from './style.js';

const percent = 100;
const times = (factor, list) => list.map((value) => (value === null ? null : factor * value));

// Forward is the direction of the spin, and at rest the direction from x to y.
export function senseOf([frequency, damping], speed) {
  if (frequency === 0) return damping === 0 ? 'rigid' : 'overdamped';
  return (frequency > 0) === (speed >= 0) ? 'forward' : 'backward';
}

const roundOff = 1e-10;  // damping ratio of an undamped mode
const dampingOf = ([, ratio]) => (Math.abs(ratio) < roundOff ? 0 : percent * ratio);
const frequencyOf = ([frequency]) => hz * Math.abs(frequency);

// A branch in pieces of one sense each, every one from the last point of the one before it.
export function piecesOf({speed, modes}) {
  const pieces = [];
  const add = (k) => {
    const {speed: speeds, frequency, damping} = pieces.at(-1);
    speeds.push(rpm * speed[k]);
    frequency.push(frequencyOf(modes[k]));
    damping.push(dampingOf(modes[k]));
  };
  modes.forEach((mode, k) => {
    const sense = senseOf(mode, speed[k]);
    if (sense !== pieces.at(-1)?.sense) {
      pieces.push({sense, speed: [], frequency: [], damping: []});
      if (k > 0) add(k - 1);
    }
    add(k);
  });
  return pieces;
}

const campbellOf = ({found, running, top, branches, operating}) => ({
  top: rpm * top, running: rpm * Math.abs(running), critical: times(rpm, found.critical_speeds),
  threshold: found.stability_threshold === null ? null : rpm * found.stability_threshold,
  torsion: found.torsion.map(({frequency}) => hz * frequency), pieces: branches.flatMap(piecesOf),
  operating: operating.map((mode) => ({sense: senseOf(mode, running), frequency: frequencyOf(mode), damping: dampingOf(mode)}))});

// All shapes have the same height in the picture.
const oneHigh = (shape) => times(1 / Math.max(...shape.map(Math.abs)), shape);
const planeOf = (plane, modes) => modes.map(({frequency, shape}, k) => ({plane, number: k + 1, frequency: hz * frequency, shape: oneHigh(shape)}));

// Each mode is numbered among the modes of its sense, of which the first are shown.
export function whirlsOf(shapes, running, most = 4) {
  const count = {};
  return shapes.flatMap(({mode, roundness, shape}) => {
    const sense = senseOf(mode, running), number = (count[sense] ?? 0) + 1;
    count[sense] = number;
    return number > most ? [] : [{sense, number, frequency: frequencyOf(mode), roundness, shape}];
  });
}

function shapesOf({found: {mode_shapes: shapes}, shaft, running, whirl_shapes: whirls}) {
  if (!shapes) return null;
  const {z, stations, same_planes, x, y} = shapes;
  // A thin disc has J_p = m r^2 / 2; without a polar moment its radius is unknown.
  const radius = ({mass, Jp}) => (mass > 0 && Jp > 0 ? milli * Math.sqrt(2 * Jp / mass) : null);
  return {z: times(milli, z), stations: stations.map((station) => ({...station, z: milli * station.z})), same_planes,
    sections: shaft.sections.map(({from, to, diameter, end_diameter}) => ({from: milli * from, to: milli * to, diameter: milli * diameter, end_diameter: milli * end_diameter})),
    discs: shaft.discs.map((disc) => ({z: milli * disc.z, radius: radius(disc)})),
    whirl: whirlsOf(whirls, running), modes: [...planeOf('x', x), ...(same_planes ? [] : planeOf('y', y))]};
}

// ---------------------------------------------------------------- response to unbalance
// Degrees, with the whole turns that bring it nearest to `last`, so that a curve continues beyond half a turn.
export function phaseNear([real, imaginary], last) {
  const phase = 180 / Math.PI * Math.atan2(imaginary, real);
  return phase - 360 * Math.round((phase - last) / 360);
}

// Amplitudes in µm and phases of complex numbers in m; null where there is no steady motion.
export function amplitudesAndPhases(values) {
  let last = 0;
  const phase = values.map((value) => {
    if (value[0] === null) return null;
    last = phaseNear(value, last);
    return last;
  });
  return {amplitude: values.map(([real, imaginary]) => (real === null ? null : micro * Math.hypot(real, imaginary))), phase};
}

function curveOf({name, plane, deflection, peaks}, speed) {
  const {amplitude, phase} = amplitudesAndPhases(deflection);
  const beside = (at) => phase.slice(0, Math.max(1, speed.filter((one) => one <= at).length)).findLast((one) => one !== null) ?? 0;
  return {name, plane, amplitude, phase, peaks: peaks.map((peak) => ({speed: rpm * peak.speed, amplitude: micro * Math.hypot(...peak.deflection),
    phase: phaseNear(peak.deflection, beside(peak.speed)), factor: peak.amplification, margin: peak.margin}))};
}

// Values at the speeds `from`, linear between them, at the speeds `to`.
export function atSpeeds(values, from, to) {
  return to.map((speed) => {
    const next = from.findIndex((one) => one > speed), k = Math.min(from.length - 1, Math.max(1, next < 0 ? from.length - 1 : next));
    const share = Math.min(1, Math.max(0, (speed - from[k - 1]) / (from[k] - from[k - 1])));
    if (share === 0 || share === 1) return values[k - 1 + share];
    return values[k][0] === null || values[k - 1][0] === null ? [null, null] : values[k].map((value, c) => (1 - share) * values[k - 1][c] + share * value);
  });
}

// The contact that is touched first if all stations move equally.
function clearanceOf(contacts) {
  if (!contacts.length) return {clearance: null};
  const [least] = [...contacts].sort((a, b) => a.clearance - b.clearance), alike = contacts.every(({clearance}) => clearance === least.clearance);
  return {clearance: micro * least.clearance, clearance_of: !alike ? `least clearance, at contact ${least.name}` :
    `clearance at the contact${contacts.length > 1 ? 's' : ''}`};
}

export function responseOf(response, running) {
  if (!response) return null;
  const {speed, probes, before, forces, contacts, limit} = response;
  const named = (list, words) => list.map((probe) => ({...probe, name: `${probe.name}${words}`}));
  const intact = (before?.probes || []).slice(0, probes.length).map((probe) => ({...probe, deflection: atSpeeds(probe.deflection, before.speed, speed)}));
  const all = before ? [...named(intact, ', before the loss'), ...named(probes, ', after the loss')] : probes;
  // API 617 limits the peak-to-peak value.
  return {speed: times(rpm, speed), running: rpm * Math.abs(running), forces, ...clearanceOf(contacts), limit: limit && times(0.5 * micro, limit),
    curves: all.map((probe) => curveOf(probe, speed))};
}

// ---------------------------------------------------------------- critical speed maps
const maps = {
  bearings: ['Critical speed map', 'stiffness of a bearing', 'how the undamped critical speeds change if the springs of all bearings become softer or ' +
    'stiffer in one proportion. A flat curve belongs to the shaft, a rising one to the bearings; where a curve meets the scene\'s speed, unbalance resonates'],
  magnets: ['Critical speed map of the magnets', 'stiffness of a magnetic bearing', 'how the undamped critical speeds change if all magnetic bearings become ' +
    'softer or stiffer in one proportion; their stiffness is the control\'s less the magnets\' pull. A flat curve belongs to the shaft, a rising one to the ' +
    'magnets; where a curve meets the scene\'s speed, unbalance resonates; no line where the magnets do not bear the rotor'],
  ring: ['Critical speed map of the ring', 'stiffness of the ring\'s spring', 'how the undamped critical speeds of the rotor with its centre held to the ' +
    'ring\'s, as in a synchronous rub, change if the spring that carries the ring becomes softer or stiffer. Where a solid curve meets the scene\'s speed, a ' +
    'rub resonates; dashed: the ring alone, √(k/m); long dashes: the rotor alone'],
  mount: ['Critical speed map of the ring\'s mount', 'stiffness of the mount', 'the same if the mount of the ring becomes softer or stiffer. Where a solid ' +
    'curve meets the scene\'s speed, a rub resonates; dashed: ring and mount alone; long dashes: the rotor alone'],
};

// [[rpm]] of the k-th speed in each list; null where there is none.
export const curvesOf = (lists) => Array.from({length: Math.max(0, ...lists.map(({length}) => length))}, (_, k) =>
  lists.map((list) => (k < list.length ? rpm * list[k] : null)));

export function stiffnessOf({of, contact, stiffness, own, critical, ring}) {
  const [title, axis, words] = maps[of];
  return {title: title + (contact && `, ${contact}`), words, of: axis, stiffness, own, curves: curvesOf(critical), ring: curvesOf(ring)};
}

export function rotorOf(data) {
  if (data.refusal) return data;
  return {found: data.found, campbell: campbellOf(data), shapes: shapesOf(data), bode: responseOf(data.response, data.running),
    stiffness: (data.stiffness || []).map(stiffnessOf)};
}

// ---------------------------------------------------------------- closed loops of magnetic bearings
// A curve that passes through a point of which it may have only the neighbours.
export function through({x, y}, [at, value]) {
  const next = x.findIndex((one) => one >= at), k = next < 0 ? x.length : next;
  return x[k] === at ? {x, y} : {x: [...x.slice(0, k), at, ...x.slice(k)], y: [...y.slice(0, k), value, ...y.slice(k)]};
}

const decibels = (size) => 20 * Math.log10(size);

function sensitivityOf({bearing, axis, sensitivity, frequency}, curve) {
  const {x, y} = through(curve, [frequency, sensitivity]);
  return {name: `bearing ${bearing} ${axis}`, f: times(hz, x), y: y.map(decibels), peak: [hz * frequency, decibels(sensitivity)]};
}

// The settling band relative to the steady value, or to the peak if the deflection settles to 0.
const band = 0.02;
function stepOf({bearing, axis, step}, curve) {
  const {largest, largest_at: at, settling_time: settled, steady, overshoot} = step;
  const {x, y} = at === null ? curve : through(curve, [at, largest]);
  const before = y[Math.max(0, x.filter((t) => t <= settled).length - 1)] - steady;
  const edge = Math.sign(before || 1) * band * Math.abs(overshoot === null ? largest : steady);
  return {name: `bearing ${bearing} ${axis}`, t: times(milli, x), y: times(micro, y), peak: at === null ? null : [milli * at, micro * largest],
    settled: [milli * settled, micro * (steady + edge)], steady: micro * steady};
}

// found: the JSON of `rotorub modes`, of whose loops `curves` has the lines.
export const loopsOf = ({speeds}, curves) => speeds.filter(({levitation}) => levitation).map(({speed, levitation: {loops, sample_time: sampled}}, index) => ({
  title: `closed loop of the magnetic bearings at ${short(speed, 6)} rad/s${sampled > 0 ? `, sampled every ${short(sampled, 4)} s` : ''}`,
  sensitivity: curves[index].sensitivity.map((curve, k) => sensitivityOf(loops[k], curve)),
  step: curves[index].step.map((curve, k) => stepOf(loops[k], curve))}));
