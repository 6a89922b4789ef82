#include "native_model/model/model.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "native_model/model/dynamics.h"
#include "native_model/model/equations.h"
#include "native_model/model/magnetic_bearings.h"
#include "native_model/model/model_checks.h"
#include "native_model/model/ring_actuation.h"
#include "native_model/scene/record.h"

namespace rotorub {
namespace {

// kg, mass of a coordinate whose velocity is the state of a feedback or of a dry-friction bristle.
// A load of this mass times the state's rate drives it, so that every integrator of the coordinates
// also integrates the state. The mass is small enough not to matter in sums over all coordinates,
// and large enough that the weight of the 1e-12 kg that MuJoCo needs for a body does not matter.
constexpr double kStateMass = 1e-3;

Layout make_layout(const scene::Scene& scene, const ModalRotor& rotor,
                   const std::vector<SampledFeedback>& samplers) {
  Layout layout;
  layout.modes = rotor.modes();
  layout.spin = scene.drive ? 1 : 0;
  layout.torsion = static_cast<int>(rotor.torsion.inertia.size());
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    if (!bearing.stator) continue;
    layout.stator += 2;
    layout.ring_spin += bearing.stator->spin ? 1 : 0;
    layout.stator += bearing.stator->mount ? 2 : 0;
    layout.bristles += bearing.stator->dry_friction ? 2 : 0;
    layout.bristles += bearing.stator->spin && bearing.stator->spin->drags() ? 1 : 0;
    layout.coils += bearing.actuator && bearing.actuator->coil_lag > 0.0 ? 2 : 0;
  }
  layout.feedback_states = feedback_states(scene, samplers);
  return layout;
}

// Sets the contact and the coordinates of each bearing, one ring after the other.
void fill_auxiliary(const scene::Scene& scene, const ModalRotor& rotor, Model& model) {
  const Layout& l = model.layout;
  int ring = l.ring(), angle = l.ring_angle(), coil = l.coil();
  model.auxiliary.resize(scene.auxiliary.size());
  assert(rotor.contacts.size() == scene.auxiliary.size());
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const scene::AuxiliaryBearing& from = scene.auxiliary[k];
    AuxiliaryBearing& to = model.auxiliary[k];
    to.name = scene.name_of(k);
    to.shape = rotor.contacts[k];
    to.torsion_shape = rotor.torsion.contacts[k];
    if (from.stator) {
      to.ring = std::exchange(ring, ring + 2);
      if (from.stator->mount) to.housing = std::exchange(ring, ring + 2);
      if (from.stator->spin) to.ring_angle = angle++;
      if (from.actuator && from.actuator->coil_lag > 0.0) to.coil = std::exchange(coil, coil + 2);
    }
    if (!from.contact) continue;
    const scene::Contact& c = *from.contact;
    to.contact = ContactParameters{
        c.radius,           c.clearance,     c.friction, c.restitution, c.tangential_restitution,
        c.compression_time, c.expansion_time};
    if (c.compliance) to.contact->compliance = {*c.compliance, c.restitution};
    to.ring_ratio = to.contact->surface_ratio();
    to.ring_offset = c.offset;
  }
}

// Sets the diagonals of mass, stiffness and damping in the order of the layout.
void fill_diagonals(const scene::Scene& scene, const ModalRotor& rotor, Model& model) {
  const Layout& l = model.layout;
  for (auto* vector : {&model.mass, &model.stiffness, &model.damping}) {
    *vector = Eigen::VectorXd::Zero(l.nq());
  }
  const auto put = [&](int at, const Eigen::VectorXd& m, const Eigen::VectorXd& k,
                       const Eigen::VectorXd& d) {
    model.mass.segment(at, m.size()) = m;
    model.stiffness.segment(at, k.size()) = k;
    model.damping.segment(at, d.size()) = d;
  };
  put(l.x(), rotor.x.mass, rotor.x.stiffness, rotor.x.damping);
  put(l.y(), rotor.y.mass, rotor.y.stiffness, rotor.y.damping);
  if (l.spin) model.mass[l.phi()] = rotor.spin_inertia;
  put(l.theta(), rotor.torsion.inertia, rotor.torsion.stiffness, rotor.torsion.damping);
  model.mass.segment(l.bristle(), l.bristles + l.feedback_states).setConstant(kStateMass);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const scene::AuxiliaryBearing& from = scene.auxiliary[k];
    const AuxiliaryBearing& at = model.auxiliary[k];
    if (at.moves()) put(at.ring, from.stator->mass, from.stator->stiffness, from.stator->damping);
    if (at.housing != kAbsent) {
      const scene::Housing& housing = *from.stator->mount;
      put(at.housing, housing.mass, housing.stiffness + from.stator->stiffness,
          housing.damping + from.stator->damping);
    }
    if (at.turns()) {
      model.mass[at.ring_angle] = from.stator->spin->inertia;
      model.damping[at.ring_angle] = from.stator->spin->drag;
    }
    // lag q'' + q' = requested current, with q the charge.
    if (at.coil != kAbsent) model.mass.segment<2>(at.coil).setConstant(from.actuator->coil_lag);
  }
  model.damping.tail(l.coils).setOnes();
  assert(l.modes > 0);
}

// Adds the support of a ring on more than a spring and a damper. bristle: first free bristle.
void add_support(const scene::Stator& ring, std::size_t number, int& bristle, Model& model) {
  const AuxiliaryBearing& at = model.auxiliary[number];
  StationSupport support;
  support.number = number;
  support.ring = at.ring;
  support.housing = at.housing;
  support.stiffness = ring.stiffness;
  support.damping = ring.damping;
  if (ring.ball_bearing) support.law.balls.emplace(*ring.ball_bearing);
  if (ring.squeeze_film) support.law.film.emplace(*ring.squeeze_film);
  if (ring.dry_friction) {
    support.law.dry = ring.dry_friction;
    support.bristle = std::exchange(bristle, bristle + 2);
  }
  if (ring.spin && ring.spin->drags()) {
    support.law.drag = ring.spin;
    support.ring_angle = at.ring_angle;
    support.spin_bristle = bristle++;
  }
  if (support.housing == kAbsent && !support.law.bears() && !support.law.drag) return;
  model.supports.push_back(std::move(support));
}

void fill_loads(const scene::Scene& scene, const ModalRotor& rotor, Model& model) {
  const Layout& l = model.layout;
  assert(rotor.force_shapes.size() == scene.forces.size());
  for (std::size_t i = 0; i < scene.forces.size(); ++i) {
    const scene::Force& f = scene.forces[i];
    if (f.kind == scene::ForceKind::kUnbalance) continue;  // see fill_unbalances
    AppliedForce force{f.kind, f.amplitude, f.frequency,           f.phase,        f.vector, f.on,
                       f.off,  f.ramp,      rotor.force_shapes[i], f.frequency_end};
    if (f.kind == scene::ForceKind::kSynchronous && !scene.drive) {
      force.kind = scene::ForceKind::kRotating;
      force.frequency = scene.rotor.speed;
      force.phase += scene.initial.spin_angle;
    }
    model.forces.push_back(std::move(force));
  }
  add_magnetic_bearings(scene, rotor.magnets, model);
  model.gravity_mass = Eigen::VectorXd::Zero(l.nq());
  model.gravity_mass.segment(l.x(), l.modes) = rotor.gravity_x;
  model.gravity_mass.segment(l.y(), l.modes) = rotor.gravity_y;
  int bristle = l.bristle();
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const AuxiliaryBearing& at = model.auxiliary[k];
    if (!at.moves()) continue;
    const scene::Stator& ring = *scene.auxiliary[k].stator;
    model.gravity_mass.segment<2>(at.ring) = ring.mass;
    if (ring.mount) model.gravity_mass.segment<2>(at.housing) = ring.mount->mass;
    add_support(ring, k, bristle, model);
  }
  if (scene.base) model.base = std::make_shared<const BaseMotion>(*scene.base);
  if (rotor.pull_x.size() > 0) {
    model.pull = Eigen::VectorXd::Zero(l.nq());
    model.pull.segment(l.x(), l.modes) = rotor.pull_x;
    model.pull.segment(l.y(), l.modes) = rotor.pull_y;
  }
  if (scene.gravity || model.pull.size() > 0) {
    set_gravity(model, scene.gravity ? scene.gravity->acceleration : Eigen::Vector2d(0.0, 0.0));
  }
}

// Eccentric discs first, then lost blades.
void fill_unbalances(const scene::Scene& scene, const ModalRotor& rotor, Model& model) {
  for (const DiscUnbalance& unbalance : rotor.unbalances) {
    if (unbalance.static_moment != 0.0) model.unbalances.push_back(unbalance);
  }
  for (std::size_t i = 0; i < scene.forces.size(); ++i) {
    const scene::Force& f = scene.forces[i];
    if (f.kind != scene::ForceKind::kUnbalance || f.static_moment == 0.0) continue;
    model.unbalances.push_back({rotor.force_shapes[i], f.static_moment, f.phase, f.on});
  }
}

// Model::reach.
double reach_of(const scene::Scene& scene) {
  constexpr double kLengths = 10.0, kTimes = 100.0;
  if (scene.rotor.geometry) return kLengths * scene.rotor.geometry->length;
  double size = 0.0;  // m
  for (const scene::AuxiliaryBearing& at : scene.auxiliary) {
    if (at.contact)
      size = std::max(size, at.contact->radius + at.contact->clearance + at.contact->offset.norm());
  }
  for (const scene::MagneticBearing& at : scene.magnetic_bearings) {
    size = std::max(size, at.air_gap);
  }
  return size > 0.0 ? kTimes * size : Model{}.reach;
}

void fill_initial(const scene::Scene& scene, Model& model) {
  const Layout& l = model.layout;
  model.q0 = model.v0 = Eigen::VectorXd::Zero(l.nq());
  const auto put = [](const std::vector<double>& from, int at, Eigen::VectorXd& to) {
    for (std::size_t i = 0; i < from.size(); ++i) to[at + static_cast<int>(i)] = from[i];
  };
  const scene::Initial& initial = scene.initial;
  put(initial.x, l.x(), model.q0);
  put(initial.y, l.y(), model.q0);
  put(initial.vx, l.x(), model.v0);
  put(initial.vy, l.y(), model.v0);
  put(initial.torsion, l.theta(), model.q0);
  put(initial.torsion_speed, l.theta(), model.v0);
  if (l.spin) {
    model.q0[l.phi()] = initial.spin_angle;
    model.v0[l.phi()] = scene.rotor.speed;
  }
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    const std::optional<scene::Stator>& ring = scene.auxiliary[k].stator;
    const AuxiliaryBearing& at = model.auxiliary[k];
    if (!at.moves()) continue;
    model.q0.segment<2>(at.ring) = ring->position;
    model.v0.segment<2>(at.ring) = ring->velocity;
    if (at.turns()) model.v0[at.ring_angle] = ring->spin->speed;
  }
  model.speed = scene.rotor.speed;
  model.spin_angle = initial.spin_angle;
}

}  // namespace

double AppliedForce::angle(double t, double spin) const {
  if (kind == scene::ForceKind::kSynchronous) return spin + phase;
  if (kind != scene::ForceKind::kChirp) return frequency * t + phase;
  // The integral of frequency + (frequency_end - frequency) passed / (off - on).
  const double passed = t - on;
  return phase + (frequency + 0.5 * (frequency_end - frequency) * passed / (off - on)) * passed;
}

Eigen::Vector2d AppliedForce::at(double t, double spin) const {
  const double factor = envelope(t);
  if (factor == 0.0) return {0.0, 0.0};
  if (kind == scene::ForceKind::kConstant) return factor * vector;
  if (kind == scene::ForceKind::kPulse) {
    return std::sin(std::numbers::pi * (t - on) / (off - on)) * vector;
  }
  double sine, cosine;
  sine_cosine(angle(t, spin), sine, cosine);
  return factor * amplitude * Eigen::Vector2d(cosine, sine);
}

Model make_model(const scene::Scene& scene, const std::function<void(Model&)>& start) {
  assert(start || (!scene.initial.steady && scene.initial.rub == scene::StartingRub::kNone));
  // Rejects a model that is certainly too large before the costly reduction of the shaft.
  if (const auto& geometry = scene.rotor.geometry; geometry && geometry->modes) {
    check_size(scene, 2 * *geometry->modes);
  }
  ModalRotor rotor = modal_rotor(scene);
  Model model;
  model.samplers = magnetic_samplers(scene);
  model.layout = make_layout(scene, rotor, model.samplers);
  check_size(scene, model.nq());
  check_initial_lists(scene, model.layout);
  fill_auxiliary(scene, rotor, model);
  fill_diagonals(scene, rotor, model);
  fill_loads(scene, rotor, model);
  model.gyroscopic = ModeMatrix(rotor.gyroscopic);
  model.internal_xx = ModeMatrix(rotor.internal_xx);
  model.internal_xy = ModeMatrix(rotor.internal_xy);
  model.internal_yy = ModeMatrix(rotor.internal_yy);
  for (StationDamper& damper : rotor.bearing_dampers) {
    if (!damper.damping.isZero(0.0)) model.dampers.push_back(std::move(damper));
  }
  model.films = std::move(rotor.films);
  fill_unbalances(scene, rotor, model);
  check_unbalances(scene, model.unbalances.size());
  check_spin_inertia(scene, model);
  if (scene.drive) model.drive.emplace(*scene.drive, scene.rotor.speed);
  model.drive_shape = rotor.torsion.drive_shape;
  model.lines = std::move(rotor.lines);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) fill_actuator(scene, k, model);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) check_initial_ring(scene, k);
  model.reach = reach_of(scene);
  fill_initial(scene, model);
  if (start) start(model);
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) check_initial_gap(scene, model, k);
  if (model.drive) model.drive_angle = equations::at_motor(model, model.q0.data());
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) fill_control(scene, k, model);
  for (std::size_t k = 0; k < model.auxiliary.size(); ++k) {
    model.auxiliary[k].admittance =
        contact_admittance(model, model.mass.data(), 0.0, model.q0.data(), k, k);
  }
  return model;
}

void set_gravity(Model& model, const Eigen::Vector2d& acceleration) {
  const Layout& l = model.layout;
  model.weight = Eigen::VectorXd::Zero(l.nq());
  const auto along = [&](int at, int count, double g) {
    model.weight.segment(at, count) = g * model.gravity_mass.segment(at, count);
  };
  along(l.x(), l.modes, acceleration.x());
  along(l.y(), l.modes, acceleration.y());
  for (int k = 0; k < l.stator; ++k) along(l.ring() + k, 1, acceleration[k % 2]);
  if (model.pull.size() > 0) model.weight += model.pull;
}

State initial_state(const Model& model) { return {0.0, model.q0, model.v0}; }

}  // namespace rotorub
