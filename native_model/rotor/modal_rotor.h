// The rotor in modal coordinates. A shaft with discs and bearings is reduced to this form; the
// modal form of a scene states it directly. This is equation (1) of the paper, with q_r the
// coordinates of the undamped planar eigenmodes at rest:
//
//   x:  M_x x'' + (D_x + D_i,xx) x' + K_x x + Omega g y'   + Omega D_i,xy y   = loads
//   y:  M_y y'' + (D_y + D_i,yy) y' + K_y y - Omega g^T x' - Omega D_i,xy^T x = loads
//
// M and K are diagonal. Each bending mode is scaled to 1 at the contact station, so that the
// deflection there is the plain sum of the modal coordinates. A mode with a node there does not
// move the contact point (contact shape 0); it is scaled to 1 at its largest deflection, as is
// every mode of a rotor without a contact.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "native_model/bearing/bearing_film.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Mode values at one station in the two planes (n each, dimensionless).
struct ModeShape {
  Eigen::VectorXd x, y;
};

struct PlaneModes {
  Eigen::VectorXd mass;       // kg, n, > 0
  Eigen::VectorXd stiffness;  // N/m, n, >= 0
  Eigen::VectorXd damping;  // N s/m, n, >= 0, external modal damping without the bearings' damping
};

// Dashpots of one bearing: generalised force -damping (shape . qdot) shape in each plane. A shaft
// that magnetic bearings hold also has one per mode for its external damping.
struct StationDamper {
  ModeShape shape;
  Eigen::Vector2d damping;  // N s/m, x and y
};

// Other forces of a bearing: cross-coupling and coefficients that follow the speed.
struct StationFilm {
  ModeShape shape;
  BearingFilm law;
};

struct DiscUnbalance {
  ModeShape shape;
  double static_moment;  // kg m, m e
  double phase;          // rad
  double on = -1e300;    // s, the unbalance acts from this time on; default: always
};

// Torsion about z. The rotation at a station is the rigid spin plus the sum of shape_k theta_k,
// with shape 1 at the contact. With a drive these are the free-free modes, without one the modes of
// a shaft held at z = 0.
struct TorsionModes {
  Eigen::VectorXd inertia;      // kg m^2, > 0
  Eigen::VectorXd stiffness;    // N m/rad, > 0
  Eigen::VectorXd damping;      // N m s/rad, >= 0
  Eigen::VectorXd drive_shape;  // 1, at the motor
  // 1, one entry per contact; at the first contact each value is 1, or 0 for a node there.
  std::vector<Eigen::VectorXd> contacts;
};
// For a rotor without elastic torsion.
inline TorsionModes no_torsion(std::size_t contacts) {
  return {{}, {}, {}, {}, std::vector<Eigen::VectorXd>(contacts)};
}

// The deflection lines for drawing: stations z (m, k) and mode values (k x n) of each plane.
struct ModeLines {
  Eigen::VectorXd z;
  Eigen::MatrixXd x, y;
};

// Mode values at a magnetic bearing and, if its sensor is elsewhere, at the sensor.
struct MagnetShapes {
  ModeShape station;
  std::optional<ModeShape> sensor{};
};

struct ModalRotor {
  PlaneModes x, y;
  std::vector<ModeShape> contacts;  // one per auxiliary bearing; 1 or 0 for each mode at the first
  Eigen::MatrixXd gyroscopic;       // kg, n x n, g: rows x modes, columns y modes
  Eigen::MatrixXd internal_xx, internal_xy, internal_yy;  // N s/m, n x n, rotating damping D_i
  std::vector<StationDamper> bearing_dampers;
  std::vector<StationFilm> films;
  Eigen::VectorXd pull_x, pull_y;  // N, n or empty: from springs of misaligned bearings
  std::vector<DiscUnbalance> unbalances;
  std::vector<ModeShape> force_shapes;   // one per entry of Scene.forces, including unbalances
  std::vector<MagnetShapes> magnets;     // one per entry of Scene.magnetic_bearings
  Eigen::VectorXd gravity_x, gravity_y;  // kg, n, load on each mode per unit acceleration
  double spin_inertia = 0.0;             // kg m^2, of the rigid rotor and the motor
  TorsionModes torsion;                  // empty lists without [rotor.torsion]
  std::optional<ModeLines> lines;        // geometry form only
  int modes() const { return static_cast<int>(x.mass.size()); }
};

// Builds the modal rotor from either form of the scene's rotor. The geometry form uses a Ritz
// ansatz with Legendre functions on elements (shaft_basis.h). Throws scene::SceneError if the
// geometry has no mode below max_frequency, or if its bearings leave a rigid-body motion free.
ModalRotor modal_rotor(const scene::Scene& scene);

// kg m^2, inertia of the rigid spin in geometry form: shaft, discs and (with a drive) the motor's
// rotor.
double spin_inertia(const scene::Scene& scene);

// The elastic torsion modes requested by [rotor.torsion], each scaled to 1 at the contact, from G
// I_p, rho I_p, the discs' J_p and the motor's rotor. With a drive they are the free-free modes,
// orthogonal to the rigid spin (whose inertia is spin_inertia()). Without a drive the shaft is held
// at z = 0, where the motor sits by default. Empty without [rotor.torsion].
TorsionModes torsion_modes(const scene::Scene& scene);

}  // namespace rotorub
