// LQR and LQG: the feedback u = -K x of rotor and ring without contact that is least in the sum
// over the samples of
//
//   |q_r - q_f|^2 / e_0^2 + |q_f|^2 / s_0^2 + |u|^2 / u_0^2,
//
// e_0, s_0, u_0: what is allowed of the rotor's distance from the ring's centre, of the ring's
// travel and of the force (Bryson's rule). It keeps the ring about the rotor, so that they do not
// touch. K by the discrete Riccati equation (numerics/matrix_functions.h).
//
// All is counted from where the ring stands about the rotor at rest: off its own middle by -o, o =
// contact.offset, held there by u_s = -K_f o against its springs. So u = u_s - K (x - x_s).
//
// LQR knows the whole state, which no sensor shows, that of magnetic bearings' feedbacks too: the
// best that a linear law can do. LQG estimates all of it from the measured positions of rotor and
// ring by a stationary Kalman filter,
//
//   x_k = x_k- + L (y_k - C x_k-),   x_{k+1}- = A x_k + B u_k,
//
// for forces d (N, standard deviation) on rotor and ring at the contact and errors r (m) of the
// positions.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "native_model/control/controller.h"

namespace rotorub {

// Rotor and ring without contact, at a held spin speed, as linear equations for the design of a
// law:
//
//   x' = A x + B u + D d,   y = C x,
//   x = (x_1..x_n, y_1..y_n, ring x, ring y, their rates, and z: what the feedbacks of magnetic
//   bearings remember - integrators, filters, currents behind amplifiers, sampled controls),
//
// u the force on the ring, N, fixed frame; d forces on the rotor at the contact and on the ring, N,
// (x, y) each; y = (rotor x, y at the contact, ring x, y), m. Forces, unbalance, weight and
// magnets' pull are no part of it: they are what disturbs it. Where sampled controls hold the
// rotor, x <- S x at each of their samples, every T_m.
struct LinearPlant {
  Eigen::MatrixXd a;  // (2 N + s) square, N = 2 n + 2
  Eigen::MatrixXd b;  // (2 N + s) x 2
  Eigen::MatrixXd d;  // (2 N + s) x 4
  Eigen::MatrixXd c;  // 4 x (2 N + s)
  // Of a model's coordinates those of the states, N: x_i = q[coordinates[i]], x_{N+i} =
  // v[coordinates[i]].
  std::vector<int> coordinates;
  // z_i = v[memory[i]], s; a name for each.
  std::vector<int> memory{};
  std::vector<std::string> memory_names{};
  double every = 0.0;        // s, T_m; 0: nothing is sampled
  Eigen::MatrixXd sample{};  // S; empty: nothing is sampled

  Eigen::Index half() const { return static_cast<Eigen::Index>(coordinates.size()); }
};

// Over samples of T (s): x_{k+1} = A x_k + B u_k + D d_k under held u and d, x_k before what the
// magnetic bearings' controls sample at the same instant. T is a whole multiple of T_m.
LinearPlant sampled(const LinearPlant& plant, double sample_time);

// Throws scene::SceneError where the Riccati equation has no stabilising solution.
struct QuadraticDesign {
  LinearPlant plant;                 // sampled
  Eigen::MatrixXd gain;              // K, 2 x (2 N + s)
  Eigen::MatrixXd filter;            // L, (2 N + s) x 4; empty: LQR
  Eigen::Vector2d offset{0.0, 0.0};  // m, o, which the measured positions of the rotor count from
  Eigen::Vector2d level{0.0, 0.0};   // N, u_s + K x_s: u = level - K x
};
QuadraticDesign quadratic_design(const scene::Scene& scene, const LinearPlant& plant);

class StateFeedback final : public Controller {
 public:
  explicit StateFeedback(QuadraticDesign design) : design_(std::move(design)) {}
  Eigen::Vector2d command(const Measurement& now, const SwitchOn&, double*) const override;

 private:
  QuadraticDesign design_;
};

class OutputFeedback final : public Controller {
 public:
  // force_limit: N, on each axis of the actuator; what it cuts off the estimate knows.
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
