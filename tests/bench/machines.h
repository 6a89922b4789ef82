// Machines to time: a plain rub, and the same with one further part or with more modes.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/scene.h"
#include "tests/support/native_run.h"

namespace rotorub::bench {

using test::shipped;

// Two modes in a fixed ring, spin held, one rotating force: bounces, then rubs for good.
inline scene::Scene plain() {
  scene::Scene s;
  s.name = "plain";
  s.run.end = 0.1;
  s.rotor.speed = 300.0;
  scene::RotorModal modal;
  modal.mass = modal.mass_y = {2.0, 0.8};
  modal.stiffness = modal.stiffness_y = {2e5, 3e6};
  modal.damping = modal.damping_y = {60.0, 100.0};
  modal.internal_damping = modal.gyroscopic = {0.0, 0.0};
  modal.inertia = 1e-3;
  s.rotor.modal = modal;
  scene::Contact contact;
  contact.radius = 0.05;
  contact.clearance = 0.5e-3;
  contact.friction = 0.1;
  contact.restitution = 0.3;
  s.first().contact = contact;
  scene::Force force;
  force.kind = scene::ForceKind::kRotating;
  force.amplitude = 150.0;
  force.frequency = 314.0;
  s.forces.push_back(force);
  return s;
}

struct Part {
  const char* name;
  std::function<Model()> make;
};

inline std::vector<Part> parts() {
  const auto with = [](const std::function<void(scene::Scene&)>& change) {
    return [change] {
      scene::Scene s = plain();
      change(s);
      return prepare(s);
    };
  };
  const auto model_with = [](const std::function<void(Model&)>& change) {
    return [change] {
      Model m = prepare(plain());
      change(m);
      return m;
    };
  };
  const ModeShape shape{Eigen::Vector2d(0.4, -0.7), Eigen::Vector2d(0.4, -0.7)};
  const auto drive = [](scene::Scene& s) {
    s.drive = scene::Drive{};
    s.drive->kind = scene::DriveKind::kLinear;
    s.drive->gain = 0.5;
    s.drive->speed = 300.0;
  };
  return {
      {"plain", with([](scene::Scene&) {})},
      {"no_contact", with([](scene::Scene& s) { s.first().contact.reset(); })},
      {"second_force", with([](scene::Scene& s) {
         s.forces.push_back(s.forces[0]);
         s.forces[1].frequency = -200.0;
         s.forces[1].amplitude = 5.0;
       })},
      {"torsion", with([](scene::Scene& s) {
         s.rotor.torsion = scene::Torsion{0, 0.0, {4e-4}, {60.0}, {0.02}, {0.0}};
       })},
      {"gyroscopic_diagonal", with([](scene::Scene& s) {
         s.rotor.modal->gyroscopic = {0.05, 0.02};
       })},
      {"gyroscopic_full", model_with([](Model& m) {
         m.gyroscopic = ModeMatrix(Eigen::Matrix2d{{0.05, 0.01}, {0.01, 0.02}});
       })},
      {"internal_damping", with([](scene::Scene& s) {
         s.rotor.modal->internal_damping = {10.0, 20.0};
       })},
      {"unbalance_held_spin", model_with([=](Model& m) {
         m.unbalances.push_back({shape, 4e-5, 0.3});
       })},
      {"bearing_damper", model_with([=](Model& m) {
         m.dampers.push_back({shape, {20.0, 20.0}});
       })},
      {"magnetic_bearing", with([](scene::Scene& s) {
         s.magnetic_bearings = {scene::MagneticBearing{0.0, {0.8, -1.3}, 2e4}};
       })},
      {"gravity", with([](scene::Scene& s) {
         s.gravity = scene::Gravity{{0.0, -9.81}, {}};
       })},
      {"ring", with([](scene::Scene& s) {
         s.first().stator = scene::Stator{{1.0, 1.0}, {200.0, 200.0}, {1e5, 1e5}};
       })},
      {"drive_linear", with(drive)},
      {"drive_kloss", with([](scene::Scene& s) {
         s.drive = scene::Drive{};
         s.drive->kind = scene::DriveKind::kKloss;
         s.drive->breakdown_torque = 5.0;
         s.drive->breakdown_slip = 0.2;
         s.drive->synchronous_speed = 314.0;
       })},
      {"drive_and_unbalance",
       [=] {
         scene::Scene s = plain();
         drive(s);
         Model m = prepare(s);
         m.unbalances.push_back({shape, 4e-5, 0.3});
         return m;
       }},
  };
}

// n modes of equal mass spread over one decade of frequency, so that the steps of `event` do not
// shrink as modes are added, and the result is the cost of the modes alone.
inline scene::Scene with_modes(int n) {
  scene::Scene s = plain();
  scene::RotorModal& m = *s.rotor.modal;
  m = scene::RotorModal{};
  m.inertia = 1e-3;
  for (int i = 0; i < n; ++i) {
    const double mass = 2.0 * n / 2.0,
                 omega = 316.0 * std::pow(10.0, double(i) / std::max(1, n - 1));
    m.mass.push_back(mass);
    m.stiffness.push_back(mass * omega * omega);
    m.damping.push_back(0.1 * mass * omega);
  }
  m.mass_y = m.mass;
  m.stiffness_y = m.stiffness;
  m.damping_y = m.damping;
  m.internal_damping.assign(m.mass.size(), 0.0);
  m.gyroscopic.assign(m.mass.size(), 0.0);
  s.forces[0].amplitude = 150.0 * n / 2.0;
  return s;
}

}  // namespace rotorub::bench
