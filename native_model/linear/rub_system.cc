#include "native_model/linear/rub_system.h"

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <string>

#include "native_model/control/ring_feedback.h"
#include "native_model/linear/free_motion.h"
#include "native_model/model/linear_parts.h"
#include "native_model/model/model.h"
#include "native_model/model/model_checks.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/record.h"
#include "native_model/scene/text.h"

namespace rotorub::rub {
namespace {

[[noreturn]] void refuse(const scene::Scene& scene, const std::string& key,
                         const std::string& why) {
  throw scene::SceneError(
      scene::placed(scene, {{"", 0, key, "no lasting rub can be analysed: " + why}}));
}

bool differ(const scene::PlanePair& pair) { return pair.x() != pair.y(); }

bool crosses(const scene::Controller& c) {
  return c.kind == scene::ControllerKind::kCrossCoupled ||
         c.kind == scene::ControllerKind::kTwoPhase;
}

// Refuses the scene at `key` if `so`.
struct Checks {
  const scene::Scene& scene;
  void operator()(bool so, const std::string& key, const std::string& why) const {
    if (so) refuse(scene, key, why);
  }
};

// Whether something other than magnetic bearings and rings holds the rotor.
bool has_other_support(const scene::Scene& scene) {
  const scene::Rotor& rotor = scene.rotor;
  if (rotor.geometry) return !rotor.geometry->bearings.empty();
  return !rotor.modal ||
         std::ranges::all_of(rotor.modal->stiffness, [](double k) { return k > 0.0; });
}

// Requires a linear law: it works always and without limits, or has failed.
void check_feedback(const Checks& check, std::size_t bearing,
                    const scene::MagneticBearing& magnetic) {
  const scene::BearingControl& control = *magnetic.control;
  if (!control.works()) return;
  const std::string path = scene::magnetic_bearing_path(check.scene, bearing) + ".control.";
  check(magnetic.kind != scene::MagnetKind::kLinear,
        scene::magnetic_bearing_path(check.scene, bearing) + ".kind",
        "the force of an electromagnet is not linear; choose linear, or set " + path +
            "fails_at = 0");
  check(control.works_from > 0.0, path + "on",
        "the machine must not change in time; leave this key out");
  check(control.fails_at < scene::kNever, path + "fails_at",
        scene::magnetic_bearing_name(check.scene, bearing) + " fails during the run" +
            (has_other_support(check.scene)
                 ? ". Add --set magnetic_bearing.control.fails_at=0 for the machine after the "
                   "failure"
                 : ", and after that only rings hold the rotor"));
  const auto has_no_state = [&](bool has, const std::string& key, const char* what) {
    check(has, key,
          std::string("the analysis has no state for ") + what + "; leave it out, or set " + path +
              "fails_at = 0");
  };
  check(control.sampled(), path + "sample_time",
        "between samples the feedback is not linear in the state; leave it out with form pid, or "
        "set " +
            path + "fails_at = 0");
  has_no_state(control.integral > 0.0, path + "integral", "an integrator");
  has_no_state(control.derivative_lag > 0.0, path + "derivative_lag", "a filter");
  check(
      magnetic.amplifier.has_value(),
      scene::magnetic_bearing_path(check.scene, bearing) + ".amplifier",
      "the analysis has no state for an amplifier; leave it out, or set " + path + "fails_at = 0");
  check(std::isfinite(control.current_limit), path + "current_limit",
        "at the limit the magnets' forces are not linear; leave it out, or set " + path +
            "fails_at = 0");
}

// Checks that need only the scene.
void check(const scene::Scene& scene) {
  const Checks check{scene};
  const scene::AuxiliaryBearing& first = scene.first();
  check(!first.contact, "contact", "the scene has no [contact]; add one");
  if (scene.auxiliary.size() > 1) {
    scene::refuse_at(scene, "contact[1]",
                     "a map of lasting rubs needs a single contact; remove the others, for example "
                     "with --set \"contact[1]=none\" (`rotorub modes` lists the rubs of each "
                     "contact while the others are open)");
  }
  check(scene.is_compliant(), "contact.compliance",
        "this analysis needs a rigid contact; remove contact.compliance");
  if (first.stator) {
    const char* planes = "both planes must be alike; give one number for x and y";
    check(first.stator->spin && !first.contact->friction.is_constant(), "contact.friction",
          "with a turning ring this analysis needs constant friction; give a number, or remove "
          "stator.spin");
    check(!first.stator->on_springs_alone(), "stator",
          "this analysis needs a ring on its spring and damper only; remove mount, dry_friction, "
          "squeeze_film and ball_bearing, and give a turning ring only drag");
    check(differ(first.stator->mass), "stator.mass", planes);
    check(differ(first.stator->damping), "stator.damping", planes);
    check(differ(first.stator->stiffness), "stator.stiffness", planes);
  }
  for (std::size_t k = 0; k < scene.forces.size(); ++k) {
    const scene::Force& force = scene.forces[k];
    const std::string key = scene::list_element("force", k) + ".kind";
    check(force.kind == scene::ForceKind::kConstant && !force.vector.isZero(0.0), key,
          "a constant force breaks the rotational symmetry that this analysis needs; use rotating "
          "forces");
    check(force.kind == scene::ForceKind::kChirp || force.kind == scene::ForceKind::kPulse, key,
          "no whirl is steady under a force that varies in this way; use rotating or synchronous "
          "forces");
  }
  check(scene.gravity && !scene.gravity->acceleration.isZero(0.0), "gravity",
        "gravity breaks the rotational symmetry that this analysis needs; remove [gravity]");
  check(scene.base.has_value(), "base", "no whirl is steady on a moving base; remove [base]");
  for (std::size_t i = 0; scene.rotor.geometry && i < scene.rotor.geometry->bearings.size(); ++i) {
    const scene::ShaftBearing& bearing = scene.rotor.geometry->bearings[i];
    const std::string path = scene::list_element("rotor.bearing", i);
    check(!bearing.offset.isZero(0.0), path + ".offset",
          "a bearing off the line breaks the rotational symmetry that this analysis needs; use 0");
    check(bearing.follows_speed() || bearing.crosses(),
          path + (bearing.journal           ? ".journal"
                  : bearing.follows_speed() ? ".table_speed"
                                            : ".cross_stiffness"),
          "this analysis supports only uncoupled springs and dampers; give stiffness and damping");
  }
  check(!first.contact->offset.isZero(0.0), "contact.offset",
        "an offset ring breaks the rotational symmetry that this analysis needs; use 0");
  for (std::size_t k = 0; k < scene.magnetic_bearings.size(); ++k) {
    const scene::MagneticBearing& magnetic = scene.magnetic_bearings[k];
    if (magnetic.control) check_feedback(check, k, magnetic);
  }
  check(first.controller && first.controller->kind != scene::ControllerKind::kPassive &&
            !crosses(*first.controller),
        "controller.kind",
        "this analysis supports only the kinds passive, cross_coupled and two_phase; choose one");
  check(first.actuator && first.actuator->kind != scene::ActuatorKind::kIdeal, "actuator.kind",
        "the magnets' forces are not linear; use an ideal actuator");
}

bool same(const ModeShape& shape) { return shape.x == shape.y; }

bool same_planes(const Model& m) {
  const int n = m.layout.modes;
  const auto halves = [n](const Eigen::VectorXd& v) { return v.head(n) == v.segment(n, n); };
  const Eigen::MatrixXd g = m.gyroscopic.dense(n), xx = m.internal_xx.dense(n);
  bool all = halves(m.mass) && halves(m.stiffness) && halves(m.damping) && same(m.first().shape) &&
             g == g.transpose() && xx == m.internal_xy.dense(n) && xx == m.internal_yy.dense(n);
  for (const StationDamper& d : m.dampers) all = all && same(d.shape) && !differ(d.damping);
  for (const StationSpring& s : m.springs) all = all && same(s.shape) && !differ(s.stiffness);
  for (const StationFeedback& f : m.feedbacks) all = all && same(f.shape) && same(f.sensor_shape());
  for (const AppliedForce& f : m.forces) all = all && same(f.shape);
  for (const DiscUnbalance& u : m.unbalances) all = all && same(u.shape);
  return all;
}

void add_loads(const Model& model, RubSystem& system) {
  for (const AppliedForce& f : model.forces) {
    // A synchronous force has the frequency of the spin, which is held here.
    const bool locked = f.kind == scene::ForceKind::kSynchronous;
    if (f.kind != scene::ForceKind::kRotating && !locked) continue;
    const double phase = locked ? f.phase + model.spin_angle : f.phase;
    system.forces.push_back(
        {locked ? model.speed : f.frequency, std::polar(f.amplitude, phase) * f.shape.x});
  }
  for (const DiscUnbalance& u : model.unbalances) {
    system.unbalance += std::polar(u.static_moment, model.spin_angle + u.phase) * u.shape.x;
  }
}

}  // namespace

Model model_without_start(const scene::Scene& scene) { return make_model(without_start(scene)); }

RubSystem rub_system(const scene::Scene& scene) {
  check(scene);
  const Model model = model_without_start(scene);
  if (!same_planes(model)) {
    refuse(scene, scene.rotor.modal ? "rotor.modal" : "rotor.bearing",
           "both planes must be alike; these bearings or modes differ");
  }
  const int n = model.layout.modes;
  RubSystem system;
  system.speed = scene.rotor.speed;
  system.mass = model.mass.head(n);
  system.internal = model.internal_xx.dense(n);
  system.gyroscopic = model.gyroscopic.dense(n);
  // At rest nothing couples the planes; rotating damping is stored separately.
  Model resting = model;
  resting.internal_xx = resting.internal_xy = resting.internal_yy = {};
  const LinearParts parts = linear_parts(resting, 0.0);
  system.stiffness = parts.stiffness.topLeftCorner(n, n);
  system.damping = parts.damping.topLeftCorner(n, n);
  const AuxiliaryBearing& at = model.first();  // the only one
  system.contact = at.shape.x;
  system.clearance = at.contact->clearance;
  system.radius = at.contact->radius;
  system.friction = at.contact->friction;
  if (at.moves()) {
    system.ring = Ring{model.mass[at.ring], model.damping[at.ring], model.stiffness[at.ring]};
    if (const auto& spin = scene.first().stator->spin) {
      system.ring->inertia = spin->inertia;
      system.ring->drag = spin->drag;
    }
    const auto& controller = scene.first().controller;
    if (controller && crosses(*controller)) {
      const double gain = CrossCoupled(*controller).gain(system.speed);
      system.ring->coupling = std::copysign(gain, system.speed);
      system.ring->damping += controller->damping;
    } else if (controller) {
      system.ring->stiffness += controller->stiffness;
      system.ring->damping += controller->damping;
    }
  }
  system.unbalance = Eigen::VectorXcd::Zero(n);
  add_loads(model, system);
  return system;
}

RubSystem at_speed(RubSystem system, double speed) {
  if (system.speed != 0.0) {
    for (RotatingLoad& force : system.forces) force.frequency *= speed / system.speed;
  }
  system.speed = speed;
  return system;
}

std::vector<RotatingLoad> rotating_loads(const RubSystem& system) {
  constexpr double kSame = 1e-9;
  std::vector<RotatingLoad> all;
  const auto add = [&](const RotatingLoad& load) {
    if (load.load.isZero(0.0)) return;
    for (RotatingLoad& other : all) {
      if (std::abs(other.frequency - load.frequency) <= kSame * std::abs(load.frequency)) {
        other.load += load.load;
        return;
      }
    }
    all.push_back(load);
  };
  for (const RotatingLoad& force : system.forces) add(force);
  add({system.speed, system.speed * system.speed * system.unbalance});
  return all;
}

Eigen::MatrixXcd dynamic_stiffness(const RubSystem& s, double nu) {
  Eigen::MatrixXcd d = s.stiffness.cast<Complex>();
  d += (nu * s.speed) * s.gyroscopic.cast<Complex>();
  d += (kI * nu) * s.damping.cast<Complex>() + (kI * (nu - s.speed)) * s.internal.cast<Complex>();
  d.diagonal() -= (nu * nu) * s.mass.cast<Complex>();
  return d;
}

Eigen::VectorXcd response(const RubSystem& s, double nu, const Eigen::VectorXcd& load) {
  return lu_solve(dynamic_stiffness(s, nu), load);
}

Complex ring_stiffness(const RubSystem& s, double nu) {
  assert(s.ring);
  return s.ring->stiffness - s.ring->mass * nu * nu + kI * nu * s.ring->rate();
}

Complex compliance(const RubSystem& s, double nu) {
  const Complex rotor = s.contact.dot(response(s, nu, s.contact.cast<Complex>()));
  return s.ring ? rotor + 1.0 / ring_stiffness(s, nu) : rotor;
}

}  // namespace rotorub::rub
