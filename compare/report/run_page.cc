#include "compare/report/run_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/version.h"
#include "compare/report/assets.h"
#include "compare/report/contents.h"
#include "compare/report/page_frame.h"
#include "compare/report/plots.h"
#include "compare/report/rotor_section.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;

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

std::string run_page(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  const ShownRuns shown = shown_runs(run, shadow);
  RotorSection rotor = rotor_section(run.scene);
  json plots = plot_data(shown);
  plots["rotor"] = std::move(rotor.data);
  json values = page_frame({run.scene.name, "one run", run.scene.name},
                           {{"scenes", {std::move(plots)}}}, Pictures::kPlotsAndRig);
  values["id"] = "run";
  values["rotor"] = std::move(rotor.values);
  values["contents"] = run_contents("run");
  values["engine"] = engine_text(run.trajectory);
  values["ending"] = ending(run);
  values["ended_well"] = run.trajectory.status == Status::kOk;
  values.update(live_values(shown));
  values["conditions"] = facts(run, shadow);
  values["text"] = run.scene.text;
  return fill_page(run_html(), values);
}

}  // namespace rotorub
