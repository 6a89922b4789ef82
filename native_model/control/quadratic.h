// LQR and LQG: the feedback u = -K x of rotor and ring without contact that minimises, summed over
// the samples,
//
//   |q_r - q_f|^2 / e_0^2 + |q_f|^2 / s_0^2 + |u|^2 / u_0^2.
//
// e_0, s_0 and u_0 are the allowed distance of the rotor from the ring's centre, the allowed travel
// of the ring and the allowed force (Bryson's rule). The feedback keeps the ring centred about the
// rotor, so that they do not touch. K follows from the discrete Riccati equation
// (numerics/matrix_functions.h).
//
// All states are relative to the ring centred about the rotor at rest. The ring is then displaced
// from its own middle by -o, o = contact.offset, and the force u_s = -K_f o holds it there against
// its springs. Therefore u = u_s - K (x - x_s).
//
// LQR uses the whole state, including the states of the magnetic bearings' feedbacks. No sensor can
// measure it, so LQR is the limit of what a linear law can achieve. LQG estimates the state from
// the measured positions of rotor and ring by a stationary Kalman filter,
//
//   x_k = x_k- + L (y_k - C x_k-),   x_{k+1}- = A x_k + B u_k,
//
// for disturbing forces d (N, standard deviation) on rotor and ring at the contact, and measurement
// errors r (m, standard deviation) of the positions.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "native_model/control/controller.h"

namespace rotorub {

// Rotor and ring without contact, at a constant spin speed, as linear equations for the design of a
// law:
//
//   x' = A x + B u + D d,   y = C x,
//   x = (x_1..x_n, y_1..y_n, ring x, ring y, their rates, and z: the states of the magnetic
//   bearings' feedbacks - integrators, filters, currents behind amplifiers, sampled controls).
//
// u is the force on the ring, N, fixed frame; d are the forces on the rotor at the contact and on
// the ring, N, (x, y) each; y = (rotor x, y at the contact, ring x, y), m. Forces, unbalance,
// weight and the static pull of magnets are left out: they are disturbances. If sampled controls
// hold the rotor, x <- S x at each of their samples, every T_m.
struct LinearPlant {
  Eigen::MatrixXd a;  // (2 N + s) square, N = 2 n + 2
  Eigen::MatrixXd b;  // (2 N + s) x 2
  Eigen::MatrixXd d;  // (2 N + s) x 4
  Eigen::MatrixXd c;  // 4 x (2 N + s)
  // N, index of each state in the model's coordinates: x_i = q[coordinates[i]],
  // x_{N+i} = v[coordinates[i]].
  std::vector<int> coordinates;
  // s, z_i = v[memory[i]]; one name each.
  std::vector<int> memory{};
  std::vector<std::string> memory_names{};
  double every = 0.0;        // s, T_m; 0: nothing is sampled
  Eigen::MatrixXd sample{};  // S; empty: nothing is sampled

  Eigen::Index half() const { return static_cast<Eigen::Index>(coordinates.size()); }
};

// The plant sampled every T (s): x_{k+1} = A x_k + B u_k + D d_k for constant u and d. x_k is the
// state before the controls of the magnetic bearings take their sample at the same instant. T is a
// whole multiple of T_m.
LinearPlant sampled(const LinearPlant& plant, double sample_time);

// The sampled plant and the gains computed for it.
struct QuadraticDesign {
  LinearPlant plant;                 // sampled
  Eigen::MatrixXd gain;              // K, 2 x (2 N + s)
  Eigen::MatrixXd filter;            // L, (2 N + s) x 4; empty: LQR
  Eigen::Vector2d offset{0.0, 0.0};  // m, o; the measured rotor positions are relative to it
  Eigen::Vector2d level{0.0, 0.0};   // N, u_s + K x_s: u = level - K x
};
// The design for the controller of an auxiliary bearing. Throws scene::SceneError if the Riccati
// equation has no stabilising solution.
QuadraticDesign quadratic_design(const scene::Scene& scene, std::size_t bearing,
                                 const LinearPlant& plant);

class StateFeedback final : public Controller {
 public:
  explicit StateFeedback(QuadraticDesign design) : design_(std::move(design)) {}
  Eigen::Vector2d command(const Measurement& now, const SwitchOn&, double*) const override;

 private:
  QuadraticDesign design_;
};

class OutputFeedback final : public Controller {
 public:
  // force_limit: N, on each axis of the actuator; the estimator uses the limited force.
  OutputFeedback(QuadraticDesign design, double force_limit)
      : design_(std::move(design)), force_limit_(force_limit) {}
  std::size_t state_size() const override {
    return static_cast<std::size_t>(design_.plant.a.rows());
  }
  Eigen::Vector2d command(const Measurement& now, const SwitchOn&, double* state) const override;

 private:
  QuadraticDesign design_;
  double force_limit_;
};

}  // namespace rotorub
