#include "native_model/model/sampled_feedback.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "native_model/control/magnetic_library.h"
#include "native_model/model/equations.h"

namespace rotorub {

namespace {

constexpr double kSampleRoundOff = 1e-9;  // share of the sample time

double product(const Eigen::MatrixXd& matrix, int row, const double* of) {
  double total = 0.0;
  for (Eigen::Index j = 0; j < matrix.cols(); ++j) total += matrix(row, j) * of[j];
  return total;
}

// One sample, per port: deflections shown by the sensors, m; requested currents, A; currents after
// the limits, A.
struct Sample {
  double deflection[kMaxPorts] = {}, asked[kMaxPorts] = {}, given[kMaxPorts] = {};
};

// Sets the requested currents and advances the law's states x to the next sample. The anti-windup
// correction is added later.
void ask_matrices(const LinearController& law, Sample& sample, double* x) {
  double after[kMaxCoordinates];
  const int n = static_cast<int>(law.states()), ports = static_cast<int>(law.ports());
  for (int i = 0; i < ports; ++i)
    sample.asked[i] = -(product(law.c, i, x) + product(law.d, i, sample.deflection));
  for (int i = 0; i < n; ++i)
    after[i] = product(law.a, i, x) + product(law.b, i, sample.deflection);
  std::copy_n(after, n, x);
}

void ask_library(const Model& m, const SampledFeedback& s, double t, const double* q,
                 const double* v, Sample& sample, double* x) {
  double current[kMaxPorts];
  for (std::size_t k = 0; k < s.bearings.size(); ++k) {
    const FeedbackStates& states = m.feedbacks[s.bearings[k]].states;
    std::copy_n(v + (states.current == kAbsent ? states.command : states.current), 2,
                current + 2 * k);
  }
  rotorub_magnetic_measurement now{};
  now.t = t;
  now.sample = static_cast<std::int64_t>(sample_index(t, s.sample_time));
  now.deflection = sample.deflection;
  now.current = current;
  now.spin_angle = equations::spin_angle(m, t, q);
  now.spin_speed = equations::spin_speed(m, v);
  s.library->step(now, x, sample.asked);
}

// s, the exact k T next to t. Steps and sums of steps reach k T only up to round-off, and so does a
// time in the scene.
double instant_of(double sample_time, double t) {
  return std::round(t / sample_time) * sample_time;
}

bool bearing_works(const Model& m, const SampledFeedback& s, std::size_t bearing, double time) {
  return m.feedbacks[bearing].works.at(time + kSampleRoundOff * s.sample_time);
}
bool works_at(const Model& m, const SampledFeedback& s, double time) {
  return std::any_of(s.bearings.begin(), s.bearings.end(),
                     [&](std::size_t k) { return bearing_works(m, s, k, time); });
}

// True if the sample at this instant is the first, or the first after the control was off. It works
// at this instant.
bool begins_at(const Model& m, const SampledFeedback& s, double instant) {
  const double before = instant - s.sample_time;
  return before < -0.5 * s.sample_time || !works_at(m, s, before);
}

// m, deflections shown by the sensors, one per port.
void read_sensors(const Model& m, const SampledFeedback& s, const double* q, double* deflection) {
  for (std::size_t k = 0; k < s.bearings.size(); ++k) {
    const auto at =
        equations::at_station(m.layout.modes, m.feedbacks[s.bearings[k]].sensor_shape(), q);
    deflection[2 * k] = at.x;
    deflection[2 * k + 1] = at.y;
  }
}

// x = X y.
void start_law(const SampledFeedback& s, const double* deflection, double* x) {
  for (int i = 0; i < static_cast<int>(s.law.states()); ++i)
    x[i] = product(s.law.start, i, deflection);
  if (s.library) s.library->start(x);
}

}  // namespace

void take_sample(const Model& m, const SampledFeedback& s, double t, const double* q, double* v) {
  const LinearController& law = s.law;
  const int n = static_cast<int>(law.states()), ports = static_cast<int>(law.ports());
  const int queue = ports * s.delay;
  double *state = v + s.state, *held = v + s.command;
  const double instant = instant_of(s.sample_time, t);
  if (!works_at(m, s, instant)) {
    std::fill_n(state, n, 0.0);
    std::fill_n(held, queue + ports, 0.0);
    return;
  }
  Sample sample;
  read_sensors(m, s, q, sample.deflection);
  double x[kMaxCoordinates];
  std::copy_n(state, n, x);
  const bool begins = begins_at(m, s, instant);
  if (begins) start_law(s, sample.deflection, x);
  if (s.library) {
    ask_library(m, s, t, q, v, sample, x);
  } else {
    ask_matrices(law, sample, x);
  }
  for (int i = 0; i < ports; ++i) {
    const std::size_t k = s.bearings[static_cast<std::size_t>(i / 2)];
    sample.given[i] =
        bearing_works(m, s, k, instant) ? m.feedbacks[k].law.limited(sample.asked[i]) : 0.0;
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < ports; ++j) x[i] += law.back(i, j) * (sample.asked[j] - sample.given[j]);
  }
  if (begins) std::fill_n(held, queue + ports, 0.0);
  std::copy_n(x, n, state);
  std::copy(held + ports, held + ports + queue, held);
  std::copy_n(sample.given, ports, held + queue);
}

void begin_samples(const Model& m, double t, const double* q, double* v) {
  constexpr double kDue = 1e-6;  // share of the sample time by which a sum of steps misses a sample
  for (const SampledFeedback& s : m.samplers) {
    const double instant = instant_of(s.sample_time, t);
    if (std::abs(t - instant) > kDue * s.sample_time) continue;
    if (!works_at(m, s, instant) || !begins_at(m, s, instant)) continue;
    double deflection[kMaxPorts];
    read_sensors(m, s, q, deflection);
    start_law(s, deflection, v + s.state);
    std::fill_n(v + s.command, static_cast<int>(s.law.ports()) * (1 + s.delay), 0.0);
  }
}

Eigen::MatrixXd linear_sample(const Model& m) {
  const Eigen::Index bending = 2 * m.layout.modes, states = m.layout.feedback_states;
  Eigen::MatrixXd sample(states, bending + states);
  Eigen::VectorXd q(m.nq()), v(m.nq());
  for (Eigen::Index j = 0; j < bending + states; ++j) {
    q.setZero();
    v.setZero();
    if (j < bending) {
      q[j] = 1.0;
    } else {
      v[m.layout.feedback_state() + j - bending] = 1.0;
    }
    for (const SampledFeedback& s : m.samplers) {
      const double later = 1000.0 * s.sample_time;  // not the first sample
      take_sample(m, s, later, q.data(), v.data());
    }
    sample.col(j) = v.segment(m.layout.feedback_state(), states);
  }
  return sample;
}

bool take_samples(const Model& m, double t, double h, const double* q, double* v) {
  constexpr double kTimeError = 1e-3;  // share of a step by which a sum of steps misses a sample
  bool taken = false;
  for (const SampledFeedback& s : m.samplers) {
    const auto passed = [&](double time) {
      return std::floor((time + kTimeError * h) / s.sample_time);
    };
    if (t > 0.5 * h && passed(t) == passed(t - h)) continue;
    take_sample(m, s, t, q, v);
    taken = true;
  }
  return taken;
}

void take_samples_in_step(const Model& m, double t, double h, const double* q, double* v,
                          double* f) {
  if (m.samplers.empty()) return;
  double after[kMaxCoordinates];
  std::copy_n(v, m.nq(), after);
  if (!take_samples(m, t, h, q, after)) return;
  for (int i = m.sampled_states(); i < m.layout.coil(); ++i) {
    const double change = after[i] - v[i];
    f[i] += m.mass[i] * change / h;
    v[i] += (t > 0.5 * h ? 0.5 : 1.0) * change;
  }
}

bool falls_on_sample(double sample_time, double t) {
  return std::abs(t - instant_of(sample_time, t)) < kSampleRoundOff * sample_time;
}

std::string sample_refusal(const Model& m, double step) {
  for (const SampledFeedback& s : m.samplers) {
    const double ratio = s.sample_time / step;
    if (std::round(ratio) >= 1.0 && std::abs(ratio - std::round(ratio)) < 1e-6) continue;
    char text[200];
    std::snprintf(text, sizeof text,
                  "step %g s does not divide the sample time of a magnetic bearing's control, %g "
                  "s; choose a whole fraction of it",
                  step, s.sample_time);
    return text;
  }
  return {};
}

}  // namespace rotorub
