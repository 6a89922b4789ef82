#include "compare/report/page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/version.h"
#include "compare/report/assets.h"
#include "compare/report/contents.h"
#include "compare/report/page_frame.h"
#include "compare/report/page_values.h"
#include "compare/report/plots.h"
#include "compare/report/rotor_section.h"
#include "compare/report/shown_runs.h"
#include "compare/report/trade.h"

namespace rotorub {
namespace {

using nlohmann::json;

json film_values(const std::vector<Film>& films) {
  json all = json::array();
  for (const Film& film : films) all.push_back({{"link", film.link}, {"caption", film.caption}});
  return all;
}

std::string names_of(const std::vector<PageScene>& scenes) {
  std::string names;
  for (const PageScene& scene : scenes) {
    if (!names.empty()) names += ", ";
    names += scene.comparison->scene.name;
  }
  return names;
}

}  // namespace

std::string report_page(const std::vector<PageScene>& scenes, const Beside& beside) {
  json pages = json::array();
  json plots = json::array(), parts = json::array();
  std::vector<const SceneComparison*> comparisons;
  for (const PageScene& scene : scenes) {
    const SceneComparison& comparison = *scene.comparison;
    json values = scene_values(comparison);
    values["index"] = pages.size();
    values["id"] = fmt::format("scene-{}", pages.size() + 1);
    values["has_films"] = !scene.films.empty();
    values["films"] = film_values(scene.films);
    values["no_films"] = scene.no_films;
    values["setting"] = scene.setting;
    const ShownRuns shown = shown_runs(comparison);
    values.update(live_values(shown));
    RotorSection rotor = rotor_section(comparison.scene);
    values["rotor"] = std::move(rotor.values);
    plots.push_back(plot_data(shown));
    plots.back()["rotor"] = std::move(rotor.data);
    parts.push_back(scene_contents(values));
    pages.push_back(std::move(values));
    comparisons.push_back(&comparison);
  }
  const double tolerance = scenes.empty() ? 0.0 : scenes.front().comparison->tolerance;
  const CompareMode mode =
      scenes.empty() ? CompareMode::kLockstep : scenes.front().comparison->mode;
  json values = page_frame({names_of(scenes), fmt::format("{} comparison", to_string(mode)),
                            "Can MuJoCo's contact forces be trusted?"},
                           {{"scenes", plots},
                            {"trade", trade_data(comparisons)},
                            {"benches", beside.benches},
                            {"maps", beside.maps}},
                           Pictures::kPlotsAndRig);
  values["contents"] = report_contents(parts, scenes.size() > 1, beside.values);
  values.update(beside.values);
  values["has_benches"] = !beside.benches.empty();
  values["has_maps"] = !beside.maps.empty();
  values["trades"] = scenes.size() > 1;
  values["by_figures"] = mode != CompareMode::kResync;
  values["resyncs"] = mode == CompareMode::kResync;
  values["mujoco_version"] = mujoco_version();
  values["tolerance"] = percent_text(tolerance);
  values["scenes"] = pages;
  return fill_page(report_html(), values);
}

}  // namespace rotorub
