// A run at one contact, for the pictures: positions at a time, impacts, force scales.
import {countUntil} from '../scales.js';
import {Track} from './tracks.js';

const kModes = ['free', 'slide', 'stick'];
// The tracks that a run has for each contact; for the further contacts the names begin with contact2_, contact3_, ...
const kOfEach = ['rotor', 'ring', 'gap', 'gap_rate', 'normal', 'friction', 'force', 'mode', 'impacts', 'control', 'current', 'ring_spin', 'ring_speed'];

// The tracks as the contact of this number (from 0) has them.
export function tracksAt(tracks, number) {
  if (number === 0) return tracks;
  const shared = Object.entries(tracks).filter(([name]) => !kOfEach.includes(name));
  const own = kOfEach.map((name) => [name, tracks[`contact${number + 1}_${name}`]]).filter(([, track]) => track);
  return Object.fromEntries([...shared, ...own]);
}

// Makes the run of a side of the scene at its first contact; `contacts` has the run at each contact.
export function runOf(side, scene) {
  // A ring that cannot move stays where it is in the first run, measured or not.
  const fixed = side.measured && !scene.contacts[0].ring_moves ? {ring: scene.sides[0].tracks.ring} : {};
  const tracks = Object.fromEntries(Object.entries({...fixed, ...side.tracks}).filter(([, packed]) => packed).map(([name, packed]) => [name, new Track(packed)]));
  const contacts = scene.contacts.map((contact, number) => new Run(side, contact, number, tracks));
  for (const run of contacts) run.contacts = contacts;
  return contacts[0];
}

// A sentence on what a record lacks to be drawn as a run is.
export function absentOf(tracks, {touches, ring_moves: moves}) {
  if (!('rotor' in tracks)) return 'The record has no rotor_x with its rotor_y: the measured run is in the plots alone.';
  const missing = [['ring', moves, 'ring'], ['gap', touches, 'gap'], ['spin_speed', true, 'speed']].filter(([track, asked]) => asked && !(track in tracks));
  return 'Of the measured run the player shows what its record has; not measured, and not drawn: the shaft\'s shape, the angle of spin' +
    `${missing.length ? `, ${missing.map(([, , words]) => words).join(', ')}` : ''}.`;
}

const kNoImpacts = {t: [], normal: [], friction: [], before: [], after: [], slip: []};
// Impacts as they are drawn: mN s, m/s, and the share of friction times the normal impulse.
export function pointsOf({t, normal, friction, before, after, slip}, coefficient) {
  const milli = (list) => list.map((value) => 1e3 * Math.abs(value));
  return {t, before, after, slip, normal: milli(normal), friction: milli(friction),
    share: friction.map((impulse, k) => (coefficient > 0 ? impulse / (coefficient * normal[k]) : 0))};
}

export class Run {
  constructor(side, contact, number, tracks) {
    this.label = side.label;
    this.status = side.status;
    this.measured = Boolean(side.measured);
    this.holes = side.holes || {};
    this.absent = this.measured ? absentOf(tracks, contact) : '';
    this.clearance = contact.clearance;
    this.finest = contact.gap_tolerance;
    this.number = number;
    this.points = pointsOf(side.impacts?.[number] ?? kNoImpacts, contact.friction);  // a record has none
    this.longestImpact = side.longest_impact ?? Infinity;  // s, with a soft contact
    this.tracks = tracksAt(tracks, number);
    // The position of a ring that does not move is known without a measurement.
    this.ringKnown = !this.measured || 'ring' in this.tracks || !contact.ring_moves;
    this.start = this.tracks.rotor ? this.tracks.rotor.time(0) : 0;
    this.end = this.tracks.rotor ? this.tracks.rotor.time(this.tracks.rotor.knots - 1) : 0;
    this.bends = [];
    for (let k = 1; this.tracks[`bend_${k}`]; ++k) this.bends.push(this.tracks[`bend_${k}`]);
  }

  // True if the rotor's position is known at t: a record may begin late, end early and have holes.
  within(t) {
    if (!this.has('rotor') || !this.measured) return this.has('rotor');
    return t >= this.start - 1e-9 && t <= this.end + 1e-9 && !(this.holes.rotor || []).some(([from, to]) => t > from && t < to);
  }
  has(name) { return name in this.tracks; }
  value(name, t, c = 0) { return this.has(name) ? this.tracks[name].at(t, c) : null; }
  pair(name, t) { return this.has(name) ? [this.tracks[name].at(t, 0), this.tracks[name].at(t, 1)] : null; }

  // All values at one instant, SI; null for values that the run does not have. e: unit vector from the ring's centre to the
  // rotor's ([0, 0] if they coincide). The rotor's position in the ring is taken from the gap, which is more accurate.
  pose(t) {
    const ring = this.pair('ring', t) || [0, 0];
    let rotor = this.pair('rotor', t) || ring;
    const d = [rotor[0] - ring[0], rotor[1] - ring[1]], delta = Math.hypot(d[0], d[1]);
    const e = delta > 0 ? [d[0] / delta, d[1] / delta] : [0, 0];
    const gap = this.value('gap', t);
    if (gap !== null && delta > 0 && !this.measured) {
      const radius = this.clearance - gap;
      rotor = [ring[0] + radius * e[0], ring[1] + radius * e[1]];
    }
    return {t, ring, rotor, e, angle: Math.atan2(d[1], d[0]), gap,
      gapRate: this.value('gap_rate', t),
      spin: this.value('spin', t), speed: this.value('spin_speed', t), ringSpin: this.value('ring_spin', t),
      force: this.value('force', t), normal: this.value('normal', t), friction: this.value('friction', t),
      mode: this.has('mode') ? kModes[Math.round(this.value('mode', t))] : null,
      control: this.pair('control', t), current: this.pair('current', t)};
  }

  // {t, normal, friction, angle}, of every impact that counts, in order of time.
  get impacts() {
    if (!this.strikes) {
      const track = this.tracks.impacts;
      this.strikes = [];
      for (let k = 0; track && k < track.knots; ++k) {
        const t = track.time(k);
        this.strikes.push({t, normal: track.values[0][k], friction: track.values[1][k], angle: this.pose(t).angle});
      }
    }
    return this.strikes;
  }
  // The number of impacts at or before t.
  impactsUntil(t) { return countUntil(this.impacts, t, (impact) => impact.t); }
  // The impacts in (from, t].
  impactsBetween(from, t) { return this.impacts.slice(this.impactsUntil(from), this.impactsUntil(t)); }
  get largestImpulse() { return this.impacts.reduce((most, i) => Math.max(most, i.normal), 0); }
  // Times of the first impact and of all impacts above a fifth of the largest; shortly after the impact, when the rebound has
  // begun.
  get hardImpacts() {
    const least = 0.2 * this.largestImpulse, tick = this.tracks.gap ? 2 * this.tracks.gap.packed.tick : 0;
    return this.impacts.filter((i, k) => k === 0 || i.normal >= least).map((i) => i.t + tick);
  }

  // The force that 95 % of the knots in contact do not exceed, and the greatest of all.
  get forces() {
    if (!this.scale) {
      const track = this.tracks.normal;
      if (track) track.unpack();
      const all = track ? Array.from(track.values[0]).filter((f) => f > 0).sort((a, b) => a - b) : [];
      this.scale = {usual: all.length ? all[Math.floor(0.95 * (all.length - 1))] : 0, most: all.length ? all[all.length - 1] : 0};
    }
    return this.scale;
  }
  // m: the largest penetration.
  get deepest() {
    const track = this.tracks.gap;
    if (!track) return 0;
    track.unpack();
    return track.values[0].reduce((most, gap) => Math.max(most, -gap), 0);
  }
  // The largest magnitude of control or current.
  largest(name) {
    const track = this.tracks[name];
    if (!track) return 0;
    track.unpack();
    let most = 0;
    for (let k = 0; k < track.knots; ++k) most = Math.max(most, Math.hypot(track.values[0][k], track.values[1][k]));
    return most;
  }

  // Places of the rotor's centre from t - span to t, oldest first; n + 1 of them.
  trail(t, span, n) {
    const from = Math.max(t - span, this.tracks.rotor.time(0)), points = [];
    for (let k = 0; k <= n; ++k) points.push(this.pose(from + (t - from) * k / n));
    return points.filter((p) => this.within(p.t));
  }

  // Times in (from, to] at which the mark on the rotor passes +x: the keyphasor's pulses.
  pulses(from, to, steps = 200) {
    if (!this.has('spin')) return [];
    const turn = 2 * Math.PI, spin = this.tracks.spin, times = [];
    let a = from, fa = spin.at(from) / turn;
    for (let k = 1; k <= steps; ++k) {
      const b = from + (to - from) * k / steps, fb = spin.at(b) / turn;
      if (Math.floor(fa) !== Math.floor(fb)) {
        const whole = fb > fa ? Math.floor(fb) : Math.floor(fa);
        times.push(a + (b - a) * (whole - fa) / (fb - fa));
      }
      a = b; fa = fb;
    }
    return times;
  }
}
