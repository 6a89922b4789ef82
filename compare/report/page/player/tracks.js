// Packed tracks (compare/report/pack/track.h). They are unpacked at the first use and can be read at any time.
import {countUntil} from '../scales.js';

// The cubic Hermite polynomial over h at the fraction s.
const cubic = (a, da, b, db, h, s) =>
  (1 - s) * (1 - s) * ((1 + 2 * s) * a + s * h * da) + s * s * ((3 - 2 * s) * b - (1 - s) * h * db);

// Decodes whole numbers: differences in zigzag form, seven bits per byte. Times exceed 2^31 ticks, so bit operations cannot be
// used.
function column(bytes, place, count, unit) {
  const numbers = new Float64Array(count);
  let number = 0;
  for (let k = 0; k < count; ++k) {
    let zigzag = 0, scale = 1, byte;
    do {
      byte = bytes.charCodeAt(place.at++);
      zigzag += (byte & 127) * scale;
      scale *= 128;
    } while (byte > 127);
    number += zigzag % 2 ? -(zigzag + 1) / 2 : zigzag / 2;
    numbers[k] = number * unit;
  }
  return numbers;
}

export class Track {
  constructor(packed) {
    this.packed = packed;
    this.kind = packed.kind;
    this.knots = packed.knots;
    this.components = packed.components;
    this.last = 0;
  }

  unpack() {
    if (this.ticks) return;
    const {data, components, quantum, rate_quantum: rateQuantum} = this.packed;
    const bytes = atob(data), place = {at: 0};
    const columns = (unit) => Array.from({length: components}, () => column(bytes, place, this.knots, unit));
    this.ticks = column(bytes, place, this.knots, 1);
    this.values = columns(quantum);
    if (this.kind === 'hermite') this.rates = columns(rateQuantum);
    this.packed.data = null;
  }

  // s, the time of knot k.
  time(k) {
    this.unpack();
    return this.packed.start + this.ticks[k] * this.packed.tick;
  }

  // The time in whole ticks, as for the knots, so that a sample's time gives exactly the sample.
  toTicks(t) { return Math.round((t - this.packed.start) / this.packed.tick); }

  // The last knot at or before a time in ticks; -1: none.
  before(ticks) {
    this.unpack();
    const all = this.ticks;
    if (all[this.last] <= ticks && (this.last + 1 >= all.length || all[this.last + 1] > ticks)) return this.last;
    const count = countUntil(all, ticks);
    if (count > 0) this.last = count - 1;
    return count - 1;
  }

  at(t, c = 0) {
    if (this.knots === 0) return 0;
    const now = this.toTicks(t), k = this.before(now), y = this.values[c];
    if (k < 0) return y[0];
    if (this.kind === 'hold' || k + 1 === this.knots) return y[k];
    const h = this.ticks[k + 1] - this.ticks[k], s = (now - this.ticks[k]) / h;
    if (this.kind === 'linear') return (1 - s) * y[k] + s * y[k + 1];
    const v = this.rates[c];
    const between = cubic(y[k], v[k], y[k + 1], v[k + 1], h * this.packed.tick, s);
    return this.packed.floored ? Math.max(between, Math.min(y[k], y[k + 1], 0)) : between;
  }

  length(t) {
    let square = 0;
    for (let c = 0; c < this.components; ++c) square += this.at(t, c) ** 2;
    return Math.sqrt(square);
  }

  // The times at which a line through [from, to] must be sampled: every knot (with `jumps` also a tick before it), and where
  // the track is curved also points in between.
  instants(from, to, count, jumps = false) {
    const first = Math.max(0, this.before(this.toTicks(from)) + 1);
    const last = this.before(this.toTicks(to));
    const start = Math.max(from, this.time(0)), end = Math.min(to, this.time(this.knots - 1));
    const times = [start];
    const parts = this.kind === 'hermite' ? Math.min(64, Math.max(1, Math.ceil(count / (last - first + 2)))) : 1;
    const reach = (t) => {
      const begin = times[times.length - 1];
      for (let p = 1; p < parts; ++p) times.push(begin + (t - begin) * p / parts);
      if (jumps) times.push(t - this.packed.tick);
      times.push(t);
    };
    for (let k = first; k <= last; ++k) if (this.time(k) > start) reach(this.time(k));
    if (end > times[times.length - 1]) reach(end);
    return times;
  }
}
