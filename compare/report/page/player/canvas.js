// Functions for all canvases of the player: sharp pixels, fading lines, fonts.

// Fits the canvas to its size on the screen and clears it. Lengths are then CSS pixels.
export function sharp(canvas) {
  const width = canvas.clientWidth, height = canvas.clientHeight, fine = window.devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * fine) || canvas.height !== Math.round(height * fine)) {
    canvas.width = Math.round(width * fine);
    canvas.height = Math.round(height * fine);
  }
  // The processor draws the canvas: a graphics card does not speed up thin lines, and software rendering would be much slower.
  const ctx = canvas.getContext('2d', {willReadFrequently: true});
  ctx.setTransform(fine, 0, 0, fine, 0, 0);
  ctx.clearRect(0, 0, width, height);
  return {ctx, width, height};
}

// Draws a path through places, each [x, y].
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
// Fills a sector of a ring; `half` = pi fills the whole ring.
export function sector(ctx, [x, y], inner, outer, angle, half, color) {
  ctx.beginPath();
  ctx.arc(x, y, outer, angle - half, angle + half);
  ctx.arc(x, y, inner, angle + half, angle - half, true);
  ctx.fillStyle = color;
  ctx.fill();
}

// Draws a line that fades towards its beginning. It has bands of constant opacity, because one stroke per point would cost
// more than the rest of the picture. share(k): position of point k on the way from the beginning (0) to the end (1).
// joined(k): true if point k is connected with the previous one.
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
