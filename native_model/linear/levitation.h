// Magnetic levitation of a rotor as a linear loop: its poles, and the sensitivity of each axis (ISO
// 14839-3),
//
//   S_k = 1 / (1 + L_k),   L_k the open loop of axis k with all others closed.
//
// S_k is the k-th diagonal element of (1 + G H)^-1 at the sensors, where G is the rotor from the
// commanded currents to the sensors and H the controls. The loop is linearised: no limits, pairs of
// opposing magnets at their centre, and a bearing that works at some time works always. The
// sensitivity of a sampled control is evaluated below its Nyquist frequency with its hold and
// delay; S leaves out aliasing from above.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "native_model/linear/step_response.h"
#include "native_model/model/linear_parts.h"
#include "native_model/model/model.h"

namespace rotorub {

struct LoopSensitivity {
  std::size_t bearing;  // index among the scene's magnetic bearings
  int axis;             // 0: x, 1: y
  double peak;          // maximum of |S|
  double frequency;     // rad/s, of the maximum
};

// Zone of ISO 14839-3 for the largest |S|: A below 3 (9.5 dB), B below 4 (12 dB), C below 5 (14
// dB), D above. A newly commissioned machine should be in zone A; B is accepted for unrestricted
// long-term running, C is not, and D causes damage.
char sensitivity_zone(double peak);

struct Levitation {
  std::vector<std::complex<double>> poles;  // as from loop_poles
  double sample_time = 0.0;                 // s, T; 0: continuous
  std::string poles_refused;                // reason if there are no poles
  std::vector<LoopSensitivity> loops;
  // |S| at these frequencies (rad/s, ascending), loops x frequencies.
  std::vector<double> frequencies;
  Eigen::MatrixXd sensitivities;
  // For a stable loop, in the order of `loops`: the response to a step of force, and the
  // peak-to-peak motion of each sensor axis under the unbalances that act from the start, m
  // (linear_loop.h).
  std::vector<StepResponse> steps;
  Eigen::VectorXd unbalance;
  // Both are false if the poles are unknown.
  bool unstable() const { return !stable() && poles_refused.empty() && !poles.empty(); }
  bool stable() const { return poles_refused.empty() && !poles.empty() && poles[0].real() < 0.0; }
};

// Computes only the poles at the spin speed `speed` (rad/s), or the reason why they are unknown.
Levitation levitation_poles(const Model& model, double speed);

// Analysis at the spin speed `speed` (rad/s). The result has no loops if no feedback works.
Levitation levitation(const Model& model, double speed);

// The rotor between the controls of its magnetic bearings, x' = A x + B i, y = C x. x: modal
// coordinates and their rates, 4 n; i: the coils' control currents (A); y: the deflections at the
// sensors (m). Two ports for each bearing, x before y. The pull of the magnets is part of A,
// amplifiers and controls are not.
struct MagneticPlant {
  Eigen::MatrixXd a, b, c;
  std::vector<std::size_t> bearings;  // indices among the scene's magnetic bearings
};

// S at a frequency (rad/s, > 0) as a p x p matrix, with two ports for each working feedback, x
// before y.
class LoopResponse {
 public:
  LoopResponse(const Model& model, double speed);
  Eigen::MatrixXcd sensitivity(double frequency) const;
  MagneticPlant plant() const;
  // 1 + G H.
  Eigen::MatrixXcd return_difference(double frequency) const;
  Eigen::Index ports() const { return into_.cols(); }
  std::size_t bearing(Eigen::Index port) const;  // index among the scene's magnetic bearings
  // 2 n x p, mode values at each sensor.
  const Eigen::MatrixXd& sensor_shapes() const { return sensor_shapes_; }

 private:
  Eigen::MatrixXcd controls(double frequency) const;
  Eigen::MatrixXcd open(double frequency, const Eigen::MatrixXcd& force) const;

  Model model_;
  std::vector<std::size_t> working_;  // indices of the model's feedbacks
  LinearParts parts_;                 // without the proportional and derivative parts of the laws
  // 2 n x p: modal force per ampere; mode values at the sensor.
  Eigen::MatrixXd into_, sensor_shapes_;
};

}  // namespace rotorub
