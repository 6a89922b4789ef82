// Numbers of a scene that mjModel contains are taken from there, also if they were edited in the
// XML or during a run. Numbers for which MuJoCo has no place (gyroscopics, loads, laws, mode
// shapes) come from the scene. If bodies and joints were changed so that they no longer fit the
// mode shapes, the model is refused.
//
//   armature, stiffness, damping of the joints      modal masses, stiffnesses, dampings; those of
//                                                   the ring (an armature edited in mjModel counts
//                                                   after mj_setConst, as it does for MuJoCo)
//   <option gravity>, its disable flag              [gravity]
//   friction[0] of the <pair>                       contact.friction
//   size[0] of the geoms "rotor" and "ring"         contact.radius, and with it the clearance
//   ctrlrange of the two actuators                  force or current limit
// and in a user's own model
//   size of the geoms of rotor and ring             radius and lengths that no number defines
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// True if config.model has m's numbers. It makes about fifty comparisons, in every step.
bool has_parameters(const Config& config, const mjModel* m);

// Puts m's numbers into config.model (and the shadow's) if they differ. Throws ConfigError for
// impossible numbers and for mass on the rotor's bodies.
void take_parameters(const mjModel* m, Config& config);

// Finds the geoms with these numbers and the rotor's bodies, and checks the structure.
void map_structure(const mjModel* m, Config& config);

// Throws ConfigError if bodies, joints and actuators of a generated file do not move as the scene's
// mode shapes and axes require. The fingerprint does not contain their places and axes. So every
// model is checked when a config is looked up for it: for each new or reset mjData.
void check_structure(const mjModel* m, const Config& config);

}  // namespace rotorub::plugin
