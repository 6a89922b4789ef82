#include "native_model/system/sampled_feedback.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "native_model/dynamics/equations.h"

namespace rotorub {

void take_sample(const Model& m, const SampledFeedback& s, double t, const double* q, double* v) {
  const LinearController& law = s.law;
  const int n = static_cast<int>(law.states()), ports = static_cast<int>(law.ports());
  double *x = v + s.state, *held = v + s.command;
  const int queue = ports * s.delay;
  const auto works_at = [&](double time) {
    return std::any_of(s.bearings.begin(), s.bearings.end(),
                       [&](std::size_t k) { return m.feedbacks[k].works.at(time); });
  };
  if (!works_at(t)) {
    std::fill_n(x, n, 0.0);
    std::fill_n(held, queue + ports, 0.0);
    return;
  }
  // What the sensors show, and what may be asked for.
  double y[kMaxPorts], asked[kMaxPorts], given[kMaxPorts], after[kMaxCoordinates];
  for (std::size_t k = 0; k < s.bearings.size(); ++k) {
    const auto seen = equations::at_station(m.layout.modes, m.feedbacks[s.bearings[k]].seen(), q);
    y[2 * k] = seen.x;
    y[2 * k + 1] = seen.y;
  }
  const auto sum = [](const Eigen::MatrixXd& matrix, int row, const double* of) {
    double total = 0.0;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j) total += matrix(row, j) * of[j];
    return total;
  };
  const double before = t - s.sample_time;
  if (before < -0.5 * s.sample_time || !works_at(before)) {
    for (int i = 0; i < n; ++i) x[i] = sum(law.start, i, y);
    std::fill_n(held, queue + ports, 0.0);
  }
  for (int i = 0; i < ports; ++i) {
    const StationFeedback& bearing = m.feedbacks[s.bearings[static_cast<std::size_t>(i / 2)]];
    asked[i] = -(sum(law.c, i, x) + sum(law.d, i, y));
    given[i] = bearing.works.at(t) ? bearing.law.limited(asked[i]) : 0.0;
  }
  for (int i = 0; i < n; ++i) {
    after[i] = sum(law.a, i, x) + sum(law.b, i, y);
    for (int j = 0; j < ports; ++j) after[i] += law.back(i, j) * (asked[j] - given[j]);
  }
  std::copy_n(after, n, x);
  std::copy(held + ports, held + ports + queue, held);
  std::copy_n(given, ports, held + queue);
}

bool take_samples(const Model& m, double t, double h, const double* q, double* v) {
  constexpr double kLate = 1e-3;  // of a step, by which sums of steps miss a sample
  bool taken = false;
  for (const SampledFeedback& s : m.samplers) {
    const auto passed = [&](double time) { return std::floor((time + kLate * h) / s.sample_time); };
    if (t > 0.5 * h && passed(t) == passed(t - h)) continue;
    take_sample(m, s, t, q, v);
    taken = true;
  }
  return taken;
}

void jump_in_step(const Model& m, double t, double h, const double* q, double* v, double* f) {
  if (m.samplers.empty()) return;
  double after[kMaxCoordinates];
  std::copy_n(v, m.nq(), after);
  if (!take_samples(m, t, h, q, after)) return;
  for (int i = m.sampled_states(); i < m.layout.coil(); ++i) {
    const double jump = after[i] - v[i];
    f[i] += m.mass[i] * jump / h;
    v[i] += (t > 0.5 * h ? 0.5 : 1.0) * jump;
  }
}

std::string sample_refusal(const Model& m, double step) {
  for (const SampledFeedback& s : m.samplers) {
    const double ratio = s.sample_time / step;
    if (std::round(ratio) >= 1.0 && std::abs(ratio - std::round(ratio)) < 1e-6) continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  "step %g s does not meet the samples of a magnetic bearing's control, every %g "
                  "s; accepted: a whole part of it",
                  step, s.sample_time);
    return text;
  }
  return {};
}

}  // namespace rotorub
