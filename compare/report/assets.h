// The pages' own files (compare/report/page), part of the program.
#pragma once

#include <string_view>

namespace rotorub {

// Style of every page, and of pages with a scene's runs.
std::string_view report_css();
std::string_view player_css();
// plotly.js-basic (minified, UTF-8, version and licence in its first lines), gzip.
std::string_view packed_plotly_js();
// Scripts, each a bundle (RotorubEmbed.cmake): of pages with a scene's runs, and of all others.
std::string_view report_js();
std::string_view still_js();
std::string_view native_worker_js();  // runs the native model in a page (what_if.h)
// The pages' templates (page_frame.h).
std::string_view report_html();
std::string_view run_html();
std::string_view modes_html();
std::string_view bench_html();
std::string_view sweep_html();
std::string_view map_page_html();  // the linear analyses
// Partials of the templates.
std::string_view head_html();
std::string_view foot_html();
std::string_view cards_html();      // the page in short
std::string_view map_html();        // one figure of a map, chosen by the reader
std::string_view figures_html();    // meaning and unit of each
std::string_view plots_html();      // a scene's plots and what is shown of them
std::string_view player_html();     // a scene's live player
std::string_view what_if_html();    // sliders of its values
std::string_view transport_html();  // time of player and plots
std::string_view glossary_html();   // what the words mean
std::string_view rotor_html();      // Campbell diagram and whirl shapes of a scene
std::string_view bode_html();       // its response to unbalance

}  // namespace rotorub
