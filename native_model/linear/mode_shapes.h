// Bending modes along the shaft, for drawings and tables: the undamped planar eigenmodes at rest,
// whose coordinates are x_1, ..., y_1, ... of a run. Geometry form only.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/rotor/modal_rotor.h"
#include "native_model/rotor/shaft_basis.h"
#include "native_model/scene/forward.h"

namespace rotorub {

struct PlaneShapes {
  Eigen::VectorXd frequency;    // rad/s, n, ascending, undamped, without magnetic bearings
  Eigen::MatrixXd shape;        // 1, k x n: at ModeShapes::z
  Eigen::MatrixXd at_stations;  // 1, s x n: at ModeShapes::stations
};

// Modes scaled as in the model: 1 at the contact, or 1 at the largest deflection if the mode has a
// node at the contact or the scene has no contact.
struct ModeShapes {
  Eigen::VectorXd z;              // m, k, ascending from 0 to the length
  std::vector<Station> stations;  // s, ascending in z
  PlaneShapes x, y;
  bool same_planes = false;  // whether y equals x
};

// Empty for the modal form, which has no shaft. Throws as modal_rotor does.
std::optional<ModeShapes> mode_shapes(const scene::Scene& scene);

// Frequency (rad/s) and damping ratio of the elastic torsion modes; empty without [rotor.torsion].
std::vector<WhirlMode> torsion_frequencies(const ModalRotor& rotor);

// Shape of the rotor while it whirls freely at a spin speed: an eigenvector of the damped
// gyroscopic system (whirl_system.h) along the shaft. Geometry form only.
//
// At z the centre moves on an ellipse, x + i y = r_+ e^{i w t} + conj(r_-) e^{-i w t}, with major
// semi-axis |r_+| + |r_-|. The part with the sense of the whirl (r_+ forward, r_- backward) gives
// `shape` its sign, relative to its phase at the largest deflection. Without damping the shape is a
// planar line that turns with the whirl.
struct WhirlShape {
  WhirlMode mode;
  Eigen::VectorXd shape;        // 1, k: at `along.z`, scaled to 1 at the largest deflection
  Eigen::VectorXd at_stations;  // 1, s: at `along.stations`
  double roundness = 0.0;       // 1 circle, 0 line: ratio of minor to major axis where shape = 1
};

// Shape of every oscillating mode of whirl_spectrum(system, speed), in the same order. system must
// be whirl_system(scene). Throws as whirl_spectrum does.
std::vector<WhirlShape> whirl_shapes(const scene::Scene& scene, const WhirlSystem& system,
                                     double speed, const ModeShapes& along);

}  // namespace rotorub
