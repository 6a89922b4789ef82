// A shaft in bending with its eigenmodes, on a mesh fine enough for the modes that are kept:
// frequencies right to about 1e-10.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "native_model/rotor/ritz_bending.h"
#include "native_model/scene/forward.h"
#include "native_model/scene/magnetic_bearing.h"
#include "native_model/scene/rotor.h"

namespace rotorub {

// Undamped planar eigenmodes at rest: K phi = omega^2 M phi.
struct PlanarModes {
  Eigen::VectorXd frequency;  // rad/s, N, ascending, > 0
  Eigen::MatrixXd shape;      // N x N, columns phi with phi^T M phi = 1
};

// M, K symmetric and positive definite, N x N. The low frequencies are the accurate ones: the
// problem solved is M phi = omega^-2 K phi, in which very stiff parts are very small numbers.
// Throws RotorNotSolvable (refusal.h) where a matrix is not positive definite to working precision.
PlanarModes planar_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

// The same of a stiffness that may leave a rigid motion free, of frequency 0. reference: rad/s, >
// 0, about the lowest frequency there is.
PlanarModes free_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                       double reference);

// What the first k modes know of a place with the shape values u, k = 1 to N. They rise with k to
// the values of all modes, u M^-1 u^T and u K^-1 u^T.
struct ModalSums {
  Eigen::VectorXd mobility;     // 1/kg, sum over the modes of (u phi)^2: 1 / effective mass
  Eigen::VectorXd flexibility;  // m/N, sum of (u phi)^2 / omega^2
};
ModalSums modal_sums(const PlanarModes& modes, const Eigen::RowVectorXd& u);

// A magnetic bearing as the linear theory of the rotor has it: a spring and a damper at its
// station. At t = 0, within the limit of its current.
struct MagneticSupport {
  double stiffness = 0.0;  // N/m: -k_s; with a feedback k_i P - k_s, 0 of one that has failed
  double damping = 0.0;    // N s/m, k_i D
  // N/m, >= 0: the spring that the modes are found with. Geometry form: that of a feedback, however
  // soon it fails, so that a shaft that magnets hold has modes. Whoever uses the modes adds what
  // the bearing does beyond it, so that nothing but the modes kept depends on this choice; damping
  // ratios are of the modes without it (OwnModes).
  double held = 0.0;
};
MagneticSupport magnetic_support(const scene::Scene& scene, const scene::MagneticBearing& bearing);
// One of them has a spring `held`.
bool held_by_magnets(const scene::Scene& scene);

// Geometry form: the shaft on its bearings, with each spring `held` as one more.
scene::RotorGeometry supported(const scene::Scene& scene);

// The modes that damping ratios are of, on the shaft's own bearings: a motion that only magnetic
// bearings hold has a frequency, and with it a damping, of 0.
struct OwnModes {
  PlanarModes x, y, mean;  // mean: as RotorModes
};

struct RotorModes {
  RitzBending ritz;
  PlanarModes x, y;  // all N of them; equal bit for bit for isotropic bearings
  PlanarModes mean;  // of the mean stiffness (K_x + K_y) / 2: those that carry internal damping
  // Where magnetic bearings' springs are among the bearings of x and y.
  std::optional<OwnModes> own{};
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
