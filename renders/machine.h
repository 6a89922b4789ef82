// The machine as it is drawn: a scene's parts with their sizes in the picture. The shaft's length
// is one drawing unit. Displacements and the clearance are magnified, but bodies are not:
//
//   drawn ring bore = drawn rotor radius + magnification * clearance
//
// so that the drawn circles touch exactly when the rotor touches the ring.
// Axes of the drawing: X along the shaft, Y = the scene's x, Z = the scene's y, up.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/scene.h"
#include "renders/playback.h"

namespace rotorub::renders {

// The point of the drawing at a station and a position (y, z) across the shaft.
inline Eigen::Vector3d place_at(double station, const Eigen::Vector2d& yz) {
  return {station, yz[0], yz[1]};
}

// A round body on the shaft.
struct DrawnDisc {
  double z, radius, half_width;
};

struct DrawnContact {
  double z;
  double rotor_radius;
  double clearance;   // magnified
  double ring_outer;  // outer radius
  double half_width;
  double ring_bore() const { return rotor_radius + clearance; }
};

// The support of the ring: a housing (without [stator]), springs, actuators at 45 degrees,
// electromagnets on these axes, or nothing.
struct DrawnSupport {
  bool fixed = true;
  bool spring_x = false, spring_y = false;
  bool actuators = false, magnets = false;
};

// An external force on the shaft, at its station.
struct DrawnLoad {
  double z;
  AppliedForce force;
};

struct DrawnMagneticBearing {
  double z, bore, outer, half_width;  // bore and outer are radii
};

struct Machine {
  double unit = 1.0;           // drawing units per metre
  double magnification = 1.0;  // of displacements, >= 1
  double clearance = 0.0;      // m, not magnified; 0 without a contact

  // The shaft: k stations and k - 1 spans. The deflection line is made of the modes' values (k x
  // n), or, for a rotor without geometry, of one bow (k) scaled by the contact station's motion.
  Eigen::VectorXd z;
  std::vector<double> span_radius;
  Eigen::MatrixXd modes_x, modes_y;
  Eigen::VectorXd bow;

  std::vector<DrawnDisc> discs;
  std::vector<double> bearings;  // z
  double bearing_bore = 0.0;
  std::optional<DrawnContact> contact;
  DrawnSupport support;
  std::vector<DrawnMagneticBearing> magnetic_bearings;
  std::vector<DrawnLoad> loads;
  double largest_load = 0.0;    // N
  std::optional<double> motor;  // z
  bool schematic = false;       // the rotor has modal data, so that its shaft is not the scene's
  bool ring_turns = false;      // the ring rotates about its axis
  double floor = -0.2;          // Z of the top of the base plate

  // Converts lengths of the scene (m) to displacements of the drawing.
  double displaced(double metres) const { return metres * unit * magnification; }
  // This machine with the contact of another one, which has another magnification.
  Machine with_contact_of(const Machine& other) const;
  // The magnified centre line: 2 x k, rows Y and Z.
  Eigen::Matrix2Xd centre_line(const Pose& pose) const;
  // The magnified centre at one station, and the direction of the shaft there.
  Eigen::Vector3d centre(const Eigen::Matrix2Xd& line, double station) const;
  Eigen::Vector3d tangent(const Eigen::Matrix2Xd& line, double station) const;
};

// `runs`: all that are shown. The default magnification makes the largest motion between `from` and
// `to` a tenth of the shaft, within limits that keep the clearance visible, and is rounded down to
// a plain number; of several contacts the one that allows the least decides. Throws
// std::runtime_error if the number of modes of a run is not the scene's.
Machine make_machine(const scene::Scene& scene, std::span<const Playback* const> runs, double from,
                     double to, std::optional<double> magnification);

// Magnification for pictures of only the contacts; 1 without a contact. The drawn clearance is 0.45
// of the rotor's radius, or less if the ring moves far (`motion`, m). The pictures of several
// contacts share the smallest of their magnifications. Rounded down, see below.
double section_magnification(const scene::Scene& scene, double motion);

// The largest number up to `value` > 0 that is 1, 1.5, 2, 3, 4, 5, 6, 8 or 10 times a power of ten.
double plain_number_below(double value);

}  // namespace rotorub::renders
