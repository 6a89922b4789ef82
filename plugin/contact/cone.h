// Contact models `cone` and `cone-coulomb` of a scene: MuJoCo's own soft contact with its friction
// cone, elliptic or a pyramid. Where the spin is held constant and so is no degree of freedom, the
// slip that MuJoCo does not see, r Omega, is put into the reference of the tangential rows. `cone`
// may have a friction reference of its own, a_ref,T = -B_t v_slip, which MuJoCo has since 2.3.7
// (solreffriction); `cone-coulomb` is corrected for sliding (cone_correction.h).
#pragma once

#include <mujoco/mujoco.h>

namespace rotorub::plugin {

// surface_speed: m/s, r Omega of the spin that is held. Of a contact with friction rows.
void add_held_slip(double surface_speed, const mjModel* m, mjData* d, const mjContact& contact);

// aref = -B_t v of the friction rows, B_t in 1/s.
void set_friction_reference(const mjModel* m, mjData* d, const mjContact& contact,
                            double reference);

}  // namespace rotorub::plugin
