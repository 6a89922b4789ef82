// Starts a page without runs (bench, modes, maps), and lays it out if its data has parts.
import {layOut} from './layout.js';
import {data, start, withPlotly} from './page.js';
import {withPlots} from './plot_words.js';
import {stills} from './stills.js';

if (data.page) layOut(document.querySelector('main'), withPlots(data.page, data));
window.page = {data};
const draw = stills();
start(draw);
withPlotly(draw);
