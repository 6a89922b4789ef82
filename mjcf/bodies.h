// The bodies of a generated MJCF: rotor with the modal chain, branch of the modes with a node at
// the contact, ring; and the ghosts of the shadow.
#pragma once

#include <vector>

#include "mjcf/mujoco_version.h"
#include "mjcf/xml.h"
#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

void write_bodies(XmlWriter& xml, const scene::Scene& scene, const Model& model,
                  const MujocoVersion& target);
// Ring and a magnetic bearing's integrator alone, for a rotor that is written otherwise.
void write_beside_the_rotor(XmlWriter& xml, const scene::Scene& scene, const Model& model,
                            const MujocoVersion& target);

// The visible disc of the rotor at an auxiliary bearing, and what stands for it in the contact.
void write_rotor_disc(XmlWriter& xml, const scene::Scene& scene, std::size_t bearing);

// Index in q of each of MuJoCo's coordinates: chain, branch, ring, integrator. The layout's own
// order where there is no branch.
std::vector<int> joint_order(const Model& model);
// Of them those of the rings and the integrator.
std::vector<int> order_beside_the_rotor(const Model& model);

// Radius of the drawn disc at an auxiliary bearing, m.
double drawn_radius(const scene::Scene& scene, std::size_t bearing = 0);

// The ghosts: bodies that show where the shadow has rotor and ring. The plugin moves them; without
// it they rest at the start. They take no part in the motion.
void write_ghosts(XmlWriter& xml, const scene::Scene& scene, const Model& model);

}  // namespace rotorub
