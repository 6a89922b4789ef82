// MuJoCo's settings for a scene, and the ones that tune tries.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub::tune {

// solver and stiffness apply only to soft contacts; `rigid` leaves both at their defaults.
struct Setting {
  scene::ContactModel contact = scene::ContactModel::kRigid;
  scene::MujocoIntegrator integrator = scene::MujocoIntegrator::kEuler;
  scene::MujocoSolver solver = scene::MujocoSolver::kNewton;
  double stiffness = 0.0;           // 1/s^2, solref_stiffness; 0: chosen from the step
  double step = 0.0;                // s, > 0
  double damping = 0.0;             // 1/s, solref_damping; 0: chosen from the restitution
  double friction_reference = 0.0;  // 1/s, only for `cone`; 0: MuJoCo's
  bool operator==(const Setting&) const = default;
};

const char* to_string(scene::MujocoIntegrator integrator);
const char* to_string(scene::MujocoSolver solver);

// "cone, implicit, K 1e+08, B_t 10, 50 µs": contact, step, and the values that are not defaults.
std::string text(const Setting& setting);

// A value of a scene; if it is empty, the key is removed.
struct KeyValue {
  std::string table, key, value;
  bool is_default = false;  // may be omitted from a scene
};
// The setting as overrides of a scene, without the step.
std::vector<std::string> overrides(const Setting& setting);

// All variants that are tried at each step (their `step` is 0): contact x integrator, for soft
// contacts also solvers, stiffnesses and dampings, for `cone` also friction references; and the
// scene's own setting.
std::vector<Setting> variants(const scene::Mujoco& own);

// Replaces some values in a scene's text and keeps its comments and its order. A key in its table
// is replaced, with a comment after it kept; a missing key is added to its table, and a missing
// table at the end; an empty value removes the line. Defaults are not added. Only tables under
// their own header ("[run]") are recognised, as nearly all are.
std::string with_values(const std::string& toml, const std::vector<KeyValue>& values);

// The text of `toml` (a whole scene) in this setting, judged against `event`: from with_values if
// the result reads as the same setting, otherwise rewritten without comments. name: of the scene's
// file. libraries: overrides with the paths of its libraries, if they change.
struct TunedText {
  std::string text;
  bool comments_kept = true;
};
TunedText tuned_text(const std::string& toml, const std::string& name, const Setting& setting,
                     const std::vector<std::string>& libraries = {});

}  // namespace rotorub::tune
