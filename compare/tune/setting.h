// What MuJoCo can be set to for a scene, and the settings that are looked at.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub::tune {

// `solver` and `stiffness` are of the soft contacts alone: `rigid` leaves both at their defaults.
struct Setting {
  scene::ContactModel contact = scene::ContactModel::kRigid;
  scene::MujocoIntegrator integrator = scene::MujocoIntegrator::kEuler;
  scene::MujocoSolver solver = scene::MujocoSolver::kNewton;
  double stiffness = 0.0;           // 1/s^2, solref_stiffness; 0: chosen from the step
  double step = 0.0;                // s, > 0
  double damping = 0.0;             // 1/s, solref_damping; 0: that of the restitution
  double friction_reference = 0.0;  // 1/s, of `cone` alone; 0: MuJoCo's
  bool operator==(const Setting&) const = default;
};

const char* to_string(scene::MujocoIntegrator integrator);
const char* to_string(scene::MujocoSolver solver);

// "cone, implicit, K 1e+08, B_t 10, 50 µs": what is not the default beside contact and step.
std::string text(const Setting& setting);

// A value of a scene; empty: the key is to go.
struct KeyValue {
  std::string table, key, value;
  bool is_default = false;  // need not stand in a scene
};
// As overrides of a scene, without its step.
std::vector<std::string> overrides(const Setting& setting);

// All that are tried at each step (their `step` is 0): contact x integrator, of the soft contacts
// solvers, stiffnesses and dampings, of `cone` friction references; and what the scene itself says.
std::vector<Setting> variants(const scene::Mujoco& own);

// A scene's text with some values replaced, its comments and its order kept. Replaces the value of
// a key where its table has one, a comment behind it kept; else adds the key to its table, the
// table at the end where there is none; takes a line away where the value is empty. Defaults are
// not added. Knows tables that stand under a header of their own ("[run]"), as nearly all do.
std::string with_values(const std::string& toml, const std::vector<KeyValue>& values);

// The text of `toml` (a whole scene) in this setting, judged against `event`: by with_values where
// that reads as the same setting, else written anew from the tree, without comments. `name`: of the
// scene's file.
struct TunedText {
  std::string text;
  bool comments_kept = true;
};
TunedText tuned_text(const std::string& toml, const std::string& name, const Setting& setting);

}  // namespace rotorub::tune
