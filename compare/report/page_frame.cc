#include "compare/report/page_frame.h"

#include <nlohmann/json.hpp>
#include <string>

#include "compare/report/assets.h"
#include "compare/report/web/plotly.h"
#include "compare/version.h"

namespace rotorub {
namespace {

// "</" would end the script element that holds the data.
std::string for_script(std::string text) {
  for (std::size_t at = text.find("</"); at != std::string::npos; at = text.find("</", at + 3)) {
    text.replace(at, 2, "<\\/");
  }
  return text;
}

}  // namespace

nlohmann::json page_frame(std::string_view script, const nlohmann::json& data) {
  return {{"version", program_version()},
          {"css", report_css()},
          {"js", std::string(page_js()) + std::string(script)},
          {"plotly", plotly_js()},
          {"data", for_script(data.dump())}};
}

}  // namespace rotorub
