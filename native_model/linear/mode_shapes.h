// Bending modes along the shaft, to be drawn and tabled: the undamped planar eigenmodes at rest,
// those whose coordinates are x_1, ..., y_1, ... of a run. Geometry form only.
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
std::vector<WhirlMode> torsion_frequencies(const ModalRotor& rotor);

// How the rotor is bent while it whirls freely at a spin speed: the eigenvectors of the damped
// gyroscopic system (whirl_system.h) along the shaft. Geometry form only.
//
// At z the centre runs on an ellipse, x + i y = r_+ e^{i w t} + conj(r_-) e^{-i w t}, and |r_+| +
// |r_-| is its larger half-axis; its sign is that of the whirl's own part (r_+ forward, r_-
// backward) against the phase at its largest deflection. Without damping that is a planar line that
// turns with the whirl.
struct WhirlShape {
  WhirlMode mode;
  Eigen::VectorXd shape;        // 1, k: along `along.z`, 1 at the largest of them
  Eigen::VectorXd at_stations;  // 1, s: at `along.stations`
  double roundness = 0.0;  // 1 circle, 0 line: smaller over larger half-axis where the shape is 1
};

// Of every mode of whirl_spectrum(system, speed) that oscillates, in its order. system:
// whirl_system(scene). Throws as whirl_spectrum does.
std::vector<WhirlShape> whirl_shapes(const scene::Scene& scene, const WhirlSystem& system,
                                     double speed, const ModeShapes& along);

}  // namespace rotorub
