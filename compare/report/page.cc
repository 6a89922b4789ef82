#include "compare/report/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/version.h"
#include "compare/report/assets.h"
#include "compare/report/modes_page.h"
#include "compare/report/page_frame.h"
#include "compare/report/page_values.h"
#include "compare/report/plot_points.h"
#include "compare/report/plots.h"
#include "compare/report/what_if.h"
#include "native_model/scene/reader.h"

namespace rotorub {

namespace {

using nlohmann::json;

// The data of a scene's plots, player and free rotor for the scripts. Adds the values for the
// template.
json live_part(const ShownRuns& shown, json& values) {
  values.update(live_values(shown));
  json data = plot_data(shown);
  data["rotor"] = rotor_section(*shown.scene);
  data["what_if"] = what_if_data(*shown.scene);
  values["what_if"] = data["what_if"].is_null() ? json::array() : json::array({data["what_if"]});
  return data;
}

// The page's frame; if a scene has sliders, also the native module that they need.
json live_frame(const PageHead& head, const json& data) {
  json values = page_frame(head, data, Pictures::kPlotsAndRig);
  for (const json& scene : data.at("scenes")) {
    if (scene.at("what_if").is_null()) continue;
    values["has_module"] = true;
    values["native_module"] = native_module();
    values["native_worker"] = native_worker_js();
    break;
  }
  return values;
}

std::string engine_text(const Trajectory& t) {
  return fmt::format("{}, integrator {}, contact {}", t.engine, t.integrator, t.contact_model);
}

std::string ending(const StoredRun& run) {
  const Trajectory& t = run.trajectory;
  if (t.status == Status::kOk) return fmt::format("{} simulated", time_text(t.end));
  return fmt::format("ended at {} of {}: {}{}{}", time_text(t.end), time_text(run.scene.run.end),
                     to_string(t.status), t.message.empty() ? "" : ", ", t.message);
}

json facts(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  const Trajectory& t = run.trajectory;
  json rows = json::array();
  const auto add = [&](const char* name, const std::string& value) {
    rows.push_back({{"name", name}, {"value", value}});
  };
  add("rotorub", program_version());
  add("scene hash", scene::scene_hash(run.scene));
  add("run", engine_text(t));
  if (shadow) add("shadow", engine_text(shadow->trajectory));
  add("steps", fmt::format("{}", t.steps));
  if (t.step > 0.0) add("step", time_text(t.step));
  add("rows", fmt::format("{}", t.rows()));
  add("impacts", fmt::format("{}", t.impacts.size()));
  return rows;
}

}  // namespace

std::string report_page(const std::vector<PageScene>& scenes, const Beside& beside) {
  json pages = json::array(), plots = json::array();
  std::vector<std::string> names;
  std::vector<const SceneComparison*> comparisons;
  for (const PageScene& scene : scenes) {
    const SceneComparison& comparison = *scene.comparison;
    json values = scene_values(comparison);
    values["index"] = pages.size();
    values["id"] = fmt::format("scene-{}", pages.size() + 1);
    values["has_films"] = !scene.films.empty();
    values["films"] = list_of(scene.films, [](const Film& film) -> json {
      return {{"link", film.link}, {"caption", film.caption}};
    });
    values["no_films"] = scene.no_films;
    values["setting"] = scene.setting;
    plots.push_back(live_part(shown_runs(comparison), values));
    pages.push_back(std::move(values));
    names.push_back(comparison.scene.name);
    comparisons.push_back(&comparison);
  }
  const double tolerance = scenes.empty() ? 0.0 : scenes.front().comparison->tolerance;
  const CompareMode mode =
      scenes.empty() ? CompareMode::kLockstep : scenes.front().comparison->mode;
  json values = live_frame(
      {fmt::format("{}", fmt::join(names, ", ")), fmt::format("{} comparison", to_string(mode)),
       "Can MuJoCo's contact forces be trusted?"},
      {{"scenes", plots},
       {"trade", trade_data(comparisons)},
       {"beside", beside.parts},
       {"benches", beside.benches},
       {"maps", beside.maps}});
  values["has_benches"] = !beside.benches.empty();
  values["has_cases"] = !beside.parts.at("cases").empty();
  values["has_maps"] = !beside.maps.empty();
  values["trades"] = scenes.size() > 1;
  values["by_figures"] = mode != CompareMode::kResync;
  values["resyncs"] = mode == CompareMode::kResync;
  values["mujoco_version"] = mujoco_version();
  values["tolerance"] = percent_text(tolerance);
  values["scenes"] = pages;
  return fill_page(report_html(), values);
}

std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  json live = json::object();
  const json plots = live_part(shown_runs(run, shadow), live);
  json values =
      live_frame({run.scene.name, "one run", run.scene.name}, {{"scenes", json::array({plots})}});
  values.update(live);
  values["id"] = "run";
  values["engine"] = engine_text(run.trajectory);
  values["ending"] = ending(run);
  values["ended_well"] = run.trajectory.status == Status::kOk;
  values["conditions"] = facts(run, shadow);
  values["text"] = run.scene.text;
  return fill_page(run_html(), values);
}

}  // namespace rotorub
