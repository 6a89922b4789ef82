#pragma once

#include <string_view>

namespace rotorub {

// The minified script of plotly.js-basic (UTF-8, version and licence in its first lines), as it
// goes into the <script> element of a report. It is part of the program, and lives as long as it
// does.
std::string_view plotly_js();

}  // namespace rotorub
