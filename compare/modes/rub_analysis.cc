#include "compare/modes/rub_analysis.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/modes/rotor_analysis.h"
#include "native_model/linear/free_motion.h"
#include "native_model/model/linear_parts.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::RubPoint;
using rub::StandingRub;

std::vector<WhirlMode> whirls(const std::vector<rub::Complex>& eigenvalues) {
  constexpr double kReal = 1e-9;
  std::vector<WhirlMode> modes;
  for (const rub::Complex& s : eigenvalues) {
    const double size = std::abs(s);
    const bool real = std::abs(s.imag()) <= kReal * size;
    modes.push_back({real ? 0.0 : s.imag(), size > 0.0 ? -s.real() / size : 0.0});
  }
  sort_by_frequency(modes, [](const WhirlMode& mode) { return mode.frequency; });
  return modes;
}

std::string whirls_table(const char* title, const std::vector<WhirlMode>& modes, double speed) {
  std::string text = fmt::format("  {}\n", title);
  if (modes.empty()) text += "    nothing is left that can move\n";
  for (const WhirlMode& mode : modes) {
    const double size = std::abs(mode.frequency);
    text += fmt::format("    {:<12}{:>12.7g}{:>14.7g}{:>16.4g}\n", sense_of(mode, speed), size,
                        size * kHz, mode.damping_ratio);
  }
  return text;
}

// The parts of the scene that make the spin free or flexible: torsion, and a motor whose torque
// depends only on the speed.
std::optional<rub::DriveTrain> train_of(const scene::Scene& scene) {
  if (!scene.drive && !scene.rotor.torsion) return {};
  if (scene.drive && scene.drive->kind == scene::DriveKind::kSpeedControlled) return {};
  return rub::drive_train(scene);
}

// rad/s: the range of speeds, from <= 0 to >= 0, in which rolling that the motor sustains is
// searched.
std::pair<double, double> outermost_speeds(const scene::Scene& scene) {
  std::vector<double> speeds{0.0, scene.rotor.speed};
  if (scene.drive) {
    speeds.insert(speeds.end(), scene.drive->table_speed.begin(), scene.drive->table_speed.end());
    speeds.insert(speeds.end(), {scene.drive->speed, scene.drive->synchronous_speed});
  }
  const auto [low, high] = std::minmax_element(speeds.begin(), speeds.end());
  return {*low, *high};
}

std::string growth_text(double growth) {
  return std::isfinite(growth) ? fmt::format("{:.4g}", growth) : "-";
}

std::string rub_row(const rub::SteadyRub& rub, const rub::Stability& s) {
  const std::string ring =
      rub.ring_speed == 0.0 ? "" : fmt::format(", ring at {:.6g} rad/s", rub.ring_speed);
  return fmt::format("  {:<10}{:>14.7g}{:>14.7g}{:>12.5g}{:>14}{:>14.6g}  {}{}\n",
                     rub::to_string(rub.kind), rub.whirl, rub.normal_force, rub.friction,
                     growth_text(s.growth), s.frequency, s.stable ? "stable" : "unstable", ring);
}

json stability_json(const rub::Stability& s) {
  return {
      {"growth_rate", number_or_null(s.growth)}, {"frequency", s.frequency}, {"stable", s.stable}};
}

// Force and motion of a rub, and its stability.
json steady_json(const rub::SteadyRub& rub, const rub::Stability& stability) {
  json all = stability_json(stability);
  all.update(
      {{"whirl", rub.whirl}, {"normal_force", rub.normal_force}, {"friction", rub.friction}});
  return all;
}

// A number, or the values of the scene's friction table.
json friction_json(const FrictionLaw& law) {
  if (law.is_constant()) return law.coefficient;
  return {{"static", law.sticking()},
          {"kinetic", law.coefficient},
          {"stribeck_speed", law.stribeck_speed},
          {"viscous", law.viscous}};
}

std::string orbit_text(const RubPoint& point) {
  if (!point.orbit) return "free orbit: none, as loads of several frequencies make no circle";
  const double share = *point.orbit / point.clearance;
  std::string text = fmt::format("free orbit: {:.4g} of the clearance", share);
  if (!(share < 1.0)) return text + ", so there is none";
  return text +
         (point.free.stable ? ", stable" : fmt::format(", grows at {:.4g} 1/s", point.free.growth));
}

std::string rolling_text(const RubPoint& point) {
  std::string text;
  for (const auto& [from, to] : point.rolling_ranges) {
    text += text.empty() ? "" : ", ";
    text += std::isfinite(to) ? fmt::format("{:.7g} to {:.7g} rad/s", from, to)
                              : fmt::format("above {:.7g} rad/s", from);
  }
  if (text.empty()) return "friction is not enough for backward rolling at any speed";
  return "friction is enough for backward rolling: " + text;
}

// The same rubs with the spin free, and the rolling that the motor sustains.
std::string driven_text(const RubAnalysis& analysis) {
  std::string text;
  if (!analysis.driven.empty())
    text += "\nthe same where torsion and the speed under the motor give way\n";
  for (std::size_t k = 0; k < analysis.driven.size(); ++k) {
    text += rub_row(analysis.point.rubs[k].rub, analysis.driven[k]);
  }
  if (!analysis.rolling.empty()) {
    text += "\nbackward rolling at a speed that the motor keeps\n";
    text +=
        fmt::format("  {:>10}{:>14}{:>14}{:>12}{:>12}{:>12}{:>12}\n", "spin rad/s", "whirl rad/s",
                    "force / N", "friction", "torque / Nm", "growth 1/s", "at rad/s");
  }
  for (const rub::DrivenRolling& r : analysis.rolling) {
    text += fmt::format("  {:>10.6g}{:>14.7g}{:>14.7g}{:>12.5g}{:>12.5g}{:>12}{:>12.6g}  {}\n",
                        r.speed, r.rub.whirl, r.rub.normal_force, r.rub.friction, r.torque,
                        growth_text(r.stability.growth), r.stability.frequency,
                        r.stability.stable ? "stable" : "unstable");
  }
  return text;
}

// m: static displacement of the rotor at the contact under its weight; not finite if nothing holds
// it.
double sag(const Model& m) {
  const auto n = static_cast<Eigen::Index>(m.layout.modes);
  const Eigen::VectorXd q =
      lu_solve(linear_parts(m, m.speed).stiffness, Eigen::VectorXd(m.weight.head(2 * n)));
  return std::hypot(m.first().shape.x.dot(q.head(n)), m.first().shape.y.dot(q.tail(n)));
}

// Removes the parts of the scene that a rub analysis does not support, and returns a sentence on
// them. Refuses a rotor that nothing but the rings holds against its weight, because it rests in
// them.
std::string leave_out(scene::Scene& scene) {
  constexpr double kHeld = 1e3;  // clearances
  if (!scene.gravity || scene.gravity->acceleration.isZero(0.0)) return "";
  const Model m = prepare(without_start(scene));
  if (m.weight.size() > 0 && !(sag(m) < kHeld * m.first().contact->clearance)) {
    scene::refuse_at(scene, "gravity",
                     "no lasting rub can be analysed: nothing but rings holds the rotor against "
                     "its weight; accepted: bearings that do, or no [gravity] (a vertical rotor)");
  }
  scene.gravity.reset();
  return "the weight, whose direction is fixed: with it a rub oscillates about the values given "
         "here";
}

RubAnalyses rubs_of_contact(scene::Scene scene, const std::vector<double>& speeds) {
  RubAnalyses all;
  if (!scene.first().contact) return all;
  try {
    const std::string left_out = leave_out(scene);
    with_place(scene, [&] {
      const rub::RubSystem system = rub::rub_system(scene);
      const auto train = train_of(scene);
      std::vector<rub::DrivenRolling> rolling;
      if (train) {
        const auto [low, high] = outermost_speeds(scene);
        rolling = rub::driven_rolling(system, *train, low);
        std::reverse(rolling.begin(), rolling.end());
        for (auto& forward : rub::driven_rolling(system, *train, high))
          rolling.push_back(std::move(forward));
      }
      for (const double speed : speeds) {
        const rub::RubSystem turning = rub::at_speed(system, speed);
        rub::RubPoint point = rub::RubStudy(turning).at(system.friction);
        std::vector<rub::Stability> driven;
        for (const StandingRub& r : point.rubs) {
          if (train)
            driven.push_back(rub::stability_of(rub::driven_eigenvalues(turning, *train, r.rub)));
        }
        all.at.push_back({std::move(point), std::move(driven), rolling,
                          whirls(rub::ring_eigenvalues(turning)),
                          whirls(rub::joined_eigenvalues(turning)), left_out});
      }
    });
  } catch (const scene::SceneError& error) {
    all.at.clear();
    all.refused = error.diagnostics().front().key + ": " + error.diagnostics().front().reason;
  }
  return all;
}

}  // namespace

std::vector<RubAnalyses> analyse_rubs(const scene::Scene& scene,
                                      const std::vector<double>& speeds) {
  if (scene.auxiliary.size() == 1) return {rubs_of_contact(scene, speeds)};
  std::vector<RubAnalyses> all;
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    all.push_back(rubs_of_contact(with_bearing_alone(scene, k), speeds));
    all.back().contact = scene.name_of(k);
  }
  return all;
}

json whirls_json(const std::vector<WhirlMode>& modes) {
  json all = json::array();
  for (const WhirlMode& mode : modes) {
    all.push_back({{"frequency", mode.frequency}, {"damping_ratio", mode.damping_ratio}});
  }
  return all;
}

std::string attractors_text(unsigned attractors) {
  std::string text;
  for (const auto& [bit, name] :
       {std::pair{rub::kFreeOrbit, "no contact"}, std::pair{rub::kForcedRub, "synchronous rub"},
        std::pair{rub::kBackwardWhip, "backward whip"}, std::pair{rub::kRollingRub, "rolling"}}) {
    if (attractors & bit) text += (text.empty() ? "" : " + ") + std::string(name);
  }
  return text.empty() ? "none stable" : text;
}

json rub_point_json(const RubPoint& point) {
  json rubs = json::array(), ranges = json::array(), attractors = json::array();
  for (const StandingRub& r : point.rubs) {
    rubs.push_back(steady_json(r.rub, r.stability));
    rubs.back().update({{"kind", rub::to_string(r.rub.kind)},
                        {"slip", r.rub.slip},
                        {"ring_speed", r.rub.ring_speed}});
  }
  for (const auto& [from, to] : point.rolling_ranges) ranges.push_back({from, number_or_null(to)});
  for (const unsigned bit :
       {rub::kFreeOrbit, rub::kForcedRub, rub::kBackwardWhip, rub::kRollingRub}) {
    if (point.attractors() & bit) attractors.push_back(attractors_text(bit));
  }
  return {{"speed", point.speed},
          {"friction", friction_json(point.friction)},
          {"free_orbit", number_or_null(point.orbit)},
          {"free_growth_rate", number_or_null(point.free.growth)},
          {"attractors", attractors},
          {"rubs", rubs},
          {"rolling_ranges", ranges}};
}

json rub_json(const RubAnalysis& analysis) {
  json result = rub_point_json(analysis.point);
  result["left_out"] = analysis.left_out.empty() ? json(nullptr) : json(analysis.left_out);
  result["ring"] = whirls_json(analysis.ring);
  result["joined"] = whirls_json(analysis.joined);
  if (analysis.driven.empty() && analysis.rolling.empty()) return result;
  json& driven = result["driven"] = json::array();
  for (const rub::Stability& s : analysis.driven) driven.push_back(stability_json(s));
  json& rolling = result["driven_rolling"] = json::array();
  for (const rub::DrivenRolling& r : analysis.rolling) {
    rolling.push_back(steady_json(r.rub, r.stability));
    rolling.back().update({{"speed", r.speed}, {"torque", r.torque}});
  }
  return result;
}

std::string rub_table(const RubAnalysis& analysis) {
  const RubPoint& point = analysis.point;
  std::string text = fmt::format("rotor and ring at {:.6g} rad/s ({:.6g} rpm), of the modes kept\n",
                                 point.speed, point.speed * kRpm);
  if (!analysis.ring.empty()) text += whirls_table("ring alone", analysis.ring, point.speed);
  text +=
      whirls_table("joined, the rotor's centre held to the ring's", analysis.joined, point.speed);
  const FrictionLaw& mu = point.friction;
  text += fmt::format(
      "\nlasting rubs at {:.6g} rad/s with a friction of {:g}{}\n", point.speed, mu.sticking(),
      mu.is_constant() ? ""
                       : fmt::format(" at rest, then {:g} {:+g} exp(-(v / {:g})^2) {:+g} v",
                                     mu.coefficient, mu.excess, mu.stribeck_speed, mu.viscous));
  text += fmt::format("  {:<10}{:>14}{:>14}{:>12}{:>14}{:>14}\n", "rub", "whirl rad/s", "force / N",
                      "friction", "growth 1/s", "at rad/s");
  for (const StandingRub& r : point.rubs) text += rub_row(r.rub, r.stability);
  if (!analysis.left_out.empty()) text += wrapped("  left out: ", analysis.left_out);
  if (point.rubs.empty()) text += "  none\n";
  text += wrapped("  ", orbit_text(point)) + wrapped("  ", rolling_text(point));
  text += "  attractors: " + attractors_text(point.attractors()) + "\n";
  return text + driven_text(analysis);
}

}  // namespace rotorub
