// A shaft in bending and its eigenmodes, on a mesh fine enough for the kept modes: their
// frequencies are accurate to about 1e-10.
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
  Eigen::MatrixXd shape;      // N x N, one column phi per mode, phi^T M phi = 1
};

// M and K are symmetric and positive definite, N x N. The low frequencies are the most accurate:
// the solved problem is M phi = omega^-2 K phi, in which very stiff parts become very small
// numbers. Throws RotorNotSolvable (refusal.h) if a matrix is not positive definite to working
// precision.
PlanarModes planar_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness);

// As planar_modes(), for a stiffness that may leave rigid motions free; their frequency is 0.
// reference: rad/s, > 0, about the lowest nonzero frequency.
PlanarModes free_modes(const Eigen::MatrixXd& mass, const Eigen::MatrixXd& stiffness,
                       double reference);

// Partial sums over the first k modes, k = 1 to N, at a place with the shape values u. They rise
// with k to the values of all modes, u M^-1 u^T and u K^-1 u^T.
struct ModalSums {
  Eigen::VectorXd mobility;     // 1/kg, sum over the modes of (u phi)^2: 1 / effective mass
  Eigen::VectorXd flexibility;  // m/N, sum of (u phi)^2 / omega^2
};
ModalSums modal_sums(const PlanarModes& modes, const Eigen::RowVectorXd& u);

// Linear model of a magnetic bearing: a spring and a damper at its station. It is linearised about
// the centre, for currents within the limit.
struct MagneticSupport {
  double stiffness = 0.0;  // N/m: -k_s, with feedback k_i P - k_s, 0 if the feedback never works
  double damping = 0.0;    // N s/m, k_i D
  // N/m, >= 0: spring of this bearing with which the modes are computed, so that a shaft held by
  // magnets has modes. It is nonzero only for the geometry form with feedback, and does not depend
  // on when the feedback fails. Code that uses the modes adds the rest of the bearing's force, so
  // that this choice affects only which modes are kept. Damping ratios refer to the modes without
  // this spring (OwnModes).
  double modal_spring = 0.0;
};
MagneticSupport magnetic_support(const scene::Scene& scene, const scene::MagneticBearing& bearing);
// True if at least one bearing has `modal_spring` > 0.
bool has_modal_springs(const scene::Scene& scene);

// Geometry form: the shaft on its bearings, with each spring `modal_spring` added as a further
// bearing.
scene::RotorGeometry supported(const scene::Scene& scene);

// The modes to which damping ratios refer: the modes on the shaft's own bearings. A motion that
// only magnetic bearings hold has frequency 0 here, and so no damping.
struct OwnModes {
  PlanarModes x, y, mean;  // mean: as in RotorModes
};

struct RotorModes {
  RitzBending ritz;
  PlanarModes x, y;  // all N; bitwise equal for isotropic bearings
  PlanarModes mean;  // of the mean stiffness (K_x + K_y) / 2; they carry the internal damping
  // Present if the modes x and y contain springs of magnetic bearings.
  std::optional<OwnModes> own{};
  int kept = 0;            // modes kept in each plane, 1 <= kept <= N
  double highest() const;  // rad/s, of the requested modes (see solve_refined)
};

// Modes of the scene's rotor in geometry form. With `max_frequency`, mode j is kept if it lies at
// or below that frequency in either plane. Throws scene::SceneError if no mode does.
RotorModes rotor_modes(const scene::Scene& scene);

// Damping matrix on the Ritz coordinates that gives each mode the damping
// c = 2 ratio omega phi_j^T M phi_j: M Phi diag(2 ratio omega) Phi^T M, N x N, N s/m.
Eigen::MatrixXd modal_damping(const Eigen::MatrixXd& mass, const PlanarModes& modes, double ratio);

}  // namespace rotorub
