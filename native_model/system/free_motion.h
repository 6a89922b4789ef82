// The periodic answer of the free rotor to all that acts at t = 0 (steady_orbit.h has the
// equations).
#pragma once

#include <Eigen/Core>
#include <string>

#include "native_model/scene/scene.h"
#include "native_model/system/model.h"
#include "native_model/system/orbit_size.h"

namespace rotorub {

struct FreeMotion {
  Eigen::VectorXd q, v;              // 2 n: m, m/s, at t = 0
  Eigen::Vector2d stored{0.0, 0.0};  // A, what a magnetic bearing's integrator holds at t = 0
  Eigen::Vector2d current{
      0.0, 0.0};      // A, the most of its current on each axis: the sum over all frequencies
  OrbitSize orbit{};  // of the rotor's centre at the contact, m
};

// At the speed model.speed. Throws scene::SceneError, key initial.steady, where there is none.
FreeMotion free_motion(const scene::Scene& scene, const Model& model);

[[noreturn]] void refuse_steady(const scene::Scene& scene, const std::string& why);

}  // namespace rotorub
