// What a user has put on the rotor or the ring of a generated model beside what the writer wrote:
// equalities, limits, friction loss, tendons with either, contacts, and what MuJoCo steps
// implicitly beyond the dampers of the joints. The native step of `rigid` (contact/verlet.h) and
// the diagonal mass of `coulomb` know none of it; such a model takes the general path
// (contact/pairs.h), of first order.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

// Sets config.general where anything can act on a body of the kinematic trees of rotor and ring,
// and warns of what is left out then. `cone` is MuJoCo's own, and knows them.
void choose_path(const mjModel* m, Config& config);

// With `implicit` actuators whose force has a rate (servos), damped tendons, fluid; dampers of
// joints that are no constant with Euler too (contact/step_matrix.h). May change with mjModel:
// Config::damping_added.
bool damping_is_added(const mjModel* m, const Config& config);

}  // namespace rotorub::plugin
