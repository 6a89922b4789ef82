#include "native_model/linear/levitation.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "native_model/linear/free_motion.h"
#include "native_model/linear/linear_loop.h"
#include "native_model/model/closed_loop.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/linear_solve.h"

namespace rotorub {
namespace {

// Frequencies at which |S| is evaluated, rad/s, ascending: evenly spaced over the decades of the
// poles, and dense around each pole.
std::vector<double> frequencies(const Model& m, const std::vector<std::complex<double>>& poles) {
  constexpr int kEven = 1200;
  double low = smallest_size(poles), high = largest_size(poles);
  if (!(high > 0.0)) low = 1.0, high = 1e5;
  low = std::max(0.01 * low, 1e-6 * high);
  high *= 3.0;
  for (const SampledFeedback& s : m.samplers)
    high = std::min(high, std::numbers::pi / s.sample_time);
  std::vector<double> all;
  for (int k = 0; k < kEven; ++k) all.push_back(low * std::pow(high / low, k / (kEven - 1.0)));
  for (const std::complex<double>& s : poles) {
    for (const double by : {0.0, 0.1, 0.3, 0.6, 1.0, 2.0}) {
      for (const double sign : {-1.0, 1.0}) {
        const double w = s.imag() + sign * by * s.real();
        if (w > low && w < high) all.push_back(w);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// Maximum of f between low and high by golden section, as (position, value).
template <class F>
std::pair<double, double> peak_between(const F& f, double low, double high) {
  const double share = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - share * (high - low), b = low + share * (high - low), fa = f(a), fb = f(b);
  while (high - low > 1e-9 * high) {
    if (fa < fb) {
      low = std::exchange(a, b);
      fa = std::exchange(fb, f(b = low + share * (high - low)));
    } else {
      high = std::exchange(b, a);
      fb = std::exchange(fa, f(a = high - share * (high - low)));
    }
  }
  return fa > fb ? std::pair(a, fa) : std::pair(b, fb);
}

// Peak-to-peak motion of each sensor axis, m, under the unbalances that act from the start.
Eigen::VectorXd moved(Model m, const LinearLoop& loop, double speed,
                      const Eigen::MatrixXd& sensor_shapes) {
  std::erase_if(m.unbalances, [](const DiscUnbalance& u) { return u.on > 0.0; });
  if (speed == 0.0) return Eigen::VectorXd::Zero(sensor_shapes.cols());
  const Eigen::VectorXcd q = loop_amplitude(m, loop, std::abs(speed), unbalance_load(m, speed));
  return 2.0 * (sensor_shapes.transpose() * q).cwiseAbs();
}

}  // namespace

char sensitivity_zone(double peak) {
  return peak < 3.0 ? 'A' : peak < 4.0 ? 'B' : peak < 5.0 ? 'C' : 'D';
}

LoopResponse::LoopResponse(const Model& model, double speed) : model_(always_working(model)) {
  Model open = model_;
  for (StationFeedback& f : open.feedbacks) f.law.proportional = f.law.derivative = 0.0;
  parts_ = linear_parts(open, speed);
  working_ = working_feedbacks(model_);
  const Eigen::Index n = model_.layout.modes, p = 2 * static_cast<Eigen::Index>(working_.size());
  into_ = sensor_shapes_ = Eigen::MatrixXd::Zero(2 * n, p);
  for (Eigen::Index j = 0; j < p; j += 2) {
    const StationFeedback& f = model_.feedbacks[working_[static_cast<std::size_t>(j / 2)]];
    const double gain = f.law.force_per_current;
    put_planes(into_, j, {gain * f.shape.x, gain * f.shape.y});
    put_planes(sensor_shapes_, j, f.sensor_shape());
  }
}

std::size_t LoopResponse::bearing(Eigen::Index port) const {
  return model_.feedbacks[working_[static_cast<std::size_t>(port / 2)]].number;
}

// H: the currents are -H y.
Eigen::MatrixXcd LoopResponse::controls(double w) const {
  Eigen::MatrixXcd h = Eigen::MatrixXcd::Zero(ports(), ports());
  for (Eigen::Index j = 0; j < ports(); ++j) {
    const StationFeedback& f = model_.feedbacks[working_[static_cast<std::size_t>(j / 2)]];
    if (f.states.command == kAbsent)
      h(j, j) = gain_of(f, w) + f.law.integral / std::complex<double>(0.0, w);
  }
  const auto port_of = [&](const SampledFeedback& s, Eigen::Index port) {
    const std::size_t feedback = s.bearings[static_cast<std::size_t>(port / 2)];
    const auto at = std::find(working_.begin(), working_.end(), feedback);
    return at == working_.end() ? Eigen::Index{-1} : 2 * (at - working_.begin()) + port % 2;
  };
  for (const SampledFeedback& s : model_.samplers) {
    // C (z - A)^-1 B + D at z = e^{i w T}, with hold over T and the delay.
    const LinearController& law = s.law;
    const std::complex<double> turn(0.0, w * s.sample_time), z = std::exp(turn);
    Eigen::MatrixXcd answer = law.d.cast<std::complex<double>>();
    if (law.states() > 0) {
      const Eigen::MatrixXcd inner = z * Eigen::MatrixXcd::Identity(law.states(), law.states()) -
                                     law.a.cast<std::complex<double>>();
      answer += law.c.cast<std::complex<double>>() *
                lu_solve(inner, Eigen::MatrixXcd(law.b.cast<std::complex<double>>()));
    }
    answer *= (1.0 - 1.0 / z) / turn * std::exp(-turn * static_cast<double>(s.delay));
    for (Eigen::Index i = 0; i < law.ports(); ++i) {
      for (Eigen::Index j = 0; j < law.ports(); ++j) {
        const Eigen::Index to = port_of(s, i), from = port_of(s, j);
        if (to >= 0 && from >= 0) h(to, from) = answer(i, j);
      }
    }
  }
  for (Eigen::Index j = 0; j < ports(); ++j) {
    h.row(j) *= lag_of(model_.feedbacks[working_[static_cast<std::size_t>(j / 2)]], w);
  }
  return h;
}

// Sensor signals under forces of one frequency, with the controls open.
Eigen::MatrixXcd LoopResponse::open(double w, const Eigen::MatrixXcd& force) const {
  return sensor_shapes_.transpose().cast<std::complex<double>>() *
         lu_solve(dynamic_stiffness(parts_, w), force);
}

Eigen::MatrixXcd LoopResponse::return_difference(double w) const {
  const Eigen::MatrixXcd g = open(w, into_.cast<std::complex<double>>());
  return Eigen::MatrixXcd::Identity(ports(), ports()) + g * controls(w);
}

MagneticPlant LoopResponse::plant() const {
  const Eigen::Index half = parts_.mass.size();
  const Eigen::VectorXd mobility = parts_.mass.cwiseInverse();
  MagneticPlant p;
  p.a = Eigen::MatrixXd::Zero(2 * half, 2 * half);
  p.a.topRightCorner(half, half).setIdentity();
  p.a.bottomLeftCorner(half, half) = -(mobility.asDiagonal() * parts_.stiffness);
  p.a.bottomRightCorner(half, half) = -(mobility.asDiagonal() * parts_.damping);
  p.b = Eigen::MatrixXd::Zero(2 * half, ports());
  p.b.bottomRows(half) = mobility.asDiagonal() * into_;
  p.c = Eigen::MatrixXd::Zero(ports(), 2 * half);
  p.c.leftCols(half) = sensor_shapes_.transpose();
  for (Eigen::Index j = 0; j < ports(); j += 2) p.bearings.push_back(bearing(j));
  return p;
}

Eigen::MatrixXcd LoopResponse::sensitivity(double w) const {
  return lu_inverse(return_difference(w));
}

Levitation levitation_poles(const Model& model, double speed) {
  Levitation out;
  const Model m = always_working(model);
  if (working_feedbacks(m).empty()) return out;
  out.poles_refused = loop_refusal(m);
  if (!out.poles_refused.empty()) return out;
  if (const auto poles = loop_poles(linear_loop(m, speed))) {
    out.poles = *poles;
  } else {
    out.poles_refused = "the eigenvalues do not converge";
  }
  return out;
}

Levitation levitation(const Model& model, double speed) {
  Levitation out = levitation_poles(model, speed);
  const LoopResponse response(model, speed);
  if (response.ports() == 0) return out;
  const Model m = always_working(model);
  if (std::ranges::any_of(m.samplers, [](const auto& s) { return s.library != nullptr; }))
    return out;
  if (!m.samplers.empty()) out.sample_time = m.samplers.front().sample_time;
  if (out.stable()) {
    const LinearLoop loop = linear_loop(m, speed);
    out.steps = step_responses(m, loop, out.poles);
    out.unbalance = moved(m, loop, speed, response.sensor_shapes());
  }
  const std::vector<double> at = frequencies(m, out.poles);
  Eigen::MatrixXd sizes(response.ports(), static_cast<Eigen::Index>(at.size()));
  for (std::size_t k = 0; k < at.size(); ++k) {
    sizes.col(static_cast<Eigen::Index>(k)) = response.sensitivity(at[k]).diagonal().cwiseAbs();
  }
  for (Eigen::Index j = 0; j < response.ports(); ++j) {
    Eigen::Index most = 0;
    LoopSensitivity loop{response.bearing(j), static_cast<int>(j % 2), 0.0, 0.0};
    loop.peak = sizes.row(j).maxCoeff(&most);
    loop.frequency = at[static_cast<std::size_t>(most)];
    if (most > 0 && most + 1 < sizes.cols()) {
      const auto size = [&](double w) { return std::abs(response.sensitivity(w)(j, j)); };
      const auto [where, peak] = peak_between(size, at[static_cast<std::size_t>(most - 1)],
                                              at[static_cast<std::size_t>(most + 1)]);
      if (peak > loop.peak) loop.peak = peak, loop.frequency = where;
    }
    out.loops.push_back(loop);
  }
  out.frequencies = at;
  out.sensitivities = sizes;
  return out;
}

}  // namespace rotorub
