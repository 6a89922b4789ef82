#include "compare/report/plots.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/report/characteristics.h"
#include "compare/report/measured_side.h"
#include "compare/report/pack/packed_run.h"
#include "compare/report/rig_values.h"
#include "compare/report/rounded.h"
#include "compare/report/thin.h"
#include "compare/report/whirl_plots.h"

namespace rotorub {
namespace {

using nlohmann::json;
using Values = std::vector<double>;

constexpr double kTurn = 2.0 * std::numbers::pi;

bool touches(const ShownRuns& s, const Trajectory&) { return s.scene->first().contact.has_value(); }
bool rubs(const ShownRuns& s, const Trajectory&) {
  return s.scene->first().contact && !s.scene->first().contact->friction.none();
}
bool has_currents(const ShownRuns&, const Trajectory& t) { return t.has("current_1"); }
bool has_control(const ShownRuns&, const Trajectory& t) { return t.has("control_x"); }
bool has_torsion(const ShownRuns&, const Trajectory& t) { return t.has("torsion_1"); }
bool has_ring_speed(const ShownRuns&, const Trajectory& t) { return t.has("ring_speed"); }
bool has_measured_force(const ShownRuns& s, const Trajectory&) {
  return s.measured && !s.measured->forces.empty();
}
bool is_compared(const ShownRuns& s, const Trajectory&) { return s.runs.size() > 1; }
bool turns(const ShownRuns&, const Trajectory& t) { return mean_spin(t) != 0.0; }
bool is_sampled(const ShownRuns&, const Trajectory& t) { return t.rows() >= kLeastSpectrumRows; }
bool has_motor(const ShownRuns&, const Trajectory& t) { return t.has("motor_torque"); }

constexpr PlotKind kKinds[] = {
    {"gap", "Gap", "µm", "0: contact; below 0: penetration", "wide", PlotOver::kTime, touches},
    {"gap_rate", "Gap rate", "mm/s", "what control brings to 0 (paper, Fig. 8)", "",
     PlotOver::kTime, touches},
    {"rotor_x", "Rotor", "µm",
     "along x; dotted, where there is control: without it (paper, Fig. 9)", ""},
    {"normal_force", "Normal force", "N",
     "of lasting contact; impulses of the rigid law's impacts are below", "", PlotOver::kTime,
     touches},
    {"sample_force", "Force of a sample", "N",
     "what the force sensor sees: of every run averaged over the record's samples, impacts "
     "included",
     "wide", PlotOver::kTime, has_measured_force},
    {"friction_force", "Friction force", "N", "on the rotor, along the ring", "", PlotOver::kTime,
     touches},
    {"impacts", "Impacts", "mN s", "normal impulse of each impact or contact episode", "",
     PlotOver::kImpacts, touches},
    {"friction_impacts", "Friction of impacts", "mN s", "size of the tangential impulse of each",
     "", PlotOver::kImpacts, rubs},
    {"normal_law", "Normal contact law", "m/s",
     "gap rates before and after each impact; dashed: the restitution where friction has no part",
     "square", PlotOver::kLaw, touches},
    {"friction_law", "Friction law", "",
     "of each impact, tangential over friction times normal impulse (paper, Fig. 5); dashed: "
     "Coulomb's",
     "square", PlotOver::kLaw, rubs},
    {"spin", "Spin speed", "rpm", "what friction takes from the drive", ""},
    {"ring_speed", "Ring speed", "rpm", "what friction and drag make of the ring that turns", "",
     PlotOver::kTime, has_ring_speed},
    {"torsion", "Torsion", "mrad", "twist of the shaft at the contact", "", PlotOver::kTime,
     has_torsion},
    {"control", "Control force", "N", "magnitude of the actuators' force on the ring", "",
     PlotOver::kTime, has_control},
    {"current", "Coil current", "A", "magnitude of the control currents of the two axes", "",
     PlotOver::kTime, has_currents},
    {"actuator", "Actuator", "N",
     "force of axis 1 over its current, on the characteristic F(s, i) (paper, Fig. 3)", "square",
     PlotOver::kPath, has_currents},
    {"motor", "Motor", "N m",
     "torque over speed; dashed: the motor's characteristic (paper, Fig. 6)", "square",
     PlotOver::kPath, has_motor},
    {"orbit", "Orbits", "µm", "rotor solid, ring dotted; the last turns, or the time zoomed to",
     "square", PlotOver::kTurns},
    {"relative", "Rotor in the ring", "µm", "relative to the ring's centre; dashed: the clearance",
     "square", PlotOver::kTurns, touches},
    {"residual", "Away from the first run", "µm",
     "distance of a run's rotor from the first run's; in chaos it grows to the orbit's size", "",
     PlotOver::kTime, is_compared},
    {"spectrum", "Full spectrum", "µm",
     "of the second half: forward whirl above 0 Hz, backward below; dashed: the spin", "",
     PlotOver::kWhirl, is_sampled},
    {"waterfall", "Waterfall", "µm", "the full spectrum over the run, of the first run shown", "",
     PlotOver::kWhirl, is_sampled},
    {"poincare", "Poincaré points", "µm",
     "the rotor once a turn, second half: a point is synchronous, a cloud chaos", "square",
     PlotOver::kWhirl, turns},
};

// friction: of the contact, mu.
json impact_data(const Trajectory& trajectory, double friction) {
  Values t, normal, tangential, before, after, slip, share;
  for (const Impact& impact : trajectory.impacts) {
    if (!counts(impact) || impact.normal_impulse <= 0.0) continue;
    t.push_back(impact.t);
    normal.push_back(1e3 * impact.normal_impulse);
    tangential.push_back(1e3 * std::abs(impact.friction_impulse));
    before.push_back(impact.gap_rate_before);
    after.push_back(impact.gap_rate_after);
    slip.push_back(impact.slip_after);
    share.push_back(friction > 0.0 ? impact.friction_impulse / (friction * impact.normal_impulse)
                                   : 0.0);
  }
  const auto kept = thin(normal, 0, normal.size(), kPlotBuckets);
  return {{"t", picked(t, kept, 8)},
          {"y", picked(normal, kept, 5)},
          {"friction", picked(tangential, kept, 5)},
          {"before", picked(before, kept, 5)},
          {"after", picked(after, kept, 5)},
          {"slip", picked(slip, kept, 5)},
          {"share", picked(share, kept, 5)}};
}

// The motor's characteristic about the speeds that the first run goes through.
json motor_data(const scene::Scene& scene, const Trajectory& run) {
  const Values& speed = run.column("spin_speed");
  if (speed.empty()) return nullptr;
  const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
  const double room = std::max(0.02 * std::abs(*fastest), 0.2 * (*fastest - *slowest));
  return motor_curve(scene, *slowest - room, *fastest + room);
}

}  // namespace

const char* to_string(PlotOver over) {
  switch (over) {
    case PlotOver::kTime:
      return "time";
    case PlotOver::kImpacts:
      return "impacts";
    case PlotOver::kLaw:
      return "law";
    case PlotOver::kPath:
      return "path";
    case PlotOver::kTurns:
      return "turns";
    case PlotOver::kWhirl:
      return "whirl";
  }
  return "";
}

std::vector<Window> plot_windows(const ShownRuns& shown) {
  const scene::Scene& scene = *shown.scene;
  const double end = scene.run.end;
  const double speed = std::abs(scene.rotor.speed);
  const double turn = speed > 0.0 ? std::min(kTurn / speed, end) : 0.05 * end;

  std::vector<Window> windows{{"whole run", 0.0, end}};
  double touch = end;
  for (const ShownRun& run : shown.runs) {
    touch = std::min(touch, first_touch(*run.trajectory).value_or(end));
  }
  if (touch < end) {
    windows.push_back(
        {"first contact", std::max(0.0, touch - 0.1 * turn), std::min(end, touch + turn)});
  }
  windows.push_back({"last turns", std::max(0.0, end - 2.0 * turn), end});
  return windows;
}

std::vector<PlotKind> plot_kinds(const ShownRuns& shown) {
  std::vector<PlotKind> kinds;
  for (const PlotKind& kind : kKinds) {
    const bool has_data =
        std::any_of(shown.runs.begin(), shown.runs.end(), [&](const ShownRun& run) {
          return run.trajectory->rows() > 0 && (!kind.shown || kind.shown(shown, *run.trajectory));
        });
    if (has_data) kinds.push_back(kind);
  }
  return kinds;
}

json plot_data(const ShownRuns& shown) {
  const scene::Scene& scene = *shown.scene;
  const auto& contact = scene.first().contact;
  const std::optional<renders::Machine> machine = drawn_machine(shown);
  json sides = json::array();
  const double limit = shown_frequency(shown);
  for (const ShownRun& run : shown.runs) {
    const bool has_rows = machine && run.trajectory->rows() > 0;
    sides.push_back(
        {{"label", run.label},
         {"end", run.trajectory->end},
         {"status", to_string(run.trajectory->status)},
         {"tracks",
          packed_run_json(has_rows ? pack_run(scene, *machine, *run.trajectory) : PackedRun())},
         {"whirl",
          whirl_data(*run.trajectory,
                     &run == &shown.runs.front() ? nullptr : shown.runs.front().trajectory, limit)},
         {"impacts", impact_data(*run.trajectory, contact ? contact->friction.sticking() : 0.0)}});
  }
  for (std::size_t k = 0; k < shown.runs.size(); ++k) {
    if (json force = sampled_force(shown, k); !force.is_null())
      sides[k]["tracks"]["force"] = std::move(force);
  }
  if (shown.measured && machine) sides.push_back(measured_side(shown, limit));
  json spans = json::array();
  for (const Window& w : plot_windows(shown)) {
    spans.push_back({{"name", w.name}, {"from", w.from}, {"to", w.to}});
  }
  json uncontrolled = nullptr;
  if (shown.uncontrolled && shown.uncontrolled->rows() > 0 && machine) {
    uncontrolled = {
        {"rotor", track_json(pack_run(scene, *machine, *shown.uncontrolled).at("rotor"))}};
  }
  return {
      {"name", scene.name},
      {"actuator", actuator_curves(scene)},
      {"motor", shown.runs.empty() ? json() : motor_data(scene, *shown.runs.front().trajectory)},
      {"spin", shown.runs.empty() ? 0.0 : mean_spin(*shown.runs.front().trajectory)},
      {"clearance", contact ? contact->clearance : 0.0},
      {"restitution", contact ? contact->restitution : 0.0},
      {"uncontrolled", uncontrolled},
      {"windows", spans},
      {"first_window", 0},
      {"rig", machine ? rig_values(scene, *machine) : json()},
      {"sides", sides}};
}

json plot_values(const ShownRuns& shown) {
  json all = json::array();
  for (const PlotKind& kind : plot_kinds(shown)) {
    all.push_back({{"key", kind.key},
                   {"title", kind.title},
                   {"unit", kind.unit},
                   {"text", kind.text},
                   {"shape", kind.shape},
                   {"over", to_string(kind.over)}});
  }
  return all;
}

json window_values(const ShownRuns& shown) {
  json all = json::array();
  for (const Window& window : plot_windows(shown)) {
    all.push_back({{"index", all.size()}, {"name", window.name}});
  }
  return all;
}

json legend_values(const ShownRuns& shown) {
  json all = json::array();
  for (const ShownRun& run : shown.runs) all.push_back({{"label", run.label}});
  if (shown.measured) all.push_back({{"label", kMeasured}});
  return all;
}

}  // namespace rotorub
