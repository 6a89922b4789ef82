// Checks of a user's own machine before it is compared. What the native model cannot do is refused
// by a plugin::ConfigError.
#pragma once

#include <mujoco/mujoco.h>

#include <string>
#include <vector>

#include "plugin/model/config.h"

namespace rotorub {

// A run starts from the keyframe "start" or "test" and would ignore other keyframes.
void check_keyframes(const mjModel* m);
// The reason for a pair without the text of its contact model.
inline constexpr const char* kNoContactText =
    "missing; add it with data=\"rigid\", the default that the file uses now, so that the "
    "comparison can replace it by the other contact models";
// Every pair must have this text.
void check_contact_texts(const mjModel* m);
// The native model cannot start with a rotor outside of its ring.
void check_starts(const mjModel* m, const plugin::Config& config);
// The twin has no constraints, so a rotor driven or a ring held by an equality would be a different
// machine there.
void check_equalities(const mjModel* m, const plugin::Config& config);
// Adds a sentence to `limits` for each clearance that differs from the drawn one, which may be a
// mistake.
void add_drawn_clearances(const mjModel* m, const plugin::Config& config,
                          std::vector<std::string>& limits);

}  // namespace rotorub
