// The answer of a page: its first sentence in large type, then the sentences that follow it.
import {html} from './html.js';

export const answerOf = ([first, ...others]) => ({class: 'answer', parts: [{markup: html`<p class="sentence">${first.text}</p>`}, ...others]});

// The parts of a result before its first heading, and the others.
export function splitAtHeading(parts) {
  const at = parts.findIndex(({heading, title}) => heading || title);
  return at < 0 ? [parts, []] : [parts.slice(0, at), parts.slice(at)];
}

export const sheetsOf = (parts) => ({class: 'sheets', parts});
export const scenesText = (pre) => ({summary: 'The scene\'s text', pre});
