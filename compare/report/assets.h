// The pages' own files (compare/report/page), part of the program.
#pragma once

#include <string_view>

namespace rotorub {

// Of every page.
std::string_view report_css();
std::string_view page_js();
// Partials of the templates.
std::string_view head_html();
std::string_view foot_html();
std::string_view cards_html();      // the page in short
std::string_view map_html();        // one figure of a map, chosen by the reader
std::string_view figures_html();    // meaning and unit of each
std::string_view plots_html();      // a scene's plots and what is shown of them
std::string_view player_html();     // a scene's live player
std::string_view transport_html();  // time of player and plots
std::string_view contents_html();   // links to the parts of the page
std::string_view rotor_html();      // Campbell diagram and whirl shapes of a scene
// Of the comparison's report, of the modes', of the bench's and of the sweep's page: the template
// (see template.h) and the script.
std::string_view report_html();
std::string_view report_js();
// The page of one run has the report's script.
std::string_view run_html();
// Of pages with a scene's runs: style, and the scripts of plots and player in the order in which
// they go.
std::string_view player_css();
std::string_view tracks_js();
std::string_view pictures_js();
std::string_view whirl_js();
std::string_view campbell_js();  // of the modes' page too
std::string_view traces_js();
std::string_view plots_js();
std::string_view run_js();
std::string_view clock_js();
std::string_view rig_parts_js();
std::string_view rig_js();
std::string_view section_js();
std::string_view unrolled_js();
std::string_view readings_js();
std::string_view player_js();
std::string_view live_js();
std::string_view modes_html();
std::string_view modes_js();
std::string_view bench_html();
std::string_view bench_js();  // its figures, of the report too
std::string_view bench_page_js();
std::string_view sweep_html();
std::string_view sweep_js();  // maps, of the report too
std::string_view map_page_js();
// The maps of the linear analyses have the sweep's script.
std::string_view map_page_html();

}  // namespace rotorub
