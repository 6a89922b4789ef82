#include "compare/report/plots.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/report/measured_side.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/plot_points.h"
#include "compare/report/rig_values.h"
#include "compare/report/run_data.h"
#include "compare/report/whirl_plots.h"

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

constexpr double kTurn = 2.0 * std::numbers::pi;

// A part of the run to which the page can zoom.
struct Window {
  std::string name;
  double from = 0.0, to = 0.0;  // s
};

// The whole run; the first contact (from a tenth of a turn before to one turn after the first touch
// of any run); the last two turns. Without a contact only the whole run and its end.
std::vector<Window> plot_windows(const ShownRuns& shown) {
  const scene::Scene& scene = *shown.scene;
  const double end = scene.run.end;
  const double speed = std::abs(scene.rotor.speed);
  const double turn = speed > 0.0 ? std::min(kTurn / speed, end) : 0.05 * end;

  std::vector<Window> windows{{"whole run", 0.0, end}};
  double touch = end;
  for (const ShownRun& run : shown.runs) {
    touch = std::min(touch, renders::first_touch(*run.trajectory).value_or(end));
  }
  if (touch < end) {
    windows.push_back(
        {"first touch", std::max(0.0, touch - 0.1 * turn), std::min(end, touch + turn)});
  }
  windows.push_back({"last turns", std::max(0.0, end - 2.0 * turn), end});
  return windows;
}

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
          {"windows", list_of(plot_windows(shown),
                              [](const Window& w) -> json {
                                return {{"name", w.name}, {"from", w.from}, {"to", w.to}};
                              })},
          {"first_window", 0},
          {"rig", machine ? rig_values(scene, *machine) : json()},
          {"contacts", contacts_values(scene, machine)},
          {"sides", sides}};
}

}  // namespace rotorub
