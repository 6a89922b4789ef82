#pragma once

#include <string_view>

namespace rotorub {

// plotly.js-basic (minified, UTF-8, version and licence in its first lines), as it goes into the
// <script> element of a page. It is part of the program, and lives as long as it does.
std::string_view plotly_js();

}  // namespace rotorub
