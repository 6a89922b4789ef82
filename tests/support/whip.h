// The whip of a one-mode rotor on an elastic ring, and starts on its circular motions.
#pragma once

#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"
#include "tests/support/oracles/elastic_whip.h"

namespace rotorub::test {

// For an isotropic scene in modal form with one mode.
inline oracle::ElasticWhip whip_of(const scene::Scene& s) {
  const scene::RotorModal& r = *s.rotor.modal;
  const scene::Stator& ring = *s.first().stator;
  return {{r.mass[0], r.damping[0], r.stiffness[0]},
          {ring.mass.x(), ring.damping.x(), ring.stiffness.x()},
          s.first().contact->clearance};
}

// The scene started on the backward whirl at nu, rad/s.
inline scene::Scene whirling(scene::Scene s, double nu) {
  const oracle::CircularWhirl w = whip_of(s).whirl(nu);
  s.initial.x = {w.rotor.real()};
  s.initial.y = {w.rotor.imag()};
  s.initial.vx = {w.rotor_velocity.real()};
  s.initial.vy = {w.rotor_velocity.imag()};
  s.first().stator->position = {w.stator.real(), w.stator.imag()};
  s.first().stator->velocity = {w.stator_velocity.real(), w.stator_velocity.imag()};
  return s;
}

// Whirl speed of the rotor around the ring's centre at a row, rad/s, negative for backward whirl.
inline double whirl_speed(const Trajectory& t, std::size_t row) {
  const auto relative = [&](const char* rotor, const char* ring) {
    return t.column(rotor)[row] - t.column(ring)[row];
  };
  const double x = relative("rotor_x", "stator_x"), y = relative("rotor_y", "stator_y");
  const double vx = relative("rotor_vx", "stator_vx"), vy = relative("rotor_vy", "stator_vy");
  return (x * vy - y * vx) / (x * x + y * y);
}

}  // namespace rotorub::test
