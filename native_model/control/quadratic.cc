#include "native_model/control/quadratic.h"

#include <Eigen/Core>
#include <cassert>
#include <cmath>
#include <vector>

#include "native_model/bearing/actuator.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/scene/record.h"

namespace rotorub {

// exp(T [A B; 0 0]) = [A_d B_d; 0 1] (Van Loan 1978). If magnetic bearings take samples in between,
// the result is a product of such maps over T_m, each after its S.
LinearPlant sampled(const LinearPlant& plant, double sample_time) {
  const Eigen::Index n = plant.a.rows(), u = plant.b.cols(), m = u + plant.d.cols();
  const bool jumps = plant.every > 0.0;
  const double step = jumps ? plant.every : sample_time;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(n + m, n + m);
  block.topLeftCorner(n, n) = step * plant.a;
  block.topRightCorner(n, m) << step * plant.b, step * plant.d;
  Eigen::MatrixXd over = matrix_exp(block);
  if (jumps) {
    over.topLeftCorner(n, n) = (over.topLeftCorner(n, n) * plant.sample).eval();
    const Eigen::MatrixXd once = over;
    for (long k = std::lround(sample_time / plant.every); k > 1; --k) over = (once * over).eval();
  }
  LinearPlant held = plant;
  held.a = over.topLeftCorner(n, n);
  held.b = over.block(0, n, n, u);
  held.d = over.topRightCorner(n, m - u);
  return held;
}

QuadraticDesign quadratic_design(const scene::Scene& scene, std::size_t bearing,
                                 const LinearPlant& plant) {
  const scene::AuxiliaryBearing& at = scene.auxiliary[bearing];
  const scene::Controller& c = *at.controller;
  QuadraticDesign d{sampled(plant, c.sample_time), {}, {}, at.contact->offset};
  const Eigen::MatrixXd &a = d.plant.a, &b = d.plant.b, &y = d.plant.c;
  const Eigen::MatrixXd apart = (y.topRows(2) - y.bottomRows(2)) / c.allowed_error;
  const Eigen::MatrixXd travel = y.bottomRows(2) / c.allowed_travel;
  const Eigen::MatrixXd q = apart.transpose() * apart + travel.transpose() * travel;
  const Eigen::MatrixXd r = Eigen::Matrix2d::Identity() / (c.allowed_force * c.allowed_force);
  const auto cost = solve_riccati(a, b, q, r);
  if (!cost)
    scene::refuse_at(
        scene, bearing, "controller.kind",
        "no feedback of the ring stabilises rotor and ring: a mode that grows is out of its reach");
  d.gain = riccati_gain(a, b, r, *cost);
  // The force that holds the ring in its offset position while the rotor is at rest, from the
  // ring's two rows of A and B.
  const Eigen::Index half = plant.half(), rate = 2 * half - 2;
  Eigen::VectorXd stand = Eigen::VectorXd::Zero(plant.a.rows());
  stand.segment(half - 2, 2) = -d.offset;
  d.level =
      d.gain * stand -
      (plant.a * stand).segment(rate, 2).cwiseQuotient(plant.b.middleRows(rate, 2).diagonal());
  if (c.kind == scene::ControllerKind::kLqr) return d;

  const Eigen::MatrixXd w = d.plant.d * c.disturbance;
  const Eigen::MatrixXd errors =
      Eigen::Matrix4d::Identity() * (c.measurement_error * c.measurement_error);
  const auto spread = solve_riccati(a.transpose(), y.transpose(), w * w.transpose(), errors);
  if (!spread)
    scene::refuse_at(scene, bearing, "controller.kind",
                     "the positions do not show a mode that grows");
  const Eigen::MatrixXd inner = y * *spread * y.transpose() + errors;
  d.filter = Cholesky(inner).solve(Eigen::MatrixXd(y * *spread)).transpose();
  return d;
}

Eigen::Vector2d StateFeedback::command(const Measurement& now, const SwitchOn&, double*) const {
  assert(now.q != nullptr);
  const std::vector<int>&at = design_.plant.coordinates, &memory = design_.plant.memory;
  const Eigen::Index half = design_.plant.half();
  Eigen::Vector2d u = design_.level;
  for (Eigen::Index i = 0; i < half; ++i) {
    const int k = at[static_cast<std::size_t>(i)];
    u -= design_.gain.col(i) * now.q[k] + design_.gain.col(half + i) * now.v[k];
  }
  for (std::size_t i = 0; i < memory.size(); ++i) {
    u -= design_.gain.col(2 * half + static_cast<Eigen::Index>(i)) * now.v[memory[i]];
  }
  return u;
}

Eigen::Vector2d OutputFeedback::command(const Measurement& now, const SwitchOn&,
                                        double* state) const {
  Eigen::Map<Eigen::VectorXd> x(state, design_.plant.a.rows());
  Eigen::Vector4d y;
  y << now.rotor + design_.offset, now.stator;
  x += design_.filter * (y - design_.plant.c * x);
  const Eigen::Vector2d asked = design_.level - design_.gain * x;
  const Eigen::Vector2d u =
      from_axes(to_axes(asked).cwiseMin(force_limit_).cwiseMax(-force_limit_));
  x = (design_.plant.a * x + design_.plant.b * u).eval();
  return u;
}

}  // namespace rotorub
