// Of a page without runs: bench, modes, maps. Some of these pages are laid out here.
import {layOut} from './layout.js';
import {data, start, withPlotly} from './page.js';
import {withPlots} from './plot_words.js';
import {stills} from './stills.js';

if (data.page) layOut(document.querySelector('main'), withPlots(data.page, data));
window.page = {data};
const draw = stills();
start(draw);
withPlotly(draw);
