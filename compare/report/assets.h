// The files of the pages (compare/report/page), embedded in the program.
#pragma once

#include <string_view>

namespace rotorub {

// Style of every page, and additional style of pages with a scene's runs.
std::string_view report_css();
std::string_view player_css();
// plotly.js-basic (minified, UTF-8, version and licence in its first lines), gzip.
std::string_view packed_plotly_js();
// Scripts, each a bundle (RotorubEmbed.cmake): for pages with a scene's runs, and for all others.
std::string_view report_js();
std::string_view still_js();
std::string_view native_worker_js();  // runs the native model in a page (what_if.h)
// The pages' templates (page_frame.h).
std::string_view report_html();
std::string_view run_html();
std::string_view page_html();  // for pages that the script lays out
// Partials of the templates.
std::string_view head_html();
std::string_view foot_html();
std::string_view plots_html();      // a scene's plots and their controls
std::string_view player_html();     // a scene's live player
std::string_view what_if_html();    // sliders for the scene's values
std::string_view transport_html();  // time control of player and plots
std::string_view glossary_html();   // meaning of the terms

}  // namespace rotorub
