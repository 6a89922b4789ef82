#include "compare/modes/rub_analysis.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "native_model/linear/free_motion.h"
#include "native_model/model/linear_parts.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

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
  const bool is_sampled = std::ranges::any_of(scene.auxiliary, [](const auto& at) {
    return at.controller && at.controller->sample_time > 0.0;
  });
  const std::string sampling =
      is_sampled ? "the sampling and the delay of the controller, which --periodic includes" : "";
  if (!scene.gravity || scene.gravity->acceleration.isZero(0.0)) return sampling;
  const Model m = prepare(without_start(scene));
  if (m.weight.size() > 0 && !(sag(m) < kHeld * m.first().contact->clearance)) {
    scene::refuse_at(scene, "gravity",
                     "no lasting rub can be analysed: only rings hold the rotor against its "
                     "weight; add bearings that hold it, or remove [gravity] (a vertical rotor)");
  }
  scene.gravity.reset();
  return "the weight, which has a fixed direction; with it a rub oscillates about these values" +
         (is_sampled ? "; " + sampling : "");
}

RubAnalyses rubs_of_contact(scene::Scene scene, const std::vector<double>& speeds) {
  RubAnalyses all;
  if (!scene.has_contact()) return all;
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
                          whirls(rub::joined_eigenvalues(turning)), left_out, std::nullopt});
      }
    });
  } catch (const scene::SceneError& error) {
    all.at.clear();
    all.refused = scene::to_string(error.diagnostics().front());
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

std::vector<std::string> attractor_names(unsigned attractors) {
  std::vector<std::string> names;
  for (const auto& [bit, name] :
       {std::pair{rub::kFreeOrbit, "no contact"}, std::pair{rub::kForcedRub, "synchronous rub"},
        std::pair{rub::kBackwardWhip, "backward whip"}, std::pair{rub::kRollingRub, "rolling"}}) {
    if (attractors & bit) names.emplace_back(name);
  }
  return names;
}

std::string attractors_text(unsigned attractors) {
  return attractors == 0 ? "none stable"
                         : fmt::format("{}", fmt::join(attractor_names(attractors), " + "));
}

}  // namespace rotorub
