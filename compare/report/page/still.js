// Starts a page without runs (bench, modes, optimise, maps), and lays it out.
import {layOut} from './layout.js';
import {searchMap} from './optimum.js';
import {data, start, withPlotly} from './page.js';
import {withPlots} from './plot_words.js';
import {stillParts} from './still_parts.js';
import {stills} from './stills.js';

if (data.search) data.maps = [searchMap(data.search)];
layOut(document.querySelector('main'), withPlots(stillParts(data), data));
window.page = {data};
const draw = stills();
start(draw);
withPlotly(draw);
