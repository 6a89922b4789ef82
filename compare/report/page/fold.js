// Parts that do not affect the verdict are folded at first; on small screens all long parts are. A link into a folded part
// opens it. A printed page has every table and plot.
const kFirstPlots = 6;  // plots of a scene that are shown at first; two fewer on a small screen (report.css)

const small = () => matchMedia('(max-width: 760px)').matches;

// Shows the first few plots of a scene, and a button for the rest.
function shorten(grid) {
  const plots = grid.querySelectorAll('figure').length;
  if (plots <= kFirstPlots + 2) return;
  grid.classList.add('few');
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'more-plots';
  button.textContent = `all ${plots} plots`;
  button.addEventListener('click', () => { grid.classList.remove('few'); button.remove(); });
  grid.after(button);
}

// Opens the folded parts around the link's target and scrolls there. If no part was folded, the browser has scrolled already.
function openTarget() {
  const target = document.getElementById(location.hash.slice(1).split('?')[0]);
  let opened = false;
  for (let part = target; part; part = part.parentElement) {
    if (part.tagName !== 'DETAILS' || part.open) continue;
    part.open = true;
    opened = true;
  }
  if (opened) target.scrollIntoView();
}

// Makes tables that are wider than their place scrollable with the keyboard.
function reachTables() {
  for (const place of document.querySelectorAll('.scroll')) {
    const wide = place.scrollWidth > place.clientWidth + 1;
    place.toggleAttribute('tabindex', wide);
    if (!wide) { place.removeAttribute('role'); place.removeAttribute('aria-label'); continue; }
    const heading = place.querySelector('caption') || place.closest('section, details, article, .answer')?.querySelector('h2, h3, summary');
    place.tabIndex = 0;
    place.setAttribute('role', 'region');
    place.setAttribute('aria-label', `table: ${heading ? heading.textContent.trim() : 'figures'}`);
  }
}

// Call it before the page is drawn.
export function foldParts() {
  if (small()) for (const part of document.querySelectorAll('details.later')) part.open = false;
  document.querySelectorAll(`${small() ? '' : '.scene '}.plots .plot-grid`).forEach(shorten);
  addEventListener('hashchange', openTarget);
  if (location.hash) openTarget();
  reachTables();
  addEventListener('resize', reachTables);
  let opened = [];
  addEventListener('beforeprint', () => {
    opened = [...document.querySelectorAll('details.later:not([open])')];
    for (const part of opened) part.open = true;
  });
  addEventListener('afterprint', () => { for (const part of opened) part.open = false; });
}
