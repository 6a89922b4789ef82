// What a rigid impact meets: the effective mass of the shaft at the contact, 1 / (u M^-1 u^T), u
// the mode values there. With more modes kept it falls without end unless a mass sits at the
// station (a sleeve): the largest impact falls with it, the mean force of a rub hardly does.
#pragma once

#include <optional>

#include "native_model/scene/scene.h"

namespace rotorub {

struct ContactMass {
  double kept = 0.0;  // kg, with the modes kept; the lighter plane's
  double mesh = 0.0;  // kg, with all modes of the mesh they were found on, <= kept
  int kept_modes = 0, mesh_modes = 0;
  // Impacts are those of the modes kept, not of the shaft.
  bool truncated() const { return kept > 1.1 * mesh; }
};

// Of a rotor in geometry form with a contact; otherwise none. Solves the shaft's eigenvalue
// problem.
std::optional<ContactMass> contact_mass(const scene::Scene& scene);

}  // namespace rotorub
