// The periodic answer of the free rotor to all that acts at t = 0 (steady_orbit.h has the
// equations), and how far its orbit goes.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/scene/forward.h"

namespace rotorub {

// An orbit of several frequencies, d(t) = centre + sum_j Re(a_j e^{i nu_j t}), a_j a complex
// vector: an ellipse.
struct OrbitPart {
  double frequency;            // rad/s, >= 0; 0: a constant, its real part
  Eigen::Vector2cd amplitude;  // m
};

struct OrbitSize {
  Eigen::Vector2d centre{0.0, 0.0};  // m
  std::vector<OrbitPart> parts;

  // m: the most of |d| over all time, to 1e-6. Frequencies in the ratio of whole numbers up to
  // kHighest come back, and one period is looked through. Others meet in every phase sooner or
  // later: it is the largest over directions u of centre . u + sum |a_j . u|.
  double largest() const;

  static constexpr int kHighest = 24;
};

struct FreeMotion {
  Eigen::VectorXd q, v;    // 2 n: m, m/s, at t = 0
  Eigen::VectorXd stored;  // the states of the magnetic bearings' feedbacks at t = 0
  // A, of each magnetic bearing the most of its current on each axis: the sum over all frequencies.
  std::vector<Eigen::Vector2d> current{};
  std::vector<OrbitSize> orbits{};  // of the rotor's centre at each auxiliary bearing, m
};

// At the speed model.speed. Throws scene::SceneError, key initial.steady, where there is none.
FreeMotion free_motion(const scene::Scene& scene, const Model& model);

// Of the unbalances alone, whenever they come to act: N, 2 n, of Re(f e^{i |Omega| t}) on the
// modes, against the mark on the rotor, which lies at +x at t = 0. speed: Omega, rad/s.
Eigen::VectorXcd unbalance_load(const Model& m, double speed);
// Q of the steady answer q = Re(Q e^{i |Omega| t}) to it, m, 2 n, at the speed m.speed; of sampled
// controls their part at Omega (linear_loop.h). Throws as free_motion.
Eigen::VectorXcd unbalance_amplitude(const scene::Scene& scene, const Model& m);

// The scene at rest in the middle of its rings, whatever start it gives, but for the angle of the
// spin: for an analysis that asks for none.
scene::Scene without_start(scene::Scene scene);

[[noreturn]] void refuse_steady(const scene::Scene& scene, const std::string& why);

}  // namespace rotorub
