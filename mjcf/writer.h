// A scene as MJCF: the modal chain. One slide joint per bending mode and plane in series, with the
// modal mass as armature and the modal stiffness and damping on the joint; spin and torsion hinges
// about z; the disc at the end of the chain. Every mode is 1 at the contact station, so the disc's
// position is the sum of the modal coordinates and MuJoCo's coordinates are those of the native
// model, exactly (its links weigh 1e-12 kg). A mode with a node at the contact sits on a branch of
// its own. The ring has two slides; two actuators pull on its 45 degree axes.
//
// The scene's text stands in <custom>, so that the file alone is enough for the plugin. Without the
// plugin there is no contact at all: the two geoms of the contact pair never touch, only their
// bounding spheres do, which is what makes MuJoCo ask the pair's collision function every step.
#pragma once

#include <string>

#include "mjcf/mujoco_version.h"
#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// The whole document, for that MuJoCo (its dialect: an option that 3.0 took away, and what margin
// and gap have meant since 3.9). Throws std::invalid_argument for what is not offered (RK4;
// segments of a rotor without geometry), naming key and accepted values.
std::string mjcf(const scene::Scene& scene, const MujocoVersion& target = built_for());

}  // namespace rotorub
