#include "native_model/control/linear_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub {
LinearController no_law(Eigen::Index states, Eigen::Index ports) {
  const auto zero = [](Eigen::Index rows, Eigen::Index columns) -> Eigen::MatrixXd {
    return Eigen::MatrixXd::Zero(rows, columns);
  };
  return {zero(states, states), zero(states, ports), zero(ports, states),
          zero(ports, ports),   zero(states, ports), zero(states, ports)};
}

LinearController sampled_pid(const SampledPid& pid, double T) {
  // x = (j, d_{k-1}, y_{k-1}); parts that the law does not need are left out.
  const bool integrates = pid.integral > 0.0, differs = pid.derivative > 0.0;
  const bool filters = differs && pid.derivative_lag > 0.0;
  const Eigen::Index j = 0, d = integrates ? 1 : 0, before = d + (filters ? 1 : 0);
  LinearController law = no_law(before + (differs ? 1 : 0), 1);
  law.d(0, 0) = pid.proportional;
  if (integrates) {
    law.a(j, j) = law.c(0, j) = 1.0;
    law.b(j, 0) = T * pid.integral;
    law.back(j, 0) = T * pid.integral / pid.proportional;
  }
  if (!differs) return law;
  const double whole = pid.derivative_lag + T, kept = pid.derivative_lag / whole;
  law.d(0, 0) += pid.derivative / whole;
  law.c(0, before) = -pid.derivative / whole;
  law.b(before, 0) = law.start(before, 0) = 1.0;
  if (filters) {
    law.a(d, d) = kept;
    law.a(d, before) = -1.0 / whole;
    law.b(d, 0) = 1.0 / whole;
    law.c(0, d) = pid.derivative * kept;
  }
  return law;
}

// Observer canonical form: u = -(x_1 + b_0 y), x_i <- x_{i+1} - a_i (x_1 + b_0 y) + b_i y.
LinearController transfer_function(const std::vector<double>& numerator,
                                   const std::vector<double>& denominator) {
  const std::size_t size = std::max(numerator.size(), denominator.size());
  assert(!denominator.empty() && denominator.front() != 0.0);
  const auto of = [&](const std::vector<double>& list, std::size_t i) {
    return i < list.size() ? list[i] / denominator.front() : 0.0;
  };
  const auto n = static_cast<Eigen::Index>(size) - 1;
  LinearController law = no_law(n, 1);
  law.d(0, 0) = of(numerator, 0);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i) + 1;
    law.a(i, 0) = -of(denominator, k);
    if (i + 1 < n) law.a(i, i + 1) = 1.0;
    law.b(i, 0) = of(numerator, k) - of(denominator, k) * of(numerator, 0);
  }
  if (n > 0) law.c(0, 0) = 1.0;
  return law;
}

LinearController state_space(const std::vector<double>& a, const std::vector<double>& b,
                             const std::vector<double>& c, const std::vector<double>& d,
                             Eigen::Index ports) {
  const auto n = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(a.size()))));
  LinearController law = no_law(n, ports);
  const auto fill = [](const std::vector<double>& from, Eigen::MatrixXd& to) {
    assert(from.empty() || static_cast<Eigen::Index>(from.size()) == to.size());
    for (std::size_t i = 0; i < from.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      to(k / to.cols(), k % to.cols()) = from[i];
    }
  };
  fill(a, law.a);
  fill(b, law.b);
  fill(c, law.c);
  fill(d, law.d);
  return law;
}

LinearController on_both_axes(const LinearController& one) {
  const Eigen::Index n = one.states(), p = one.ports();
  LinearController law = no_law(2 * n, 2 * p);
  const auto twice = [](const Eigen::MatrixXd& from, Eigen::MatrixXd& to) {
    to.topLeftCorner(from.rows(), from.cols()) = from;
    to.bottomRightCorner(from.rows(), from.cols()) = from;
  };
  twice(one.a, law.a);
  twice(one.b, law.b);
  twice(one.c, law.c);
  twice(one.d, law.d);
  twice(one.back, law.back);
  twice(one.start, law.start);
  return law;
}

}  // namespace rotorub
