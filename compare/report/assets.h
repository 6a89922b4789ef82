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
std::string_view page_html();         // the frame of every page (page.h)

}  // namespace rotorub
