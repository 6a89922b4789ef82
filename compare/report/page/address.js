// Stores the view of a scene in the page's address: `report.html#scene-1?t=0.107&from=0.1&to=0.12&hide=cone`. Such a link
// points to a moment and survives a reload. t, from, to: s of the run; hide: runs that are not shown.

export function addressOf(id, {t, range, hidden}) {
  const words = new URLSearchParams({t, from: range[0], to: range[1]});
  for (const run of hidden) words.append('hide', run);
  return `#${id}?${words}`;
}

// Returns null if the address does not name this scene. A value that is missing or not a number is undefined.
export function stateIn(hash, id) {
  if (!hash.startsWith(`#${id}?`)) return null;
  const words = new URLSearchParams(hash.slice(id.length + 2));
  const number = (name) => {
    const text = words.get(name), value = Number(text);
    return text && Number.isFinite(value) ? value : undefined;
  };
  return {t: number('t'), from: number('from'), to: number('to'), hidden: new Set(words.getAll('hide'))};
}

// Writes the address shortly after the last change, without an entry in the browser's history for each change.
export class AddressWriter {
  constructor(id) { this.id = id; }
  write(state) {
    clearTimeout(this.waiting);
    this.waiting = setTimeout(() => history.replaceState(null, '', addressOf(this.id, state)), 250);
  }
}
