#include "native_model/rotor/contact_mass.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "native_model/rotor/rotor_modes.h"

namespace rotorub {

std::optional<ContactMass> contact_mass(const scene::Scene& scene) {
  if (!scene.contact || !scene.rotor.geometry) return {};
  const RotorModes modes = rotor_modes(scene);
  const Eigen::VectorXd u = modes.ritz.basis.deflection(scene.contact->station).transpose();
  // Of the modes of one plane: 1 / sum of (shape^2 / modal mass).
  const auto of_kept = [&](const PlanarModes& plane) {
    double admittance = 0.0;
    for (int k = 0; k < modes.kept; ++k) {
      const auto shape = plane.shape.col(k);
      const double at_contact = u.dot(shape);
      admittance += at_contact * at_contact / shape.dot(modes.ritz.mass * shape);
    }
    return 1.0 / admittance;
  };
  ContactMass mass;
  mass.kept = std::min(of_kept(modes.x), of_kept(modes.y));
  mass.mesh = 1.0 / u.dot(modes.ritz.mass.llt().solve(u));
  mass.kept_modes = modes.kept;
  mass.mesh_modes = static_cast<int>(u.size());
  return mass;
}

}  // namespace rotorub
