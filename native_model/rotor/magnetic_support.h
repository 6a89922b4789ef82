// A magnetic bearing as the linear theory of the rotor has it: a spring and a damper at its
// station.
#pragma once

#include "native_model/scene/scene.h"

namespace rotorub {

// At t = 0, within the limit of its current.
struct MagneticSupport {
  double stiffness = 0.0;  // N/m: -k_s; with a feedback k_i P - k_s, 0 of one that has failed
  double damping = 0.0;    // N s/m, k_i D
  // N/m, >= 0: the spring that the modes are found with. Geometry form: that of a feedback, however
  // soon it fails, so that a shaft on one other bearing has modes. Whoever uses the modes adds what
  // the bearing does beyond it, so that nothing but the modes kept depends on this choice; damping
  // ratios are of the modes without it (OwnModes).
  double held = 0.0;
};
MagneticSupport magnetic_support(const scene::Scene& scene);  // zeros without a magnetic bearing

// Geometry form: the shaft on its bearings, with the spring `held` as one more.
scene::RotorGeometry supported(const scene::Scene& scene);

}  // namespace rotorub
