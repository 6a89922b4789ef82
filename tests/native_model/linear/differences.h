// The eigenvalues of a lasting rub by differences of the model's own right-hand side: the contact
// and its state are kept, and nothing is linearised by hand.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "native_model/linear/rub_stability.h"
#include "native_model/linear/steady_rub.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/model.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"

namespace rotorub::test {

inline double nearest_to(const rub::Complex& s, const std::vector<rub::Complex>& all) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const rub::Complex& z : all) nearest = std::min(nearest, std::abs(z - s));
  return nearest;
}

// y' of y = (q, v): lambda keeps the relative acceleration on the circle, and where it rolls also
// the slip; else friction is mu(|slip|) lambda, in one sense.
inline Eigen::VectorXd kept_in_contact(const Model& m, const rub::SteadyRub& rub,
                                       const Eigen::VectorXd& y) {
  const Eigen::Index nq = m.nq();
  const Eigen::VectorXd q = y.head(nq), v = y.tail(nq);
  const ContactPoint p = contact_point(m, q.data(), v.data());
  const auto moved = [&](const Eigen::VectorXd& f) {
    Eigen::VectorXd a(nq);
    solve_mass(m, 0.0, q.data(), f.data(), a.data());
    return a;
  };
  // (e_r . d'', e_t . d'' + r Omega_c')
  const auto met = [&](const Eigen::VectorXd& a) {
    const Eigen::Vector3d at = contact_acceleration(m, a.data());
    return Eigen::Vector2d(p.e_r.dot(at.head<2>()),
                           p.e_t().dot(at.head<2>()) + m.first().contact->radius * at[2]);
  };
  const auto push = [&](double normal, double friction) {
    Eigen::VectorXd f = Eigen::VectorXd::Zero(nq);
    add_contact_load(m, contact_load(p.e_r, m.first().contact->radius, normal, friction), f.data());
    return moved(f);
  };
  Eigen::VectorXd free(nq);
  unactuated_force(m, 0.0, q.data(), v.data(), free.data());
  Eigen::VectorXd a = moved(free);

  const double whirl = p.whirl_speed(), turning = whirl / p.delta;
  const Eigen::Vector2d left = met(a) + Eigen::Vector2d(whirl * turning, turning * p.gap_rate);
  if (rub.kind == rub::RubKind::kRolling) {
    const Eigen::VectorXd normal = push(1.0, 0.0), friction = push(0.0, 1.0);
    Eigen::Matrix2d G;
    G << met(normal), met(friction);
    const Eigen::Vector2d lambda = -G.inverse() * left;
    a += lambda[0] * normal + lambda[1] * friction;
  } else {
    const double mu = m.first().contact->friction.at(p.slip);
    const Eigen::VectorXd both = push(1.0, -std::copysign(mu, rub.friction));
    a -= left[0] / met(both)[0] * both;
  }
  Eigen::VectorXd dy(2 * nq);
  dy << v, a;
  return dy;
}

// The residuals that are 0 in contact: (gap, gap rate, and for rolling also the slip).
inline Eigen::VectorXd off_contact(const Model& m, const rub::SteadyRub& rub,
                                   const Eigen::VectorXd& y) {
  const ContactPoint p = contact_point(m, y.data(), y.data() + m.nq());
  Eigen::VectorXd off(rub.kind == rub::RubKind::kRolling ? 3 : 2);
  off.head<2>() << p.gap, p.gap_rate;
  if (off.size() == 3) off[2] = p.slip;
  return off;
}

// Central differences in the frame that turns with the rub, and with the spin, of motions in
// contact: the others only drift, and their repeated 0 would spoil what decays slowly. The model
// stands on the rub at t = 0.
inline std::vector<rub::Complex> by_differences(const Model& model, const rub::SteadyRub& rub) {
  const int n = model.layout.modes, nq = model.nq();
  Eigen::VectorXd y(2 * nq);
  y << model.q0, model.v0;
  Eigen::MatrixXd turn = Eigen::MatrixXd::Zero(2 * nq, 2 * nq);
  const auto pair = [&](int x, int py) {
    turn(x, py) = rub.whirl;
    turn(py, x) = -rub.whirl;
  };
  for (int half = 0; half < 2 * nq; half += nq) {
    for (int k = 0; k < n; ++k) pair(half + k, half + n + k);
    if (model.layout.stator) pair(half + model.layout.ring(), half + model.layout.ring() + 1);
  }
  Eigen::VectorXd spin = Eigen::VectorXd::Zero(2 * nq);
  if (model.layout.spin) spin[model.layout.phi()] = model.speed;
  const auto rate = [&](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    return kept_in_contact(model, rub, x) + turn * x - spin;
  };
  EXPECT_LT(rate(y).norm(), 1e-8 * kept_in_contact(model, rub, y).norm()) << "it stands";
  const Eigen::Index conditions = off_contact(model, rub, y).size();
  Eigen::MatrixXd jacobian(2 * nq, 2 * nq), gradient(conditions, 2 * nq);
  for (int i = 0; i < 2 * nq; ++i) {
    const bool angle = model.layout.turns(i % nq);
    const double size = angle
                            ? (i < nq ? 1.0 : model.speed)
                            : (i < nq ? model.q0 : model.v0).head(2 * n).lpNorm<Eigen::Infinity>();
    const double h = 1e-5 * size;
    Eigen::VectorXd up = y, down = y;
    up[i] += h;
    down[i] -= h;
    jacobian.col(i) = (rate(up) - rate(down)) / (2.0 * h);
    gradient.col(i) = (off_contact(model, rub, up) - off_contact(model, rub, down)) / (2.0 * h);
  }
  constexpr double kRate = 1e3;  // 1/s: places and velocities of one size
  jacobian.leftCols(nq) /= kRate;
  jacobian.topRows(nq) *= kRate;
  gradient.leftCols(nq) /= kRate;
  gradient.rowwise().normalize();
  const Eigen::MatrixXd along = orthogonal_complement(gradient.transpose());
  return real_eigenvalues(along.transpose() * jacobian * along).value();
}

}  // namespace rotorub::test
