// The rotor in modal coordinates: what a shaft with discs and bearings is reduced to, and what the
// modal form of a scene states directly. Equation (1) of the paper with q_r the coordinates of the
// undamped planar eigenmodes at rest:
//
//   x:  M_x x'' + (D_x + D_i,xx) x' + K_x x + Omega g y'   + Omega D_i,xy y   = loads
//   y:  M_y y'' + (D_y + D_i,yy) y' + K_y y - Omega g^T x' - Omega D_i,xy^T x = loads
//
// M, K diagonal. Each bending mode is scaled to 1 at the contact station, so that the deflection
// there is the plain sum of the modal coordinates; a mode with a node there moves the contact point
// by nothing (contact shape 0) and is scaled to 1 at its largest deflection, as is every mode of a
// rotor without a contact.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "native_model/bearing/bearing_film.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// Mode values at one station, for the two planes (n each, dimensionless).
struct ModeShape {
  Eigen::VectorXd x, y;
};

struct PlaneModes {
  Eigen::VectorXd mass;       // kg, n, > 0
  Eigen::VectorXd stiffness;  // N/m, n, >= 0
  Eigen::VectorXd damping;    // N s/m, n, >= 0, external modal damping (without the bearings')
};

// Dashpots of one bearing: force -damping .* (shape . qdot) at its station.
struct StationDamper {
  ModeShape shape;
  Eigen::Vector2d damping;  // N s/m, x and y
};

// What else a bearing does there.
struct StationFilm {
  ModeShape shape;
  BearingFilm law;
};

struct DiscUnbalance {
  ModeShape shape;
  double static_moment;  // kg m, m e
  double phase;          // rad
  double on = -1e300;    // s, there from here on; the default: always
};

// Torsion about z: rotation at a station = rigid spin + sum of shape_k theta_k; shape 1 at the
// contact. With a drive: free-free modes. Without: those of a shaft held at the motor's station.
struct TorsionModes {
  Eigen::VectorXd inertia;      // kg m^2, > 0
  Eigen::VectorXd stiffness;    // N m/rad, > 0
  Eigen::VectorXd damping;      // N m s/rad, >= 0
  Eigen::VectorXd drive_shape;  // 1, at the motor
  // 1, at each contact; at the first 1, or 0 for a node there.
  std::vector<Eigen::VectorXd> contacts;
};
// Of a rotor without elastic torsion.
inline TorsionModes no_torsion(std::size_t contacts) {
  return {{}, {}, {}, {}, std::vector<Eigen::VectorXd>(contacts)};
}

// The deflection lines, for pictures: station z (k), mode values (k x n) of each plane.
struct ModeLines {
  Eigen::VectorXd z;
  Eigen::MatrixXd x, y;
};

// A magnetic bearing and, where that is elsewhere, its sensor.
struct MagnetShapes {
  ModeShape station;
  std::optional<ModeShape> sensor{};
};

struct ModalRotor {
  PlaneModes x, y;
  std::vector<ModeShape> contacts;  // of each auxiliary bearing; of the first 1 or 0 for each mode
  Eigen::MatrixXd gyroscopic;       // kg, n x n, g: rows x modes, columns y modes
  Eigen::MatrixXd internal_xx, internal_xy, internal_yy;  // N s/m, n x n, rotating damping D_i
  std::vector<StationDamper> bearing_dampers;
  std::vector<StationFilm> films;
  Eigen::VectorXd pull_x, pull_y;  // N, n or empty: of springs of bearings that stand off the line
  std::vector<DiscUnbalance> unbalances;
  std::vector<ModeShape> force_shapes;   // one for each of Scene.forces, of kind unbalance too
  std::vector<MagnetShapes> magnets;     // one for each of Scene.magnetic_bearings
  Eigen::VectorXd gravity_x, gravity_y;  // kg, n, load of each mode per unit acceleration
  double spin_inertia = 0.0;             // kg m^2, rigid rotor with the motor's
  TorsionModes torsion;                  // empty lists without [rotor.torsion]
  std::optional<ModeLines> lines;        // geometry form only
  int modes() const { return static_cast<int>(x.mass.size()); }
};

// Either form of the scene's rotor. Geometry form: Ritz ansatz with Hermite cubic elements.
// Throws scene::SceneError where the geometry has no mode below max_frequency or is not supported
// against rigid motion as a scene must be.
ModalRotor modal_rotor(const scene::Scene& scene);

// Torsion of the shaft in geometry form: elastic modes of G I_p, rho I_p, the discs' J_p and the
// motor's rotor, and the inertia of the rigid spin: shaft, discs and (with a drive) the motor's
// rotor: kg m^2.
double spin_inertia(const scene::Scene& scene);

// The modes asked for by [rotor.torsion], each 1 at the contact. With a drive: free-free, elastic
// ones alone, orthogonal to the rigid spin (which is in spin_inertia). Without: held at z = 0,
// where the motor sits by default. Empty without [rotor.torsion].
TorsionModes torsion_modes(const scene::Scene& scene);

}  // namespace rotorub
