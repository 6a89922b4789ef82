#pragma once

#include <string_view>

namespace rotorub {

// Scripts of others (minified, UTF-8, version and licence in their first lines), as they go into
// the <script> elements of a page. They are part of the program, and live as long as it does.
std::string_view plotly_js();  // plotly.js-basic: plots
std::string_view three_js();  // three.js: the rig in WebGL; the last with a build for plain scripts

}  // namespace rotorub
