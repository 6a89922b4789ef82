#include "compare/report/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/algorithm/string/replace.hpp>

#include "compare/base/plot_points.h"
#include "compare/base/version.h"
#include "compare/modes/page_data.h"
#include "compare/report/assets.h"
#include "compare/report/plots.h"
#include "compare/report/what_if.h"
#include "compare/run_files/summary.h"
#include "compare/study/result.h"
#include "native_model/scene/reader.h"

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

// The scene, the data of its plots and player, its free rotor, its sliders, and the result of its
// runs as parts and as JSON.
json scene_data(const ShownRuns& shown, const result::Section& found) {
  const scene::Scene& scene = *shown.scene;
  json data = plot_data(shown);
  data.update({{"hash", scene::scene_hash(scene)},
               {"step", scene.run.step},
               {"end", scene.run.end},
               {"text", scene.text},
               {"rotor", rotor_data(scene)},
               {"what_if", what_if_data(scene)},
               {"parts", page_json(found)},
               {"found", json_of(found)}});
  return data;
}

json versions() { return {{"rotorub", program_version()}, {"MuJoCo", mujoco_version()}}; }

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

std::string report_page(const std::vector<PageScene>& scenes, const Beside& beside) {
  const SceneComparison* first = scenes.empty() ? nullptr : scenes.front().comparison;
  json data{{"scenes", json::array()},
            {"versions", versions()},
            {"mode", to_string(first ? first->mode : CompareMode::kLockstep)},
            {"tolerance", first ? first->tolerance : 0.0},
            {"benches", beside.benches},
            {"cases", beside.cases},
            {"sweeps", beside.sweeps}};
  std::vector<std::string> names;
  result::Section found;
  for (const PageScene& scene : scenes) {
    result::Section compared = comparison_result(*scene.comparison);
    json shown = scene_data(shown_runs(*scene.comparison), compared);
    shown.update(
        {{"films", scene.films}, {"no_films", scene.no_films}, {"setting", scene.setting}});
    data["scenes"].push_back(std::move(shown));
    names.push_back(scene.comparison->scene.name);
    found.add({std::move(compared)});
  }
  return page_of("report", fmt::format("{}", fmt::join(names, ", ")), found, std::move(data));
}

std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  const result::Section found = kept_result(run.summary);
  json scene = scene_data(shown_runs(run, shadow), found);
  scene["found"] = run.summary;
  return page_of("run", run.scene.name, found,
                 {{"scenes", json::array({std::move(scene)})}, {"versions", versions()}});
}

}  // namespace rotorub
