// Scenes with two contacts: those in tests/native_model/event/two_rings with the results of an
// independent program (README.md there), and a rigid shaft.
#pragma once

#include <fstream>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

#include "native_model/scene/reader.h"
#include "native_model/trajectory/trajectory.h"
#include "tests/support/jeffcott.h"

namespace rotorub::test {

inline std::string two_rings_file(const std::string& name) {
  return std::string(ROTORUB_SOURCE_DIR) + "/tests/native_model/event/two_rings/" + name;
}

inline scene::Scene two_rings_scene(const std::string& name) {
  return scene::read_scene(two_rings_file(name + ".toml"));
}

// A rigid shaft: mode 1 is its translation, mode 2 its tilt with the values 1 at the first contact
// and `tilt` at the second.
inline scene::Scene shaft_in_two_rings(double mass, double tilt_mass, double tilt,
                                       const Jeffcott& of = {}) {
  scene::Scene s = make_scene(of);
  s.rotor.modal->mass = {mass, tilt_mass};
  s.rotor.modal->stiffness = {of.stiffness, of.stiffness};
  s.rotor.modal->damping = {of.damping, of.damping};
  s.auxiliary.push_back(s.first());
  s.auxiliary[1].contact->shape = {1.0, tilt};
  return s;
}

// At rest on both rings under 20 N at twice the lever arm of the first contact: the first ring
// pushes up with 30 N, the second down with 10 N, which only balances the other force.
inline scene::Scene lever_in_two_rings(std::span<const std::string> overrides = {}) {
  return scene::parse_scene(R"([run]
end = 0.02
step = 1e-5
[rotor]
speed = 100.0
[rotor.modal]
mass = [2.0, 8.0]
stiffness = [0.0, 0.0]
damping = [0.0, 0.0]
[initial]
y = [0.0, -0.0005]
[[contact]]
radius = 0.05
clearance = 0.0005
friction = 0.0
restitution = 0.5
[[contact]]
radius = 0.05
clearance = 0.0005
friction = 0.0
restitution = 0.5
shape = [1.0, -1.0]
[[force]]
kind = "constant"
vector = [0.0, -20.0]
shape = [1.0, 2.0]
)",
                            "lever", overrides);
}

inline nlohmann::json two_rings_answer(const std::string& name) {
  std::ifstream in(two_rings_file("expected.json"));
  return nlohmann::json::parse(in).at(name);
}

// A state as the independent program defines it: the ring's position relative to its unloaded
// spring.
inline double state_of(const Trajectory& t, const scene::Scene& scene, const std::string& column,
                       std::size_t row) {
  const double found = t.column(column)[row];
  const std::size_t ring = column.starts_with("contact2_") ? 1 : 0;
  const Eigen::Vector2d offset = scene.auxiliary[ring].contact->offset;
  if (column.ends_with("stator_x")) return found - offset.x();
  if (column.ends_with("stator_y")) return found - offset.y();
  return found;
}

}  // namespace rotorub::test
