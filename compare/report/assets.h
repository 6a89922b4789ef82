// The page's own files (compare/report/page), part of the program.
#pragma once

#include <string_view>

namespace rotorub {

std::string_view report_html();  // the template (see template.h)
std::string_view report_css();
std::string_view report_js();

}  // namespace rotorub
