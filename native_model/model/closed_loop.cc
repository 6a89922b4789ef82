#include "native_model/model/closed_loop.h"

#include <cmath>

#include "native_model/model/loads.h"
#include "native_model/numerics/eigenvalues.h"

namespace rotorub {
namespace {

// Scales the coordinates from `first` on so that the column and the row of each have equal sums (E.
// E. Osborne, "On pre-conditioning of matrices", J. ACM 7, 1960).
void balance_from(Eigen::Index first, Eigen::MatrixXd& a, Eigen::VectorXd& unit_of) {
  constexpr int kSweeps = 20;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (Eigen::Index k = first; k < a.rows(); ++k) {
      const double own = std::abs(a(k, k));
      const double acts = a.col(k).cwiseAbs().sum() - own, acted = a.row(k).cwiseAbs().sum() - own;
      if (!(acts > 0.0) || !(acted > 0.0)) continue;
      const double unit = std::sqrt(acted / acts);
      a.col(k) *= unit;
      a.row(k) /= unit;
      unit_of[k] *= unit;
    }
  }
}

}  // namespace

ClosedLoop closed_loop(const Model& given, double speed) {
  const Model m = without_offsets(with_linear_feedback(given));
  const Layout& l = m.layout;
  const Eigen::Index bending = 2 * l.modes, states = l.feedback_states;
  ClosedLoop loop{linear_parts(given, speed), Eigen::MatrixXd::Zero(bending, states),
                  Eigen::MatrixXd::Zero(states, bending), Eigen::MatrixXd::Zero(states, bending),
                  Eigen::MatrixXd::Zero(states, states)};
  if (states == 0) return loop;
  const auto works = equations::working_at(m, 0.0);
  const Eigen::VectorXd rest = Eigen::VectorXd::Zero(m.nq());
  const Eigen::VectorXd inverse = m.mass.segment(l.feedback_state(), states).cwiseInverse();
  Eigen::VectorXd f(m.nq());
  const auto rates = [&](const Eigen::VectorXd& q, const Eigen::VectorXd& v) -> Eigen::VectorXd {
    f.setZero();
    equations::add_feedbacks(m, works.data(), q.data(), v.data(), f.data());
    f.segment(l.feedback_state(), states) -=
        m.damping.segment(l.feedback_state(), states)
            .cwiseProduct(v.segment(l.feedback_state(), states));
    return inverse.cwiseProduct(f.segment(l.feedback_state(), states));
  };
  for (Eigen::Index j = 0; j < bending; ++j) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(m.nq(), j);
    loop.of_q.col(j) = rates(unit, rest);
    loop.of_v.col(j) = rates(rest, unit);
  }
  for (Eigen::Index k = 0; k < states; ++k) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(m.nq(), l.feedback_state() + k);
    loop.of_state.col(k) = rates(rest, unit);
    loop.force.col(k) = f.head(bending);
  }
  return loop;
}

FirstOrderForm ClosedLoop::first_order() const {
  const Eigen::Index n = mass.size(), s = force.cols();
  // States (w q, q') with unit mass; w is the uncoupled frequency of each coordinate.
  const Eigen::VectorXd inverse = mass.cwiseSqrt().cwiseInverse();
  const auto scaled = [&](const Eigen::MatrixXd& a) -> Eigen::MatrixXd {
    return inverse.asDiagonal() * a * inverse.asDiagonal();
  };
  const Eigen::MatrixXd k = scaled(stiffness);
  Eigen::VectorXd w = k.diagonal().cwiseAbs().cwiseSqrt();
  const double largest = w.maxCoeff();
  for (double& x : w) {
    if (x == 0.0) x = largest > 0.0 ? largest : 1.0;
  }
  FirstOrderForm form{Eigen::MatrixXd::Zero(2 * n + s, 2 * n + s),
                      Eigen::VectorXd::Ones(2 * n + s)};
  Eigen::MatrixXd& a = form.a;
  form.unit.head(n) = inverse.cwiseQuotient(w);
  form.unit.segment(n, n) = inverse;
  a.topLeftCorner(2 * n, 2 * n) = first_order_form(scaled(damping), k, w);
  if (s == 0) return form;
  a.block(n, 2 * n, n, s) = inverse.asDiagonal() * force;
  a.block(2 * n, 0, s, n) = of_q * inverse.cwiseQuotient(w).asDiagonal();
  a.block(2 * n, n, s, n) = of_v * inverse.asDiagonal();
  a.bottomRightCorner(s, s) = of_state;
  balance_from(2 * n, a, form.unit);
  return form;
}

std::optional<std::vector<std::complex<double>>> closed_loop_eigenvalues(const ClosedLoop& loop) {
  return real_eigenvalues(loop.first_order().a);
}

std::complex<double> filter_of(const StationFeedback& f, double nu) {
  return f.states.filtered == kAbsent ? 1.0
                                      : 1.0 / std::complex<double>(1.0, nu * f.law.derivative_lag);
}

std::complex<double> lag_of(const StationFeedback& f, double nu) {
  return f.states.current == kAbsent ? 1.0
                                     : 1.0 / std::complex<double>(1.0, nu * f.law.amplifier.lag);
}

std::complex<double> gain_of(const StationFeedback& f, double nu) {
  return f.law.proportional + std::complex<double>(0.0, nu * f.law.derivative) * filter_of(f, nu);
}

}  // namespace rotorub
