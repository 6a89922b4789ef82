// Figures with their units, in the system that the reader chose (unit_system.js).
import {inUnits} from '../unit_system.js';

// The value with three digits and a suitable prefix.
function figure(value, units) {
  if (value === 0) return inUnits(`0 ${units.find(([one]) => one === 1)[1]}`);
  const [size, unit] = units.find(([least]) => Math.abs(value) >= least * 0.9995) || units[units.length - 1];
  const scaled = value / size;
  const digits = Math.max(0, 2 - Math.max(0, Math.floor(Math.log10(Math.abs(scaled) * 1.0005))));
  return inUnits(`${Number(scaled.toFixed(Math.min(digits, 2))).toLocaleString('en').replace('-', '−')} ${unit}`);
}
const lengths = [[1, 'm'], [1e-3, 'mm'], [1e-6, 'µm'], [1e-9, 'nm'], [1e-12, 'pm']];
export const units = {
  length: (v) => figure(v, lengths),
  force: (v) => figure(v, [[1e3, 'kN'], [1, 'N'], [1e-3, 'mN']]),
  impulse: (v) => figure(v, [[1, 'N s'], [1e-3, 'mN s'], [1e-6, 'µN s']]),
  speed: (v) => figure(v, [[1, 'm/s'], [1e-3, 'mm/s'], [1e-6, 'µm/s']]),
  current: (v) => figure(v, [[1, 'A'], [1e-3, 'mA']]),
  // A gap finer than the page can hold counts as contact.
  gap: (v, finest) => Math.abs(v) < finest ? '0' : v < 0 ? `${figure(-v, lengths)} deep` : figure(v, lengths),
  rpm: (v) => `${Math.round(v * 30 / Math.PI).toLocaleString('en')} rpm`,
  time: (v) => `${v.toFixed(6)} s`,
  // A duration, such as a time step.
  duration(v) {
    const [size, unit] = v < 1e-3 ? [1e-6, 'µs'] : v < 0.1 ? [1e-3, 'ms'] : [1, 's'];
    return `${Number((v / size).toPrecision(6))} ${unit}`;
  },
};
