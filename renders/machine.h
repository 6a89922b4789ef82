// The machine as it is drawn: a scene's parts with the sizes of the picture. The shaft's length is
// one drawing unit. Displacements are magnified, and with them the clearance; bodies are not:
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

// The drawing's point at a station of a place (y, z) across the shaft.
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
  double ring_outer;  // radius
  double half_width;
  double ring_bore() const { return rotor_radius + clearance; }
};

// What holds the ring, as the scene has it: a housing (no [stator]), or springs, actuators at 45
// degrees, these with electromagnets, or nothing.
struct DrawnSupport {
  bool fixed = true;
  bool spring_x = false, spring_y = false;
  bool actuators = false, magnets = false;
};

// A force that acts on the shaft from outside, at its station.
struct DrawnLoad {
  double z;
  AppliedForce force;
};

struct DrawnMagneticBearing {
  double z, bore, outer, half_width;  // radii
};

struct Machine {
  double unit = 1.0;           // drawing units in a metre
  double magnification = 1.0;  // of displacements, >= 1
  double clearance = 0.0;      // m, true; 0 without a contact

  // The shaft: k stations, k - 1 spans, and what a deflection line is made of: the modes' values
  // (k x n), or for a rotor without geometry one bow (k) that the contact station's motion scales.
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
  bool schematic = false;       // a rotor of modal data: its shaft is not the scene's
  bool ring_turns = false;      // about its axis
  double floor = -0.2;          // Z of the base plate's top

  // Lengths of the scene (m) as displacements of the drawing.
  double displaced(double metres) const { return metres * unit * magnification; }
  // This machine with the contact of another, which is drawn to another magnification.
  Machine with_contact_of(const Machine& other) const;
  // Magnified centre line: 2 x k, rows Y and Z.
  Eigen::Matrix2Xd centre_line(const Pose& pose) const;
  // The magnified centre at one station, and the direction of the shaft there.
  Eigen::Vector3d centre(const Eigen::Matrix2Xd& line, double station) const;
  Eigen::Vector3d tangent(const Eigen::Matrix2Xd& line, double station) const;
};

// `runs`: all that are shown. Without a given magnification: as large as makes the largest motion
// between `from` and `to` a tenth of the shaft, within limits that keep the clearance visible, and
// rounded down to a plain number. Throws std::runtime_error where a run has not the scene's number
// of modes.
Machine make_machine(const scene::Scene& scene, std::span<const Playback* const> runs, double from,
                     double to, std::optional<double> magnification);

// For a picture of the contact alone, 1 without a contact: the clearance drawn as 0.45 of the
// rotor's radius, less where the ring moves far (`motion`, m), rounded down to a plain number.
double section_magnification(const scene::Scene& scene, double motion);

// The largest of 1, 1.5, 2, 3, 4, 5, 6, 8, 10 times a power of ten that is not above `value` > 0.
double plain_number_below(double value);

}  // namespace rotorub::renders
