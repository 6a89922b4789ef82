// Markup as text: html`<p>${text}</p>`. A value is escaped, unless it is markup itself; a list is joined, and null and false
// are left out.
const escapes = {'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'};

class Markup {
  constructor(text) { this.text = text; }
}

function written(value) {
  if (Array.isArray(value)) return value.map(written).join('');
  if (value instanceof Markup) return value.text;
  return value === null || value === undefined || value === false ? '' : String(value).replace(/[&<>"]/g, (sign) => escapes[sign]);
}

// The pieces of a text. Those between backticks, as the terminal prints code, are passed through code(piece).
export const withCode = (text, code = (piece) => html`<code>${piece}</code>`) => {
  const pieces = text.split('`');
  return pieces.length % 2 ? pieces.map((piece, k) => (k % 2 ? code(piece) : piece)) : [text];
};

export const html = (texts, ...values) => new Markup(texts.reduce((all, text, k) => all + written(values[k - 1]) + text));
