// Writes a scene as MJCF with the modal chain: one slide joint per bending mode and plane in
// series, with the modal mass as armature and the modal stiffness and damping on the joint; spin
// and torsion hinges about z; the disc at the end of the chain. Every mode is 1 at the contact
// station, so the disc's position is the sum of the modal coordinates, and MuJoCo's coordinates
// equal those of the native model exactly (the links have a mass of 1e-12 kg). Modes with a node at
// the contact are on a separate branch. The ring has two slides, and two actuators act on its 45
// degree axes.
//
// <custom> contains the scene's text, so that the plugin needs only this file. Without the plugin
// there is no contact: the geoms of the contact pair never touch, but their bounding spheres do, so
// that MuJoCo calls the pair's collision function in every step.
#pragma once

#include <string>

#include "mjcf/mujoco_version.h"
#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// The whole document for a version of MuJoCo (an option was removed in 3.0, and margin and gap
// changed their meaning in 3.9). Throws scene::SceneError for unsupported scenes (RK4; segments of
// a rotor without geometry), with the key and the accepted values.
std::string mjcf(const scene::Scene& scene, const MujocoVersion& target = built_for());

}  // namespace rotorub
