// What `rotorub modes` says of a rotor: whirl at given spin speeds, critical speeds, and the
// threshold of stability, as JSON (public contract) and as text. No contact, small deflections.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {

// speeds: rad/s, of either sign; none: the scene's own rotor.speed. Both throw scene::SceneError
// for a rotor without modes (modal_rotor.h), std::runtime_error where an eigenvalue iteration
// fails.

// {"speeds": [{"speed", "modes": [{"frequency", "damping_ratio"}]}], "critical_speeds": [],
// "stability_threshold": null, "stability_bound"}: rad/s; forward whirl positive, backward
// negative; modes by rising absolute frequency. No threshold up to the bound: null; a bound of
// null: nothing can grow at any speed.
nlohmann::json modes_json(const scene::Scene& scene, const std::vector<double>& speeds);

// The same for people, with Hz and rpm; ends with a line break.
std::string modes_table(const scene::Scene& scene, const std::vector<double>& speeds);

}  // namespace rotorub
