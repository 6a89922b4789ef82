#include "compare/report/page_frame.h"

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/base/plot_points.h"
#include "compare/base/version.h"
#include "compare/report/assets.h"
#include "compare/report/what_if.h"
#include "compare/result/result.h"

namespace rotorub {
namespace {

using boost::algorithm::replace_all_copy;
using nlohmann::json;

std::string escaped(const std::string& plain) {
  std::string text = replace_all_copy(plain, "&", "&amp;");
  for (const auto& [sign, name] : {std::pair{"<", "&lt;"}, {">", "&gt;"}, {"\"", "&quot;"}})
    text = replace_all_copy(text, sign, name);
  return text;
}

std::string script(const std::string& id, std::string_view text) {
  return "<script id=\"" + id + "\" type=\"text/plain\">" + std::string(text) + "</script>";
}

// The native model, if a scene has sliders that need it.
std::string module_scripts(const json& scenes) {
  const bool any =
      std::ranges::any_of(scenes, [](const json& scene) { return !scene.at("what_if").is_null(); });
  if (!any) return "";
  return script("native-module", native_module()) + script("native-worker", native_worker_js());
}

}  // namespace

std::string filled(std::string_view frame, const std::map<std::string, std::string>& values) {
  std::string page;
  for (std::size_t name; (name = frame.find("{{")) != std::string_view::npos;) {
    const std::size_t end = frame.find("}}", name);
    page += frame.substr(0, name);
    page += values.at(std::string(frame.substr(name + 2, end - name - 2)));
    frame.remove_prefix(end + 2);
  }
  return page.append(frame);
}

std::string page_of(const std::string& kind, const std::string& names, const result::Section& found,
                    json data) {
  const bool live = data.contains("scenes");
  data["page"] = {{"kind", kind}, {"names", names}};
  if (!live) data["page"].update({{"parts", page_json(found)}, {"found", json_of(found)}});
  return filled(page_html(),
                {{"names", escaped(names)},
                 {"version", program_version()},
                 {"css", std::string(report_css()) + std::string(live ? player_css() : "")},
                 {"text", escaped(text_of(found))},
                 // The page's script unpacks and starts it after the page is drawn.
                 {"plotly", base64(packed_plotly_js())},
                 {"module", live ? module_scripts(data.at("scenes")) : ""},
                 // "<" could end the script element with the data.
                 {"data", replace_all_copy(shortened(data).dump(), "<", "\\u003c")},
                 {"scripts", std::string(live ? report_js() : still_js())}});
}

}  // namespace rotorub
