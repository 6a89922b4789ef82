// How the rotor is bent while it whirls freely at a spin speed: the eigenvectors of the damped
// gyroscopic system (whirl_system.h) along the shaft. Geometry form only.
//
// At z the centre runs on an ellipse, x + i y = r_+ e^{i w t} + conj(r_-) e^{-i w t}, and |r_+| +
// |r_-| is its larger half-axis; its sign is that of the whirl's own part (r_+ forward, r_-
// backward) against the phase at its largest deflection. Without damping that is a planar line that
// turns with the whirl.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "native_model/rotor/campbell.h"
#include "native_model/rotor/mode_shapes.h"

namespace rotorub {

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
