// The answer of a page: its first sentence in large type, then the sentences that follow it.
import {html} from './html.js';

export const answerOf = ([first, ...others]) => ({class: 'answer', parts: [{markup: html`<p class="sentence">${first.text}</p>`}, ...others]});

export const sheetsOf = (parts) => ({class: 'sheets', parts});
export const scenesText = (pre) => ({summary: 'The scene\'s text', pre});
