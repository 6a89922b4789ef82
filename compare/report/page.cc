#include "compare/report/page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/plot_points.h"
#include "compare/base/version.h"
#include "compare/modes/page_data.h"
#include "compare/report/page_frame.h"
#include "compare/report/plots.h"
#include "compare/report/what_if.h"
#include "compare/run_files/summary.h"
#include "compare/study/result.h"
#include "native_model/scene/reader.h"

namespace rotorub {

namespace {

using nlohmann::json;

// The scene, the data of its plots and player, its free rotor, and its sliders.
json live_data(const ShownRuns& shown) {
  const scene::Scene& scene = *shown.scene;
  json data = plot_data(shown);
  data.update({{"hash", scene::scene_hash(scene)},
               {"step", scene.run.step},
               {"end", scene.run.end},
               {"text", scene.text},
               {"rotor", rotor_data(scene)},
               {"what_if", what_if_data(scene)}});
  return data;
}

std::string ending(const StoredRun& run) {
  const Trajectory& t = run.trajectory;
  if (t.status == Status::kOk) return fmt::format("{} simulated", time_text(t.end));
  return fmt::format("ended at {} of {}: {}{}{}", time_text(t.end), time_text(run.scene.run.end),
                     to_string(t.status), t.message.empty() ? "" : ", ", t.message);
}

json versions() { return {{"rotorub", program_version()}, {"MuJoCo", mujoco_version()}}; }

}  // namespace

std::string report_page(const std::vector<PageScene>& scenes, const Beside& beside) {
  json data{{"scenes", json::array()},
            {"versions", versions()},
            {"benches", beside.benches},
            {"cases", beside.cases},
            {"sweeps", beside.sweeps}};
  std::vector<std::string> names;
  result::Section found;
  for (const PageScene& scene : scenes) {
    const SceneComparison& c = *scene.comparison;
    result::Section compared = comparison_result(c);
    json& shown = data["scenes"].emplace_back(live_data(shown_runs(c)));
    shown["parts"] = page_json(compared);
    const json all = json_of(compared);
    for (const auto& [label, model] : all.at("differences").items())
      shown["impacts"][label] = model.at("impacts");
    shown["summary"] = all.at("runs").at(c.native.label).at("metrics");
    shown["twins"] = c.twins;
    shown["films"] = list_of(scene.films, [](const Film& film) -> json {
      return {{"link", film.link}, {"caption", film.caption}};
    });
    shown["no_films"] = scene.no_films;
    shown["setting"] = scene.setting;
    names.push_back(c.scene.name);
    found.add({std::move(compared)});
  }
  const SceneComparison* first = scenes.empty() ? nullptr : scenes.front().comparison;
  data["mode"] = to_string(first ? first->mode : CompareMode::kLockstep);
  data["tolerance"] = first ? first->tolerance : 0.0;
  return page_of("report", fmt::format("{}", fmt::join(names, ", ")), found, std::move(data));
}

std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  const bool ok = run.trajectory.status == Status::kOk;
  const result::Section found = kept_result(run.summary);
  json scene = live_data(shown_runs(run, shadow));
  scene["parts"] = page_json(found);
  scene["summary"] = run.summary;
  return page_of("run", run.scene.name, found,
                 {{"scenes", json::array({std::move(scene)})},
                  {"versions", versions()},
                  {"ending", {{"text", ending(run)}, {"tone", ok ? "" : "bad"}}}});
}

}  // namespace rotorub
