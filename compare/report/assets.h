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
std::string_view cards_html();    // the page in short
std::string_view map_html();      // one figure of a map, chosen by the reader
std::string_view figures_html();  // meaning and unit of each
// Of the comparison's report, of the modes', of the bench's and of the sweep's page: the template
// (see template.h) and the script.
std::string_view report_html();
std::string_view report_js();
std::string_view modes_html();
std::string_view modes_js();
std::string_view bench_html();
std::string_view bench_js();
std::string_view sweep_html();
std::string_view sweep_js();
// The page of the rub map has the sweep's script.
std::string_view rub_map_html();

}  // namespace rotorub
