// Scenes built in code: a one-mode rotor in a ring, for which most exact solutions exist.
#pragma once

#include "native_model/scene/scene.h"

namespace rotorub::test {

struct Jeffcott {
  double mass = 2.0, damping = 0.0, stiffness = 0.0;  // kg, N s/m, N/m
  double clearance = 0.5e-3, radius = 0.05;           // m
  double friction = 0.0, restitution = 0.0;
  double speed = 0.0;  // rad/s, prescribed
};

// A modal scene with [contact], prescribed speed and a fixed ring, at rest at the centre.
inline scene::Scene make_scene(const Jeffcott& j) {
  scene::Scene s;
  s.name = "jeffcott";
  s.rotor.speed = j.speed;
  scene::RotorModal modal;
  modal.mass = {j.mass};
  modal.stiffness = {j.stiffness};
  modal.damping = {j.damping};
  s.rotor.modal = modal;
  scene::Contact contact;
  contact.clearance = j.clearance;
  contact.radius = j.radius;
  contact.friction = j.friction;
  contact.restitution = j.restitution;
  s.first().contact = contact;
  return s;
}

// Replaces the fixed ring by an elastic one.
inline void add_ring(scene::Scene& s, double mass, double damping, double stiffness) {
  s.first().stator = scene::Stator{{mass, mass}, {damping, damping}, {stiffness, stiffness}};
}

inline void add_rotating_force(scene::Scene& s, double amplitude, double frequency,
                               double phase = 0.0) {
  scene::Force f;
  f.kind = scene::ForceKind::kRotating;
  f.amplitude = amplitude;
  f.frequency = frequency;
  f.phase = phase;
  s.forces.push_back(f);
}

inline void add_constant_force(scene::Scene& s, const Eigen::Vector2d& vector) {
  scene::Force f;
  f.kind = scene::ForceKind::kConstant;
  f.vector = vector;
  s.forces.push_back(f);
}

}  // namespace rotorub::test
