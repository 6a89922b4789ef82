// The bodies of a generated MJCF: the rotor with the modal chain, the branch of modes with a node
// at the contact, the rings, and the ghosts of the shadow.
#pragma once

#include <vector>

#include "mjcf/mujoco_version.h"
#include "mjcf/xml.h"
#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

void write_bodies(XmlWriter& xml, const scene::Scene& scene, const Model& model,
                  const MujocoVersion& target);
// Only the rings, their supports and the integrators of magnetic bearings, for a rotor that is
// written by other code.
void write_beside_the_rotor(XmlWriter& xml, const scene::Scene& scene, const Model& model,
                            const MujocoVersion& target);

// The visible disc of the rotor at an auxiliary bearing, and its geom of the contact pair.
void write_rotor_disc(XmlWriter& xml, const scene::Scene& scene, std::size_t bearing);

// The index in q of each of MuJoCo's coordinates, in the order chain, branch, rings, supports,
// integrators. It is the layout's own order if there is no branch.
std::vector<int> joint_order(const Model& model);
// The part of joint_order that belongs to write_beside_the_rotor.
std::vector<int> order_beside_the_rotor(const Model& model);

// Radius of the drawn disc at an auxiliary bearing, m.
double drawn_radius(const scene::Scene& scene, std::size_t bearing = 0);

// The ghosts: bodies that show the shadow's rotor and ring. The plugin moves them; without it they
// stay at the start. They do not affect the motion.
void write_ghosts(XmlWriter& xml, const scene::Scene& scene, const Model& model);

}  // namespace rotorub
