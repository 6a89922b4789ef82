#include "native_model/system/model.h"

#include <cassert>
#include <cmath>
#include <utility>

#include "native_model/system/dynamics.h"

namespace rotorub {
namespace {

Layout make_layout(const scene::Scene& scene, const ModalRotor& rotor) {
  Layout layout;
  layout.modes = rotor.modes();
  layout.spin = scene.drive ? 1 : 0;
  layout.torsion = static_cast<int>(rotor.torsion.inertia.size());
  layout.stator = scene.stator ? 2 : 0;
  return layout;
}

// The diagonals of mass, stiffness and damping in the order of the layout.
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
  if (l.stator) put(l.ring(), scene.stator->mass, scene.stator->stiffness, scene.stator->damping);
  assert(l.modes > 0);
}

void fill_loads(const scene::Scene& scene, const ModalRotor& rotor, Model& model) {
  const Layout& l = model.layout;
  assert(rotor.force_shapes.size() == scene.forces.size());
  for (std::size_t i = 0; i < scene.forces.size(); ++i) {
    const scene::Force& f = scene.forces[i];
    model.forces.push_back({f.kind, f.amplitude, f.frequency, f.phase, f.vector, f.on, f.off,
                            f.ramp, rotor.force_shapes[i]});
  }
  if (scene.magnetic_bearing && rotor.magnetic_bearing_shape) {
    const double k = -scene.magnetic_bearing->negative_stiffness;
    model.springs.push_back({*rotor.magnetic_bearing_shape, {k, k}});
  }
  if (scene.gravity) {
    const Eigen::Vector2d& g = scene.gravity->acceleration;
    model.weight = Eigen::VectorXd::Zero(l.nq());
    model.weight.segment(l.x(), l.modes) = g.x() * rotor.gravity_x;
    model.weight.segment(l.y(), l.modes) = g.y() * rotor.gravity_y;
    if (l.stator) model.weight.segment<2>(l.ring()) = g.cwiseProduct(scene.stator->mass);
  }
}

void fill_control(const scene::Scene& scene, Model& model) {
  if (!scene.controller || !scene.stator || !scene.contact) return;
  const Plant plant{scene.contact->clearance, scene.stator->mass, scene.stator->damping,
                    scene.stator->stiffness};
  model.controller = make_controller(scene, plant);
  model.control_on = scene.controller->on;
  model.sample_time = scene.controller->sample_time;
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
  if (l.stator) {
    model.q0.segment<2>(l.ring()) = initial.stator;
    model.v0.segment<2>(l.ring()) = initial.stator_velocity;
  }
  model.speed = scene.rotor.speed;
  model.spin_angle = initial.spin_angle;
}

}  // namespace

Eigen::Vector2d AppliedForce::at(double t) const {
  const double factor = envelope(t);
  if (factor == 0.0) return {0.0, 0.0};
  if (kind == scene::ForceKind::kConstant) return factor * vector;
  const double angle = frequency * t + phase;
  return factor * amplitude * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

Model make_model(const scene::Scene& scene) {
  ModalRotor rotor = modal_rotor(scene);
  Model model;
  model.layout = make_layout(scene, rotor);
  fill_diagonals(scene, rotor, model);
  fill_loads(scene, rotor, model);
  model.gyroscopic = ModeMatrix(rotor.gyroscopic);
  model.internal_xx = ModeMatrix(rotor.internal_xx);
  model.internal_xy = ModeMatrix(rotor.internal_xy);
  model.internal_yy = ModeMatrix(rotor.internal_yy);
  for (StationDamper& damper : rotor.bearing_dampers) {
    if (!damper.damping.isZero(0.0)) model.dampers.push_back(std::move(damper));
  }
  for (DiscUnbalance& unbalance : rotor.unbalances) {
    if (unbalance.static_moment != 0.0) model.unbalances.push_back(std::move(unbalance));
  }
  if (scene.drive) model.drive.emplace(*scene.drive);
  model.drive_shape = rotor.torsion.drive_shape;
  model.torsion_contact = rotor.torsion.contact_shape;
  model.contact_shape = rotor.contact_shape;
  model.lines = std::move(rotor.lines);
  if (scene.contact) {
    const scene::Contact& c = *scene.contact;
    model.contact = ContactParameters{c.radius,           c.clearance,
                                      c.friction,         c.restitution,
                                      c.tangential_restitution, c.compression_time,
                                      c.expansion_time};
  }
  model.force_limit = scene.actuator.value_or(scene::Actuator{}).force_limit;
  fill_initial(scene, model);
  fill_control(scene, model);
  model.admittance = contact_admittance(model, model.mass.data(), 0.0, model.q0.data());
  return model;
}

State initial_state(const Model& model) { return {0.0, model.q0, model.v0}; }

}  // namespace rotorub
