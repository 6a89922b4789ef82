#include "native_model/rotor/contact_mass.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "native_model/rotor/rotor_modes.h"

namespace rotorub {

std::optional<ContactMass> contact_mass(const scene::Scene& scene) {
  if (!scene.first().contact || !scene.rotor.geometry) return {};
  const RotorModes modes = rotor_modes(scene);
  const Eigen::RowVectorXd u = modes.ritz.basis.deflection(scene.first().contact->station);
  const auto of_kept = [&](const PlanarModes& plane) {
    return 1.0 / modal_sums(plane, u).mobility[modes.kept - 1];
  };
  ContactMass mass;
  mass.kept = std::min(of_kept(modes.x), of_kept(modes.y));
  mass.mesh = 1.0 / u.dot(modes.ritz.mass.llt().solve(u.transpose()));
  mass.kept_modes = modes.kept;
  mass.mesh_modes = static_cast<int>(u.size());
  return mass;
}

}  // namespace rotorub
