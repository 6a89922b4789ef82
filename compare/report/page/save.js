// Saves a plot as a picture, or its points as a table.

// One row for each point: its trace, x, y, and in a map z (RFC 4180).
export function csvOf(traces) {
  const cell = (value) => {
    const text = value === null || value === undefined ? '' : String(value);
    return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
  };
  const isMap = (trace) => trace.z !== undefined;
  const rows = [['trace', 'x', 'y', ...(traces.some(isMap) ? ['z'] : [])]];
  traces.forEach((trace, number) => {
    const name = trace.name ?? `trace ${number + 1}`, at = (axis, k) => (axis ? axis[k] : k);
    if (isMap(trace)) {
      trace.z.forEach((line, j) => {
        Array.from(line).forEach((z, i) => { rows.push([name, at(trace.x, i), at(trace.y, j), z]); });
      });
    } else {
      Array.from(trace.y ?? []).forEach((y, k) => { rows.push([name, at(trace.x, k), y]); });
    }
  });
  return `${rows.map((row) => row.map(cell).join(',')).join('\r\n')}\r\n`;
}

export const fileName = (title) => title.toLowerCase().replace(/[^a-z0-9]+/g, '-').replace(/^-|-$/g, '') || 'plot';

function download(name, text) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([text], {type: 'text/csv'}));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

// Adds the buttons to the caption of a plot's figure, once.
export function offerFiles(plot) {
  const caption = plot.closest('figure')?.querySelector('figcaption');
  if (!caption || caption.querySelector('.save')) return;
  const title = caption.querySelector('b')?.textContent ?? 'plot', name = fileName(title);
  const picture = (format) => () => Plotly.downloadImage(plot, {format, filename: name, scale: format === 'png' ? 2 : 1});
  const save = document.createElement('span');
  save.className = 'save';
  for (const [format, act] of [['PNG', picture('png')], ['SVG', picture('svg')],
    ['CSV', () => download(`${name}.csv`, csvOf(plot.data))]]) {
    const button = document.createElement('button');
    button.type = 'button';
    button.textContent = format;
    button.setAttribute('aria-label', `${title} as ${format}`);
    button.addEventListener('click', act);
    save.append(button);
  }
  caption.append(' ', save);
}
