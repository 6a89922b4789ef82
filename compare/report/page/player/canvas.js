// What all canvases of the player share: sharp pixels, fading lines, fonts.
// Sizes the canvas to its place on the screen, and clears it. Lengths are then CSS pixels.
export function sharp(canvas) {
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
}

// A path through places, each [x, y].
export function stroke(ctx, places, color, width, dash = []) {
  ctx.beginPath();
  for (const place of places) ctx.lineTo(...place);
  strokePath(ctx, color, width, dash);
}
export function circle(ctx, [x, y], radius, color, width, dash = []) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  strokePath(ctx, color, width, dash);
}
function strokePath(ctx, color, width, dash) {
  ctx.strokeStyle = color;
  ctx.lineWidth = width;
  ctx.setLineDash(dash);
  ctx.stroke();
  ctx.setLineDash([]);
}
export function polygon(ctx, places, color) {
  ctx.beginPath();
  for (const place of places) ctx.lineTo(...place);
  ctx.fillStyle = color;
  ctx.fill();
}
export const disc = (ctx, place, radius, color) => sector(ctx, place, 0, radius, 0, Math.PI, color);
// A part of a ring, or with `half` = pi all of it.
export function sector(ctx, [x, y], inner, outer, angle, half, color) {
  ctx.beginPath();
  ctx.arc(x, y, outer, angle - half, angle + half);
  ctx.arc(x, y, inner, angle + half, angle - half, true);
  ctx.fillStyle = color;
  ctx.fill();
}

// A line that fades towards its beginning, in bands of one opacity each: a stroke a point would cost more than all
// the rest of the picture. share(k): of the way to the end that point k stands at, from 0 to 1; joined(k): whether
// point k goes on from the one before.
const kBands = 12;
export function fading(ctx, places, color, width, share = (k) => k / (places.length - 1), joined = () => true) {
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
}

let family = null;
export function font(size, weight = 400) {
  family = family || getComputedStyle(document.body).fontFamily;
  return `${weight} ${size}px ${family}`;
}
