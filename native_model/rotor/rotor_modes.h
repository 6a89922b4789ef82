// A shaft in bending with its eigenmodes, on a mesh fine enough for the modes that are kept:
// frequencies right to about 1e-10.
#pragma once

#include <optional>

#include "native_model/rotor/planar_modes.h"
#include "native_model/rotor/ritz_bending.h"
#include "native_model/scene/scene.h"

namespace rotorub {

// The modes that damping ratios are of, on the shaft's own bearings: a motion that only a magnetic
// bearing holds has a frequency, and with it a damping, of 0.
struct OwnModes {
  PlanarModes x, y, mean;  // mean: as RotorModes
};

struct RotorModes {
  RitzBending ritz;
  PlanarModes x, y;  // all N of them; equal bit for bit for isotropic bearings
  PlanarModes mean;  // of the mean stiffness (K_x + K_y) / 2: those that carry internal damping
  std::optional<OwnModes>
      own{};               // where a magnetic bearing's spring is among the bearings of x and y
  int kept = 0;            // modes kept in each plane, 1 <= kept <= N
  double highest() const;  // rad/s, of the modes asked for (see solve_refined)
};

// The scene's rotor in geometry form. With `max_frequency` a mode is kept when it lies below in
// either plane. Throws scene::SceneError where none does.
RotorModes rotor_modes(const scene::Scene& scene);

// Damping c with c = 2 ratio omega phi_j^T M phi_j for each of the modes, as a matrix on the Ritz
// coordinates: M Phi diag(2 ratio omega) Phi^T M, N x N, N s/m.
Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const PlanarModes& modes, double ratio);

}  // namespace rotorub
