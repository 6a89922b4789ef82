#include "compare/report/plots.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/report/characteristics.h"
#include "compare/report/rounded.h"
#include "compare/report/thin.h"
#include "native_model/bearing/actuator_axes.h"

namespace rotorub {
namespace {

using nlohmann::json;
using Values = std::vector<double>;

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kMicro = 1e6;

json pick(const Values& values, const std::vector<std::size_t>& rows, int digits) {
  json out = json::array();
  for (const std::size_t i : rows) out.push_back(rounded(values[i], digits));
  return out;
}

Values scaled(Values values, double factor) {
  for (double& v : values) v *= factor;
  return values;
}

// The twist at the contact: each torsion mode is 1 there.
Values torsion(const Trajectory& t) {
  Values sum(t.rows(), 0.0);
  for (int k = 1; t.has("torsion_" + std::to_string(k)); ++k) {
    const Values& mode = t.column("torsion_" + std::to_string(k));
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += mode[i];
  }
  return scaled(std::move(sum), 1e3);
}

Values magnitude(const Values& x, const Values& y) {
  Values r(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) r[i] = std::hypot(x[i], y[i]);
  return r;
}

// The values of a plot over time in its unit; empty where the run has none.
Values series_of(const std::string& key, const Trajectory& t) {
  if (key == "gap") return scaled(t.column("gap"), kMicro);
  if (key == "gap_rate") return scaled(t.column("gap_rate"), 1e3);
  if (key == "rotor_x") return scaled(t.column("rotor_x"), kMicro);
  if (key == "normal_force" || key == "friction_force") return t.column(key);
  if (key == "spin") return scaled(t.column("spin_speed"), 60.0 / kTurn);
  if (key == "ring_speed" && t.has("ring_speed")) {
    return scaled(t.column("ring_speed"), 60.0 / kTurn);
  }
  if (key == "torsion" && t.has("torsion_1")) return torsion(t);
  if (key == "control" && t.has("control_x")) {
    return magnitude(t.column("control_x"), t.column("control_y"));
  }
  if (key == "current" && t.has("current_1")) {
    return magnitude(t.column("current_1"), t.column("current_2"));
  }
  return {};
}

bool touches(const scene::Scene& scene, const Trajectory&) { return scene.contact.has_value(); }
bool rubs(const scene::Scene& scene, const Trajectory&) { return scene.contact && scene.contact->friction > 0.0; }
bool has_currents(const scene::Scene&, const Trajectory& t) { return t.has("current_1"); }
bool has_motor(const scene::Scene&, const Trajectory& t) { return t.has("motor_torque"); }

constexpr PlotKind kKinds[] = {
    {"gap", "Gap", "µm", "0: contact; below 0: penetration", "wide"},
    {"gap_rate", "Gap rate", "mm/s", "what control brings to 0 (paper, Fig. 8)", ""},
    {"rotor_x", "Rotor", "µm", "along x; dotted, where there is control: without it (paper, Fig. 9)", ""},
    {"normal_force", "Normal force", "N",
     "of lasting contact; impulses of the rigid law's impacts are below", ""},
    {"friction_force", "Friction force", "N", "on the rotor, along the ring", ""},
    {"impacts", "Impacts", "mN s", "normal impulse of each impact or contact episode", "", PlotOver::kImpacts, touches},
    {"friction_impacts", "Friction of impacts", "mN s", "size of the tangential impulse of each", "",
     PlotOver::kImpacts, rubs},
    {"normal_law", "Normal contact law", "m/s",
     "gap rates before and after each impact; dashed: the restitution where friction has no part", "square",
     PlotOver::kLaw, touches},
    {"friction_law", "Friction law", "",
     "of each impact, tangential over friction times normal impulse (paper, Fig. 5); dashed: Coulomb's", "square",
     PlotOver::kLaw, rubs},
    {"spin", "Spin speed", "rpm", "what friction takes from the drive", ""},
    {"ring_speed", "Ring speed", "rpm", "what friction and drag make of the ring that turns", ""},
    {"torsion", "Torsion", "mrad", "twist of the shaft at the contact", ""},
    {"control", "Control force", "N", "magnitude of the actuators' force on the ring", ""},
    {"current", "Coil current", "A", "magnitude of the control currents of the two axes", ""},
    {"actuator", "Actuator", "N", "force of axis 1 over its current, on the characteristic F(s, i) (paper, Fig. 3)",
     "square", PlotOver::kPath, has_currents},
    {"motor", "Motor", "N m", "torque over speed; dashed: the motor's characteristic (paper, Fig. 6)", "square",
     PlotOver::kPath, has_motor},
    {"orbit", "Orbits", "µm", "rotor solid, ring dotted; the last turns, or the time zoomed to", "square",
     PlotOver::kTurns},
    {"relative", "Rotor in the ring", "µm", "relative to the ring's centre; dashed: the clearance", "square",
     PlotOver::kTurns},
};

struct Rows {
  std::size_t first, last;
};

Rows rows_of(const Values& t, const Window& window) {
  const auto first = std::lower_bound(t.begin(), t.end(), window.from);
  const auto last = std::upper_bound(first, t.end(), window.to);
  return {static_cast<std::size_t>(first - t.begin()), static_cast<std::size_t>(last - t.begin())};
}

json time_series(const Values& t, const Values& y, const std::vector<Window>& windows) {
  json out = json::array();
  for (const Window& window : windows) {
    const auto [first, last] = rows_of(t, window);
    const auto kept = thin(y, first, last, kPlotBuckets);
    out.push_back({{"t", pick(t, kept, 8)}, {"y", pick(y, kept, 6)}});
  }
  return out;
}

enum class WholeRun { kShown, kLeftOut };

// kLeftOut: nothing for the whole run, which is the first window, where all turns on top of each other show
// nothing.
json curves(const Values& t, const Values& x, const Values& y, const std::vector<Window>& windows,
            WholeRun whole = WholeRun::kLeftOut) {
  json out = json::array();
  for (std::size_t k = 0; k < windows.size(); ++k) {
    if (k == 0 && whole == WholeRun::kLeftOut) {
      out.push_back(nullptr);
      continue;
    }
    const Window& window = windows[k];
    const auto [first, last] = rows_of(t, window);
    const auto kept = thin_curve(x, y, first, last, kPlotBuckets / 2);
    out.push_back({{"x", pick(x, kept, 6)}, {"y", pick(y, kept, 6)}});
  }
  return out;
}

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
    share.push_back(friction > 0.0 ? impact.friction_impulse / (friction * impact.normal_impulse) : 0.0);
  }
  const auto kept = thin(normal, 0, normal.size(), kPlotBuckets);
  return {{"t", pick(t, kept, 8)},          {"y", pick(normal, kept, 5)},
          {"friction", pick(tangential, kept, 5)}, {"before", pick(before, kept, 5)},
          {"after", pick(after, kept, 5)},  {"slip", pick(slip, kept, 5)},
          {"share", pick(share, kept, 5)}};
}

json side_data(const Side& side, const std::vector<PlotKind>& kinds,
               const std::vector<Window>& windows, double friction) {
  const Trajectory& trajectory = side.trajectory;
  const Values& t = trajectory.column("t");
  json series = json::object();
  for (const PlotKind& kind : kinds) {
    if (kind.over != PlotOver::kTime) continue;
    const Values y = series_of(kind.key, trajectory);
    if (!y.empty()) series[kind.key] = time_series(t, y, windows);
  }
  const Values rotor_x = scaled(trajectory.column("rotor_x"), kMicro);
  const Values rotor_y = scaled(trajectory.column("rotor_y"), kMicro);
  const Values ring_x = scaled(trajectory.column("stator_x"), kMicro);
  const Values ring_y = scaled(trajectory.column("stator_y"), kMicro);
  Values x(t.size()), y(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) {
    x[i] = rotor_x[i] - ring_x[i];
    y[i] = rotor_y[i] - ring_y[i];
  }
  json more = json::object();
  if (trajectory.has("current_1")) {
    Values force = trajectory.column("control_x");
    const Values& across = trajectory.column("control_y");
    for (std::size_t i = 0; i < force.size(); ++i) force[i] = to_axes({force[i], across[i]}).x();
    more["actuator"] = curves(t, trajectory.column("current_1"), force, windows, WholeRun::kShown);
  }
  if (trajectory.has("motor_torque")) {
    more["motor"] = curves(t, series_of("spin", trajectory), trajectory.column("motor_torque"), windows,
                           WholeRun::kShown);
  }
  return {{"label", side.label},
          {"series", series},
          {"paths", more},
          {"rotor", curves(t, rotor_x, rotor_y, windows)},
          {"ring", curves(t, ring_x, ring_y, windows)},
          {"relative", curves(t, x, y, windows)},
          {"impacts", impact_data(trajectory, friction)}};
}

}  // namespace

const char* to_string(PlotOver over) {
  switch (over) {
    case PlotOver::kTime: return "time";
    case PlotOver::kImpacts: return "impacts";
    case PlotOver::kLaw: return "law";
    case PlotOver::kPath: return "path";
    case PlotOver::kTurns: return "turns";
  }
  return "";
}

std::vector<Window> plot_windows(const SceneComparison& comparison) {
  const scene::Scene& scene = comparison.scene;
  const double end = scene.run.end;
  const double speed = std::abs(scene.rotor.speed);
  const double turn = speed > 0.0 ? std::min(kTurn / speed, end) : 0.05 * end;

  std::vector<Window> windows{{"whole run", 0.0, end}};
  double touch = end;
  for (const Side& side : comparison.sides) {
    touch = std::min(touch, side.metrics.first_touch.value_or(end));
  }
  if (touch < end) {
    windows.push_back(
        {"first contact", std::max(0.0, touch - 0.1 * turn), std::min(end, touch + turn)});
  }
  windows.push_back({"last turns", std::max(0.0, end - 2.0 * turn), end});
  return windows;
}

std::vector<PlotKind> plot_kinds(const SceneComparison& comparison) {
  std::vector<PlotKind> kinds;
  for (const PlotKind& kind : kKinds) {
    const bool has_data =
        std::any_of(comparison.sides.begin(), comparison.sides.end(), [&](const Side& side) {
          if (kind.shown) return kind.shown(comparison.scene, side.trajectory);
          return kind.over != PlotOver::kTime || !series_of(kind.key, side.trajectory).empty();
        });
    if (has_data) kinds.push_back(kind);
  }
  return kinds;
}

json plot_data(const SceneComparison& comparison) {
  const auto windows = plot_windows(comparison);
  const auto kinds = plot_kinds(comparison);
  json sides = json::array();
  const auto& contact = comparison.scene.contact;
  const double friction = contact ? contact->friction : 0.0;
  for (const Side& side : comparison.sides) sides.push_back(side_data(side, kinds, windows, friction));
  json spans = json::array();
  for (const Window& w : windows) {
    spans.push_back({{"name", w.name}, {"from", w.from}, {"to", w.to}});
  }
  json uncontrolled = json::object();
  if (const auto& run = comparison.uncontrolled) {
    uncontrolled["rotor_x"] = time_series(run->column("t"), series_of("rotor_x", *run), windows);
  }
  const Values& speed = comparison.sides.front().trajectory.column("spin_speed");
  const auto [slowest, fastest] = std::minmax_element(speed.begin(), speed.end());
  const double room = std::max(0.02 * std::abs(*fastest), 0.2 * (*fastest - *slowest));
  return {{"name", comparison.scene.name},
          {"actuator", actuator_curves(comparison.scene)},
          {"motor", motor_curve(comparison.scene, *slowest - room, *fastest + room)},
          {"clearance", contact ? contact->clearance : 0.0},
          {"restitution", contact ? contact->restitution : 0.0},
          {"uncontrolled", uncontrolled},
          {"windows", spans},
          {"first_window", 0},
          {"sides", sides}};
}

}  // namespace rotorub
