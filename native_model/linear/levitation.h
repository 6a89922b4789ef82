// What holds a rotor in magnetic bearings, as a linear loop: its poles, and the sensitivity of each
// of its axes (ISO 14839-3),
//
//   S_k = 1 / (1 + L_k),   L_k the open loop of axis k, all others closed;
//
// it is the k-th diagonal element of (1 + G H)^-1 at the sensors, G the rotor from the currents
// that the controls ask for to the sensors, H the controls: within their limits, of magnets that
// pull against each other about the middle, working for ever where they work at some time. A
// sampled control is looked at below its Nyquist frequency, with its hold and delay; what it folds
// back from above is left out of S.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "native_model/linear/step_response.h"
#include "native_model/model/model.h"

namespace rotorub {

struct LoopSensitivity {
  std::size_t bearing;  // among the scene's magnetic bearings
  int axis;             // 0: x, 1: y
  double peak;          // 1, the most of |S|
  double frequency;     // rad/s, where
};

// Of a machine newly commissioned A is accepted, B of one for unrestricted long-term running, C is
// not for that, D damages: peaks below 3 (9.5 dB), 4 (12 dB), 5 (14 dB), and above.
char sensitivity_zone(double peak);

struct Levitation {
  std::vector<std::complex<double>> poles;  // loop_poles
  double sample_time = 0.0;                 // s, T; 0: continuous
  std::string poles_refused;                // why there are none
  std::vector<LoopSensitivity> loops;
  // |S| at some frequencies, rad/s, ascending: loops x frequencies.
  std::vector<double> frequencies;
  Eigen::MatrixXd sensitivities;
  // Of a loop that is stable, as the loops: of a step of force, and m, peak to peak, how far each
  // sensor's axis moves under the unbalances that act from the start (linear_loop.h).
  std::vector<StepResponse> steps;
  Eigen::VectorXd unbalance;
  bool stable() const { return poles_refused.empty() && !poles.empty() && poles[0].real() < 0.0; }
};

// At the spin speed `speed` (rad/s). Without feedbacks that work: no loops.
Levitation levitation(const Model& model, double speed);

// S at a frequency (rad/s, > 0), two ports of each feedback that works, x before y: p x p.
class LoopResponse {
 public:
  LoopResponse(const Model& model, double speed);
  Eigen::MatrixXcd sensitivity(double frequency) const;
  // 1 + G H.
  Eigen::MatrixXcd return_difference(double frequency) const;
  Eigen::Index ports() const { return into_.cols(); }
  std::size_t bearing(Eigen::Index port) const;          // among the scene's
  const Eigen::MatrixXd& seen() const { return seen_; }  // 2 n x p, of the modes at each sensor

 private:
  Eigen::MatrixXcd controls(double frequency) const;
  Eigen::MatrixXcd open(double frequency, const Eigen::MatrixXcd& force) const;

  Model model_;
  std::vector<std::size_t> working_;  // among the model's feedbacks
  Eigen::VectorXd mass_;              // of bending, as in LinearParts
  Eigen::MatrixXd damping_, stiffness_;
  Eigen::MatrixXd into_, seen_;  // 2 n x p: force of each port's ampere; its sensor
};

}  // namespace rotorub
