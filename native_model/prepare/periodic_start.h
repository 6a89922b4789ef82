// Starts near rubs: those of closed forms (rub_start.h), and those to which shooting leads where no
// closed form holds (native_model/periodic).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/forward.h"

namespace rotorub::rub {

struct NamedStart {
  std::string name;
  State state;
};

// Starts from which runs of the scene may settle to rubs: its own, the closed forms' synchronous
// rub and whip of the machine without weight, and a backward whirl if there is no such whip. model:
// of the scene.
std::vector<NamedStart> starts_near_rubs(const scene::Scene& scene, const Model& model);

// The state at t = 0 on a stable periodic rub of the kind `[initial] rub`, in the model of the
// scene without its start. All loads and controllers of the scene must act from t = 0 on. If runs
// from the starts near rubs settle to none, it throws no_form with what was found added to its
// reason.
State state_on_periodic_rub(const scene::Scene& scene, const scene::SceneError& no_form);

}  // namespace rotorub::rub
