#include "compare/report/page_frame.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "compare/report/assets.h"
#include "compare/report/template.h"
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

nlohmann::json page_frame(const PageHead& head, std::string_view script,
                          const nlohmann::json& data) {
  std::string scripts = "<script id=\"plotly\">\n";
  scripts += plotly_js();
  scripts += "\n</script>\n<script id=\"data\" type=\"application/json\">";
  scripts += for_script(data.dump());
  scripts += "</script>\n<script>\n";
  scripts += page_js();
  scripts += script;
  scripts += "\n</script>";
  return {{"names", head.names},           {"topic", head.topic},  {"heading", head.heading},
          {"version", program_version()}, {"css", report_css()}, {"scripts", std::move(scripts)}};
}

std::string fill_page(std::string_view html, const nlohmann::json& values) {
  return fill_template(html, values,
                       {{"head", head_html()},
                        {"foot", foot_html()},
                        {"cards", cards_html()},
                        {"map", map_html()},
                        {"figures", figures_html()}});
}

}  // namespace rotorub
