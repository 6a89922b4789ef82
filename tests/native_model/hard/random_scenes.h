// Random machines: every part is present or not, and every number is within the range that users
// may write.
#pragma once

#include <cmath>
#include <random>

#include "native_model/scene/scene.h"

namespace rotorub::test {

class RandomScenes {
 public:
  explicit RandomScenes(unsigned seed) : random_(seed) {}

  scene::Scene next() {
    scene::Scene s;
    s.name = "random";
    s.run.end = 0.02;
    s.run.output_step = 0.5e-3;
    s.rotor.speed = between(-300.0, 600.0);
    const auto n = static_cast<std::size_t>(1 + random_() % 3);
    scene::RotorModal modal;
    for (std::size_t i = 0; i < n; ++i) {
      const double m = decade(0.3, 5.0), omega = decade(100.0, 1500.0) * double(i + 1);
      const bool round = chance(0.5);
      modal.mass.push_back(m);
      modal.stiffness.push_back(m * omega * omega);
      modal.damping.push_back(between(0.0, 0.1) * m * omega);
      modal.mass_y.push_back(round ? m : m * between(0.6, 1.6));
      modal.stiffness_y.push_back(modal.stiffness.back() * (round ? 1.0 : between(0.6, 1.6)));
      modal.damping_y.push_back(modal.damping.back());
      modal.internal_damping.push_back(0.0);
      modal.gyroscopic.push_back(0.0);
    }
    if (chance(0.3)) modal.internal_damping[0] = between(0.0, 20.0);
    if (chance(0.3)) modal.gyroscopic[0] = between(0.0, 0.3);
    modal.inertia = decade(1e-4, 1e-2);
    s.rotor.modal = modal;
    if (chance(0.3)) add_torsion(s);
    if (chance(0.5)) add_drive(s);
    add_contact(s);
    if (chance(0.6)) add_ring(s);
    const int forces = static_cast<int>(random_() % 3);
    for (int i = 0; i < forces; ++i) add_force(s);
    if (chance(0.2)) {
      s.magnetic_bearings = {
          scene::MagneticBearing{0.0, {}, between(0.0, 0.5) * s.rotor.modal->stiffness[0]}};
    }
    if (chance(0.3)) s.gravity = scene::Gravity{{0.0, -9.81}, {}};
    const double reach = 0.9 * s.first().contact->clearance / std::sqrt(2.0);
    s.initial.x.assign(n, between(-reach, reach) / double(n));
    s.initial.y.assign(n, between(-reach, reach) / double(n));
    s.initial.vx.assign(n, between(-0.5, 0.5) / double(n));
    s.initial.vy.assign(n, between(-0.5, 0.5) / double(n));
    return s;
  }

  double between(double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random_);
  }
  double decade(double a, double b) { return std::exp(between(std::log(a), std::log(b))); }
  bool chance(double p) { return between(0.0, 1.0) < p; }

 private:
  void add_torsion(scene::Scene& s) {
    scene::Torsion torsion;
    torsion.inertia = {decade(1e-4, 1e-2)};
    const double omega = decade(200.0, 2000.0);
    torsion.stiffness = {torsion.inertia[0] * omega * omega};
    torsion.damping = {between(0.0, 0.05) * torsion.inertia[0] * omega};
    torsion.drive_shape = {between(-1.0, 1.0)};
    s.rotor.torsion = torsion;
  }
  void add_drive(scene::Scene& s) {
    scene::Drive drive;
    const auto kind = random_() % 3;
    drive.kind = kind == 0   ? scene::DriveKind::kFree
                 : kind == 1 ? scene::DriveKind::kLinear
                             : scene::DriveKind::kKloss;
    drive.gain = between(0.0, 0.5);
    drive.speed = s.rotor.speed;
    drive.breakdown_torque = between(0.1, 5.0);
    drive.breakdown_slip = between(0.05, 0.4);
    drive.synchronous_speed = between(100.0, 400.0);
    s.drive = drive;
  }
  void add_contact(scene::Scene& s) {
    scene::Contact contact;
    contact.radius = between(0.01, 0.08);
    contact.clearance = decade(5e-5, 1e-3);
    contact.friction = chance(0.1) ? 0.0 : chance(0.1) ? between(1.0, 10.0) : between(0.0, 0.6);
    contact.restitution = chance(0.1) ? 0.0 : between(0.0, 0.97);
    if (chance(0.3)) contact.tangential_restitution = between(0.0, 1.0);
    s.first().contact = contact;
  }
  void add_ring(scene::Scene& s) {
    const double m = decade(0.2, 5.0), k = decade(1e4, 1e6),
                 d = between(0.0, 0.2) * std::sqrt(m * k);
    s.first().stator = scene::Stator{{m, m}, {d, d}, {k, k}};
    if (chance(0.4)) s.first().stator->mass.y() *= between(0.5, 2.0);
    if (chance(0.4)) s.first().stator->stiffness.y() *= between(0.5, 2.0);
    if (!chance(0.5)) return;
    s.first().actuator = scene::Actuator{.force_limit = chance(0.5) ? between(20.0, 300.0) : 600.0};
    scene::Controller controller;
    controller.kind =
        chance(0.7) ? scene::ControllerKind::kSliding : scene::ControllerKind::kPassive;
    controller.on = chance(0.5) ? 0.0 : between(0.0, 0.01);
    // A sliding law refuses a larger delay (control/radial_tracking.h).
    const bool slides = controller.kind == scene::ControllerKind::kSliding;
    if (chance(0.5)) controller.sample_time = decade(5e-5, slides ? 3e-4 : 1e-3);
    controller.stiffness = between(0.0, 1e5);
    controller.damping = between(0.0, 300.0);
    s.first().controller = controller;
  }
  void add_force(scene::Scene& s) {
    scene::Force force;
    force.kind = chance(0.7) ? scene::ForceKind::kRotating : scene::ForceKind::kConstant;
    force.amplitude = between(0.0, 300.0);
    force.frequency = between(-600.0, 600.0);
    force.phase = between(0.0, 6.0);
    force.vector = {between(-100.0, 100.0), between(-100.0, 100.0)};
    if (chance(0.4)) force.on = between(0.0, 0.01);
    if (chance(0.4)) force.off = between(0.01, 0.02);
    if (chance(0.4)) force.ramp = between(0.0, 0.005);
    s.forces.push_back(force);
  }

  std::mt19937_64 random_;
};

}  // namespace rotorub::test
