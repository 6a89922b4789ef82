// mjModel is the one truth: what MuJoCo has of a scene's numbers is taken from there, edited in the
// XML or while it runs. What it has no place for (gyroscopics, loads, laws, mode shapes) is the
// scene's; where its bodies and joints no longer carry those, they are refused.
//
//   armature, stiffness, damping of the joints      modal masses, stiffnesses, dampings; the
//                                                   ring's (an armature edited in mjModel counts
//                                                   after mj_setConst, as it does for MuJoCo)
//   <option gravity>, its disable flag              [gravity]
//   friction[0] of the <pair>                       contact.friction
//   size[0] of the geoms "rotor" and "ring"         contact.radius, and with it the clearance
//   ctrlrange of the two actuators                  force or current limit
// and of a user's own model
//   size of the geoms of rotor and ring             radius and lengths, where no number gives them
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// Whether config.model is m's. Some fifty comparisons: for every step.
bool has_parameters(const Config& config, const mjModel* m);

// Puts m's numbers into config.model (and the shadow's), where they are others. Throws ConfigError
// for those that no rotor has, and for mass on the rotor's bodies.
void take_parameters(const mjModel* m, Config& config);

// Finds where they are. Throws ConfigError where bodies, joints and actuators of a generated file
// do not move as the scene's mode shapes and axes say.
void map_structure(const mjModel* m, Config& config);

}  // namespace rotorub::plugin
