#include "mjcf/soft_contact.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {
namespace {

// m/s, of the rotor at a contact where the modes have these values; without values they are 1.
double speed_of(const std::vector<double>& modes, const Eigen::VectorXd& values) {
  double sum = 0.0;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    const double value = values.size() > 0 ? values[static_cast<Eigen::Index>(i)] : 1.0;
    sum += value * modes[i];
  }
  return sum;
}

// Estimate of the speeds at which the scene's rotor strikes a ring, m/s.
double impact_speed(const scene::Scene& scene, const scene::AuxiliaryBearing& bearing,
                    const ModeShape& shape) {
  const double clearance = bearing.contact->clearance;
  const Eigen::Vector2d start(speed_of(scene.initial.vx, shape.x),
                              speed_of(scene.initial.vy, shape.y));
  const double gravity = scene.gravity ? scene.gravity->acceleration.norm() : 0.0;
  const std::optional<scene::Stator>& ring = bearing.stator;
  const Eigen::Vector2d ring_velocity = ring ? ring->velocity : Eigen::Vector2d(0.0, 0.0);
  return std::max({std::abs(scene.rotor.speed) * clearance, std::sqrt(2.0 * gravity * clearance),
                   (start - ring_velocity).norm()});
}

}  // namespace

double soft_restitution(double zeta) {
  assert(zeta >= 0.0);
  // Near zeta = 1 both formulas are 0/0; the exponent is -2 - 4/3 (zeta - 1) + ...
  if (std::abs(zeta - 1.0) < 1e-6) return std::exp(-2.0 - (zeta - 1.0) * 4.0 / 3.0);
  if (zeta < 1.0) {
    const double s = std::sqrt(1.0 - zeta * zeta);
    const double phase = std::atan2(2.0 * zeta * s, 1.0 - 2.0 * zeta * zeta);
    return std::exp(-zeta / s * (std::numbers::pi - phase));
  }
  const double s = std::sqrt(zeta * zeta - 1.0);
  // (zeta + s)/(zeta - s) = (zeta + s)^2, without cancellation.
  return std::exp(-zeta / s * 2.0 * std::log(zeta + s));
}

double soft_damping_ratio(double restitution) {
  assert(restitution >= 0.0 && restitution <= 1.0);
  if (restitution >= 1.0) return 0.0;
  if (restitution <= soft_restitution(kMaxDampingRatio)) return kMaxDampingRatio;
  // The restitution falls from 1 to 0 as zeta rises, so bisection to round-off finds it.
  double low = 0.0, high = kMaxDampingRatio;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (soft_restitution(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

SoftContact soft_contact(double restitution, double step, double stiffness, double damping) {
  assert(step > 0.0 && stiffness >= 0.0 && damping >= 0.0);
  const double zeta = soft_damping_ratio(restitution);
  double root = std::sqrt(stiffness);  // 1/s
  if (stiffness == 0.0) {
    // B step = 2 zeta sqrt(K) step <= 1 prevents a change of sign of the velocity within one step.
    const double fraction = std::min(kContactStepFraction, 0.5 / std::max(zeta, 1e-300));
    root = fraction / step;
  }
  if (damping == 0.0) damping = 2.0 * zeta * root;
  return {root * root, damping, 0.9999};  // 0.9999: MuJoCo's largest value
}

SoftContact soft_contact(const scene::Scene& scene, scene::ContactModel model, double step,
                         std::size_t bearing, const ModeShape& shape) {
  const scene::AuxiliaryBearing& at = scene.auxiliary[bearing];
  const scene::Contact& c = *at.contact;
  const scene::Mujoco& mujoco = scene.mujoco;
  if (c.compliance) return {1.0, 0.0, kCompliantImpedance, true};
  const auto of = [&](double stiffness) {
    return soft_contact(c.restitution, step, stiffness, mujoco.solref_damping);
  };
  const SoftContact chosen = of(mujoco.solref_stiffness);
  if (!scene::is_cone(model) || mujoco.solref_stiffness > 0.0) return chosen;
  const double rate = impact_speed(scene, at, shape) / (kConeDepth * c.clearance);
  return rate > 0.0 && rate * rate < chosen.stiffness ? of(rate * rate) : chosen;
}

std::string unused_by_soft_contacts(const scene::Scene& scene) {
  struct Key {
    const char* name;
    double scene::Contact::*value;
  };
  constexpr Key kOfRigidImpacts[] = {
      {"contact.compression_time", &scene::Contact::compression_time},
      {"contact.expansion_time", &scene::Contact::expansion_time},
      {"contact.tangential_restitution", &scene::Contact::tangential_restitution}};
  std::string names;
  for (const Key& key : kOfRigidImpacts) {
    const auto says = [&key](const scene::AuxiliaryBearing& bearing) {
      return bearing.contact && (*bearing.contact).*key.value != 0.0;
    };
    if (!std::any_of(scene.auxiliary.begin(), scene.auxiliary.end(), says)) continue;
    names += (names.empty() ? "" : ", ") + std::string(key.name);
  }
  return names.empty() ? "" : "MuJoCo's soft contact has no part in " + names;
}

ContactPair contact_pair(scene::ContactModel model, double clearance, const FrictionLaw& friction,
                         const SoftContact& soft, const MujocoVersion& target, bool kept_out) {
  const bool is_cone = scene::is_cone(model);
  const bool is_rigid = model == scene::ContactModel::kRigid;
  ContactPair pair;
  // `coulomb`: the plugin adds the friction, and MuJoCo's contact has none. A cone without friction
  // does not need the tangential directions either.
  pair.condim = is_cone && !friction.is_frictionless() ? 3 : 1;
  pair.friction = is_cone ? friction.constant("MuJoCo's cone") : friction.sticking();
  pair.soft = soft;
  // In a lasting rub `coulomb` and `cone-coulomb` keep the gap at 0 up to the step's error. A
  // margin prevents the contact from switching with the sign of a nanometre. `cone` would keep a
  // margin as a gap. `rigid` shows the contact from farther away, for viewers, and its pair gap is
  // too large for MuJoCo's solver to act at any penetration.
  const bool is_soft = model == scene::ContactModel::kCoulomb;
  const double reach = model == scene::ContactModel::kCone || soft.is_compliant
                           ? 0.0
                           : (is_soft ? 1e-3 : 1e-2) * clearance;
  pair.gap = is_rigid || kept_out ? 1e3 : 0.0;
  // Before 3.9 a contact is detected below the margin and solved below margin - gap. Since then it
  // is detected below margin + gap and solved below the margin.
  pair.margin = target < MujocoVersion{3, 9, 0} ? reach : reach - pair.gap;
  return pair;
}

}  // namespace rotorub
