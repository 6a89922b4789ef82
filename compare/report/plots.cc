#include "compare/report/plots.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/report/measured_side.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/plot_points.h"
#include "compare/report/rig_values.h"
#include "compare/report/run_data.h"
#include "compare/report/whirl_plots.h"
#include "renders/playback.h"

namespace rotorub {

ShownRuns shown_runs(const SceneComparison& comparison) {
  ShownRuns shown{&comparison.scene, {}, nullptr, nullptr};
  for (const Side* side : comparison.sides())
    shown.runs.push_back({side->label, &side->trajectory});
  if (comparison.measured) shown.measured = &*comparison.measured;
  if (comparison.uncontrolled) shown.uncontrolled = &*comparison.uncontrolled;
  return shown;
}

ShownRuns shown_runs(const StoredRun& run, const std::optional<StoredRun>& shadow) {
  const Trajectory& t = run.trajectory;
  ShownRuns shown{
      &run.scene, {{t.engine == "mujoco" ? t.contact_model : "native", &t}}, nullptr, nullptr};
  if (shadow) shown.runs.push_back({"shadow", &shadow->trajectory});
  return shown;
}

namespace {

using nlohmann::json;
using Values = std::vector<double>;

// The motor's characteristic around the speeds of the first run.
json motor_data(const scene::Scene& scene, const Trajectory& run) {
  const Values& speed = run.column("spin_speed");
  if (speed.empty()) return nullptr;
  const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
  const double room = std::max(0.02 * std::abs(*fastest), 0.2 * (*fastest - *slowest));
  return motor_curve(scene, *slowest - room, *fastest + room);
}

}  // namespace

json plot_data(const ShownRuns& shown) {
  const scene::Scene& scene = *shown.scene;
  const std::optional<renders::Machine> machine = drawn_machine(shown);
  json sides = json::array();
  double limit = 0.0;  // Hz, for all spectra
  for (const ShownRun& run : shown.runs) limit = std::max(limit, spectrum_reach(*run.trajectory));
  for (const ShownRun& run : shown.runs) {
    const Trajectory* first = shown.runs.front().trajectory;
    json& side = sides.emplace_back(run_data(scene, run.label, *run.trajectory,
                                             run.trajectory == first ? nullptr : first,
                                             machine ? &*machine : nullptr, limit));
    side["first_touch"] = number_or_null(renders::first_touch(*run.trajectory));
    json force = sampled_force(shown, run.label);
    if (!force.is_null()) side["tracks"]["force"] = std::move(force);
  }
  if (shown.measured && machine) sides.push_back(measured_side(shown, limit));
  json uncontrolled = nullptr;
  if (shown.uncontrolled && shown.uncontrolled->rows() > 0 && machine) {
    uncontrolled = {
        {"rotor", track_json(pack_run(scene, *machine, *shown.uncontrolled).at("rotor"))}};
  }
  const Trajectory* first = shown.runs.empty() ? nullptr : shown.runs.front().trajectory;
  return {{"name", scene.name},
          {"motor", first ? motor_data(scene, *first) : json()},
          {"spin", first ? mean_spin(*first) : 0.0},
          {"uncontrolled", uncontrolled},
          {"speed", scene.rotor.speed},
          {"rig", machine ? rig_values(scene, *machine) : json()},
          {"contacts", contacts_values(scene, machine)},
          {"sides", sides}};
}

}  // namespace rotorub
