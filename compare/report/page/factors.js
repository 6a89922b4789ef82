// Factors from SI units to those in which people read speeds, frequencies, lengths and times.
export const rpm = 30 / Math.PI, hz = 0.5 / Math.PI, milli = 1e3, micro = 1e6;
