// What every page holds besides its own, so that it needs neither files nor a network.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string_view>

namespace rotorub {

// Template values "version", "css", "js" (what pages share, then `script`), "plotly" and "data",
// the latter fit for a script element.
nlohmann::json page_frame(std::string_view script, const nlohmann::json& data);

}  // namespace rotorub
