#include "compare/report/page_frame.h"

#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "compare/base/version.h"
#include "compare/report/assets.h"
#include "compare/report/template.h"
#include "compare/report/web/scripts.h"

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

nlohmann::json page_frame(const PageHead& head, const nlohmann::json& data, Pictures pictures) {
  // Where there is a player, its own script starts plotly once the player is drawn.
  const bool live = pictures == Pictures::kPlotsAndRig;
  std::string scripts =
      live ? "<script id=\"plotly\" type=\"text/plain\">\n" : "<script id=\"plotly\">\n";
  scripts += plotly_js();
  scripts += "\n</script>\n<script id=\"data\" type=\"application/json\">";
  scripts += for_script(data.dump());
  scripts += "</script>\n<script id=\"scripts\">\n";
  scripts += live ? report_js() : still_js();
  scripts += "\n</script>";
  std::string css(report_css());
  if (live) css += player_css();
  // The player's two sides.
  const nlohmann::json places = {{{"place", 0}, {"which", "first"}},
                                 {{"place", 1}, {"which", "second"}}};
  return {{"places", places},
          {"names", head.names},
          {"topic", head.topic},
          {"heading", head.heading},
          {"version", program_version()},
          {"css", std::move(css)},
          {"scripts", std::move(scripts)}};
}

std::string fill_page(std::string_view html, const nlohmann::json& values) {
  return fill_template(html, values,
                       {{"head", head_html()},
                        {"foot", foot_html()},
                        {"cards", cards_html()},
                        {"map", map_html()},
                        {"figures", figures_html()},
                        {"plots", plots_html()},
                        {"player", player_html()},
                        {"transport", transport_html()},
                        {"contents", contents_html()},
                        {"rotor", rotor_html()}});
}

}  // namespace rotorub
