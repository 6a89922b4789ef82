// Bending modes along the shaft, to be drawn and tabled: the undamped planar eigenmodes at rest,
// those whose coordinates are x_1, ..., y_1, ... of a run. Geometry form only.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "native_model/rotor/modal_rotor.h"
#include "native_model/scene/scene.h"

namespace rotorub {

enum class StationKind { kDisc, kBearing, kContact, kDrive, kMagneticBearing, kForce };

// A place on the shaft that the scene names.
struct Station {
  StationKind kind;
  std::string name;  // "disc 1", "bearing 2", "contact", ...; no number where there is one alone
  double z;          // m
};

struct PlaneShapes {
  Eigen::VectorXd frequency;    // rad/s, n, ascending, undamped, without magnetic bearing
  Eigen::MatrixXd shape;        // 1, k x n: along ModeShapes::z
  Eigen::MatrixXd at_stations;  // 1, s x n: at ModeShapes::stations
};

// Every mode scaled as in the model: 1 at the contact; 1 at its largest deflection where it has a
// node there, and where the scene has no contact.
struct ModeShapes {
  Eigen::VectorXd z;              // m, k, ascending from 0 to the length
  std::vector<Station> stations;  // s, by z
  PlaneShapes x, y;
  bool same_planes = false;  // y is x
};

// Empty for the modal form, which knows no shaft. Throws as modal_rotor does.
std::optional<ModeShapes> mode_shapes(const scene::Scene& scene);

// Frequency (rad/s) and damping ratio of the elastic torsion modes; empty without [rotor.torsion].
struct TorsionMode {
  double frequency;
  double damping_ratio;
};
std::vector<TorsionMode> torsion_frequencies(const ModalRotor& rotor);

}  // namespace rotorub
