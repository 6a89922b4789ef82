// Disc in ring, exactly: MuJoCo's collision function of the contact pair.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

// Fills con[0] where the gap is below the pair's margin, and returns the number of contacts (0, 1).
// dist is the gap g_N (negative: penetration), the frame (e_r, e_t, e_z) seen from the rotor's geom
// (turned where it is the second), the position the rotor's surface point, so that the lever arm of
// friction about the rotor's axis is its radius. con: at least one, uninitialised; g1: the first
// geom.
int collide_annular(const Config& config, const mjData* d, CollisionContact* con, int g1,
                    double margin);

// mu of the pair. MuJoCo raises a smaller one to mjMINMU: what stands there is meant as 0.
inline double friction_of(const mjContact& contact) {
  return contact.friction[0] > mjMINMU ? contact.friction[0] : 0.0;
}

// The contact of the two geoms in this forward pass, or null: none, or not handed to the solver.
const mjContact* find_contact(int rotor_geom, int ring_geom, const mjData* d);

}  // namespace rotorub::plugin
