#include "native_model/linear/steady_orbit.h"

#include <Eigen/LU>
#include <algorithm>
#include <string>
#include <vector>

#include "native_model/bearing/actuator.h"
#include "native_model/linear/free_motion.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

// -dF/dr of a force on a ring, N/m, by difference quotients over 2 h (m).
template <class Force>
Eigen::Matrix2d slope_of(const Force& force, const Eigen::Vector2d& place, double h) {
  Eigen::Matrix2d slope;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d nudge = h * Eigen::Vector2d::Unit(k);
    slope.col(k) = (force(place - nudge) - force(place + nudge)) / (2.0 * h);
  }
  return slope;
}

// Rest position of a ring under `weight` (N) on its ball bearings and its spring, m: the minimum of
// its convex energy, found by Newton's method with steps halved until the residual force falls.
Eigen::Vector2d at_rest_on_balls(const BallBearingLaw& balls, const Eigen::Vector2d& stiffness,
                                 const Eigen::Vector2d& weight) {
  const auto force = [&](const Eigen::Vector2d& r) -> Eigen::Vector2d {
    return weight - stiffness.cwiseProduct(r) + balls.force(r);
  };
  if (weight.isZero(0.0)) return {0.0, 0.0};
  // Leave the play along the weight until the ring is held.
  Eigen::Vector2d place = 1e-9 * weight.normalized(), pull = weight;
  while (force(place).dot(weight) > 0.0) place *= 2.0;
  for (int round = 0; round < 200; ++round) {
    pull = force(place);
    if (pull.norm() <= 1e-12 * weight.norm()) break;
    Eigen::Matrix2d slope = slope_of(force, place, 1e-7 * place.norm());
    slope.diagonal().array() += 1e-9 * slope.trace();
    Eigen::Vector2d change = slope.inverse() * pull;
    while (force(place + change).norm() > pull.norm() && change.norm() > 1e-16 * place.norm()) {
      change *= 0.5;
    }
    place += change;
  }
  return place;
}

// Rest position of a ring on the magnets of its actuator, m.
Eigen::Vector2d ring_on_magnets(const scene::Scene& scene, const AuxiliaryBearing& at,
                                const Eigen::Vector2d& stiffness, const Eigen::Vector2d& weight) {
  const ForceLaw& law = *at.magnets->law;
  const auto force = [&](const Eigen::Vector2d& r) -> Eigen::Vector2d {
    const Eigen::Vector2d s = to_axes(r);
    return weight - stiffness.cwiseProduct(r) +
           from_axes({law.force(s.x(), 0.0), law.force(s.y(), 0.0)});
  };
  const char* pulled =
      "the bias of the actuator's magnets pulls the ring off centre harder than [stator] holds it; "
      "raise stator.stiffness, or set false";
  constexpr double kStep = 1e-8;  // m, of the difference quotients
  Eigen::Vector2d place{0.0, 0.0};
  for (int round = 0; round < 60; ++round) {
    const Eigen::Matrix2d slope = slope_of(force, place, kStep);
    // The ring is held if the slope, which is symmetric, is positive definite.
    if (slope.trace() <= 0.0 || slope.determinant() <= 0.0) break;
    const Eigen::Vector2d change = slope.inverse() * force(place);
    place += change;
    if (to_axes(place).cwiseAbs().maxCoeff() >= law.reach()) break;
    if (change.norm() <= 1e-15 * (1e-3 + place.norm())) return place;
  }
  refuse_steady(scene, pulled);
}

// Times at which another set of loads acts in full, s; 0 first.
std::vector<double> changes(const Model& m) {
  std::vector<double> all{0.0};
  const auto add = [&](double t) {
    if (t > 0.0 && t < scene::kNever) all.push_back(t);
  };
  for (const AppliedForce& f : m.forces) {
    if (f.kind == scene::ForceKind::kPulse) continue;
    add(f.on + f.ramp);
    add(f.off);
  }
  for (const DiscUnbalance& u : m.unbalances) add(u.on);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// The model with the loads of time t moved to time 0: those that begin to rise then have risen, and
// pulses are over.
Model with_loads_of(Model m, double t) {
  for (AppliedForce& f : m.forces) {
    f.on -= t;
    f.off = f.kind == scene::ForceKind::kPulse ? 0.0 : f.off - t;
    f.ramp = 0.0;
  }
  for (DiscUnbalance& u : m.unbalances) u.on -= t;
  return m;
}

}  // namespace

std::string beyond_limit(const scene::Scene& scene, const StationFeedback& feedback, double most) {
  if (!feedback.works.at(0.0) || most <= feedback.law.current_limit) return {};
  const std::string path = scene::magnetic_bearing_path(scene, feedback.number);
  return " asks the magnetic bearing for up to " + scene::number_text(most) + " A, beyond " + path +
         ".control.current_limit = " + scene::number_text(feedback.law.current_limit) +
         " A, where its law is not linear";
}

RingRest ring_at_rest(const scene::Scene& scene, const Model& m, const AuxiliaryBearing& at) {
  RingRest rest;
  if (!at.moves()) return rest;
  const auto weight_of = [&](int i) -> Eigen::Vector2d {
    return m.weight.size() > 0 ? Eigen::Vector2d(m.weight.segment<2>(i))
                               : Eigen::Vector2d(0.0, 0.0);
  };
  const auto hang = [&](const Eigen::Vector2d& weight, const Eigen::Vector2d& stiffness,
                        const char* what) {
    Eigen::Vector2d place{0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
      if (weight[k] == 0.0) continue;
      if (stiffness[k] == 0.0) {
        refuse_steady(scene, std::string("nothing holds the ") + what + " against its weight");
      }
      place[k] = weight[k] / stiffness[k];
    }
    return place;
  };
  const Eigen::Vector2d stiffness = m.stiffness.segment<2>(at.ring), weight = weight_of(at.ring);
  const auto support = std::find_if(m.supports.begin(), m.supports.end(),
                                    [&](const StationSupport& s) { return s.ring == at.ring; });
  const bool mounted = support != m.supports.end();
  if (at.magnets) {
    if (mounted && (at.housing != kAbsent || support->law.balls)) {
      refuse_steady(scene,
                    "no rest position is computed for magnets that hold a ring with a stator.mount "
                    "or stator.ball_bearing; remove these, or set false");
    }
    rest.ring = ring_on_magnets(scene, at, stiffness, weight);
    return rest;
  }
  rest.ring = mounted && support->law.balls
                  ? at_rest_on_balls(*support->law.balls, stiffness, weight)
                  : hang(weight, stiffness, "ring");
  if (at.housing == kAbsent) return rest;
  // The housing carries the ring; its diagonal entry also contains the spring between the two.
  const Eigen::Vector2d to_base = m.stiffness.segment<2>(at.housing) - support->stiffness;
  rest.housing = hang(weight + weight_of(at.housing), to_base, "housing");
  rest.ring += rest.housing;
  return rest;
}

FreeResponse free_response(const scene::Scene& scene, Model m, double speed) {
  m.speed = speed;
  // The model's forces are the scene's forces except unbalances, in the same order (model.cc). At a
  // prescribed spin speed a synchronous force rotates at that speed.
  auto force = m.forces.begin();
  for (const scene::Force& given : scene.forces) {
    if (given.kind == scene::ForceKind::kUnbalance) continue;
    if (given.kind == scene::ForceKind::kSynchronous) force->frequency = speed;
    ++force;
  }
  const auto none = [](const scene::SceneError& error) -> FreeOrbit {
    const std::string& why = error.diagnostics().front().reason;
    return {std::nullopt, why.substr(0, why.find("; "))};
  };
  FreeResponse response;
  std::vector<Eigen::Vector2d> middles;
  for (const AuxiliaryBearing& at : m.auxiliary) {
    // If one ring has no support, the other rings keep their orbits.
    try {
      middles.emplace_back(ring_at_rest(scene, m, at).ring + at.ring_offset);
      response.orbits.push_back({0.0, {}});
    } catch (const scene::SceneError& error) {
      middles.emplace_back(0.0, 0.0);
      response.orbits.push_back(none(error));
    }
  }
  std::vector<double> currents(m.feedbacks.size());
  try {
    for (const double t : changes(m)) {
      FreeMotion motion = free_motion(scene, with_loads_of(m, t));
      for (std::size_t k = 0; k < currents.size(); ++k)
        currents[k] = std::max(currents[k], motion.current[k].maxCoeff());
      for (std::size_t k = 0; k < middles.size(); ++k) {
        FreeOrbit& free = response.orbits[k];
        if (!free.largest) continue;
        OrbitSize& orbit = motion.orbits[k];
        orbit.centre = -middles[k];
        free.largest = std::max(*free.largest, orbit.largest());
        // About its mean an orbit of one frequency extends equally far to both sides; with several
        // in the ratio of whole numbers the result is an upper bound.
        orbit.centre.setZero();
        std::erase_if(orbit.parts, [](const OrbitPart& part) { return part.frequency == 0.0; });
        free.vibration = std::max(free.vibration, 2.0 * orbit.largest());
      }
    }
  } catch (const scene::SceneError& error) {
    response.orbits.assign(m.auxiliary.size(), none(error));
    return response;
  }
  for (std::size_t k = 0; k < currents.size(); ++k) {
    const std::string beyond = beyond_limit(scene, m.feedbacks[k], currents[k]);
    if (!beyond.empty())
      response.notes.push_back("the response" + beyond + ": a run will differ from this response");
  }
  return response;
}

}  // namespace rotorub
