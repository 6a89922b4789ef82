// What all canvases of the player share: sharp pixels, fonts, figures with their units.
'use strict';
(() => {
  // Sizes the canvas to its place on the screen, and clears it. Lengths are then CSS pixels.
  page.sharp = (canvas) => {
    const width = canvas.clientWidth, height = canvas.clientHeight, fine = window.devicePixelRatio || 1;
    if (canvas.width !== Math.round(width * fine) || canvas.height !== Math.round(height * fine)) {
      canvas.width = Math.round(width * fine);
      canvas.height = Math.round(height * fine);
    }
    // Drawn by the processor: these are thin lines, which a graphics card gains nothing by, and one that is itself
    // software loses much.
    const ctx = canvas.getContext('2d', {willReadFrequently: true});
    ctx.setTransform(fine, 0, 0, fine, 0, 0);
    ctx.clearRect(0, 0, width, height);
    return {ctx, width, height};
  };

  // A line that fades towards its beginning, in bands of one opacity each: a stroke a point would cost more than all
  // the rest of the picture. share(k): of the way to the end that point k stands at, from 0 to 1; joined(k): whether
  // point k goes on from the one before.
  const kBands = 12;
  page.fading = (ctx, places, color, width, share = (k) => k / (places.length - 1), joined = () => true) => {
    ctx.strokeStyle = color;
    ctx.lineWidth = width;
    for (let band = 0, k = 1; band < kBands; ++band) {
      ctx.globalAlpha = 0.08 + 0.92 * ((band + 1) / kBands) ** 2;
      ctx.beginPath();
      if (k < places.length) ctx.moveTo(...places[k - 1]);
      for (; k < places.length && (share(k) <= (band + 1) / kBands || band + 1 === kBands); ++k) {
        ctx[joined(k) ? 'lineTo' : 'moveTo'](...places[k]);
      }
      ctx.stroke();
    }
    ctx.globalAlpha = 1;
  };

  let family = null;
  page.font = (size, weight = 400) => {
    family = family || getComputedStyle(document.body).fontFamily;
    return `${weight} ${size}px ${family}`;
  };

  // To three digits, with the prefix that suits it.
  function figure(value, units) {
    if (value === 0) return '0 ' + units.find(([one]) => one === 1)[1];
    const [size, unit] = units.find(([least]) => Math.abs(value) >= least * 0.9995) || units[units.length - 1];
    const scaled = value / size;
    const digits = Math.max(0, 2 - Math.max(0, Math.floor(Math.log10(Math.abs(scaled) * 1.0005))));
    return Number(scaled.toFixed(Math.min(digits, 2))).toLocaleString('en').replace('-', '−') + ' ' + unit;
  }
  const lengths = [[1, 'm'], [1e-3, 'mm'], [1e-6, 'µm'], [1e-9, 'nm'], [1e-12, 'pm']];
  page.units = {
    length: (v) => figure(v, lengths),
    force: (v) => figure(v, [[1e3, 'kN'], [1, 'N'], [1e-3, 'mN']]),
    impulse: (v) => figure(v, [[1, 'N s'], [1e-3, 'mN s'], [1e-6, 'µN s']]),
    speed: (v) => figure(v, [[1, 'm/s'], [1e-3, 'mm/s'], [1e-6, 'µm/s']]),
    current: (v) => figure(v, [[1, 'A'], [1e-3, 'mA']]),
    // What is finer than the page holds it is contact.
    gap: (v, finest) => Math.abs(v) < finest ? '0' : v < 0 ? figure(-v, lengths) + ' deep' : figure(v, lengths),
    rpm: (v) => Math.round(v * 30 / Math.PI).toLocaleString('en') + ' rpm',
    time: (v) => v.toFixed(6) + ' s',
  };
})();
