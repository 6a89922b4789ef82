// The periodic response of the free rotor to all loads that act at t = 0 (equations in
// steady_orbit.h) and the size of its orbit.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// One harmonic of an orbit d(t) = centre + sum_j Re(a_j e^{i nu_j t}); a_j is a complex vector, so
// each part is an ellipse.
struct OrbitPart {
  double frequency;  // rad/s, >= 0; at 0 the part is a constant, the real part of amplitude
  Eigen::Vector2cd amplitude;  // m
};

struct OrbitSize {
  Eigen::Vector2d centre{0.0, 0.0};  // m
  std::vector<OrbitPart> parts;

  // Maximum of |d| over all time, m, to 1e-6. If the frequencies are in the ratio of whole numbers
  // up to kHighest, the orbit is periodic and one period is searched. Otherwise all phases come
  // together sooner or later, and the maximum of centre . u + sum |a_j . u| over all directions u
  // is taken.
  double largest() const;

  static constexpr int kHighest = 24;
};

struct FreeMotion {
  Eigen::VectorXd q, v;    // 2 n; m and m/s, at t = 0
  Eigen::VectorXd stored;  // states of the magnetic bearings' feedbacks at t = 0
  // Largest current of each magnetic bearing on each axis, A: the sum of the amplitudes of all
  // frequencies.
  std::vector<Eigen::Vector2d> current{};
  std::vector<OrbitSize> orbits{};  // of the rotor's centre at each auxiliary bearing, m
};

// Motion at the speed model.speed. Throws scene::SceneError with key initial.steady if there is
// none.
FreeMotion free_motion(const scene::Scene& scene, const Model& model);

// Load of all unbalances, ignoring their times, as Re(f e^{i |Omega| t}) on the modes: f in N, 2 n.
// The phase is relative to the mark on the rotor, which lies at +x at t = 0. speed: Omega, rad/s.
Eigen::VectorXcd unbalance_load(const Model& m, double speed);
// Steady response q = Re(Q e^{i |Omega| t}) to that load at the speed m.speed: Q in m, 2 n. With
// sampled controls, Q is the component at Omega (linear_loop.h). Throws as free_motion does.
Eigen::VectorXcd unbalance_amplitude(const scene::Scene& scene, const Model& m);

// The scene at rest with its rings centred, keeping only the spin angle of its initial state, for
// analyses that need no start.
scene::Scene without_start(scene::Scene scene);

[[noreturn]] void refuse_steady(const scene::Scene& scene, const std::string& why);

}  // namespace rotorub
