#include "compare/metrics/orders.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compare/metrics/fourier.h"
#include "compare/metrics/rows.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;
constexpr double kSpinTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kSteps = 32;  // per turn

// The rows from the first one at which the rotor turns.
struct Turning {
  std::vector<double> angle, t, slowness;  // rad, ascending; s; s/rad
  double sense = 1.0;
};

Turning turning(const Trajectory& run) {
  constexpr double kStill = 0.02;  // relative to the highest speed
  const auto &t = run.column("t"), &angle = run.column("spin_angle"),
             &speed = run.column("spin_speed");
  Turning out;
  if (t.size() < 2) return out;
  out.sense = angle.back() < angle.front() ? -1.0 : 1.0;
  double most = 0.0;
  for (const double s : speed) most = std::max(most, out.sense * s);
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double along = out.sense * speed[i], at = out.sense * angle[i];
    if (along <= kStill * most) {
      if (out.t.empty() && along >= -kStill * most) continue;
      return {};  // it reverses or stops in between
    }
    // Rows at the same instant: a jump, or times that differ by round-off.
    if (!out.t.empty() && at <= out.angle.back()) continue;
    out.angle.push_back(at);
    out.t.push_back(t[i]);
    out.slowness.push_back(1.0 / along);
  }
  return out;
}

}  // namespace

OrderTrack order_track(const Trajectory& run, std::size_t most) {
  const Turning turn = turning(run);
  OrderTrack track;
  if (turn.t.size() < 2) return track;
  const auto turns = static_cast<std::size_t>((turn.angle.back() - turn.angle.front()) / kSpinTurn);
  const std::size_t length = OrderTrack::kTurns * kSteps;
  if (turns < OrderTrack::kTurns || turn.t.size() < kRowsOfATurn * turns) return track;

  std::vector<double> angles(turns * kSteps);
  for (std::size_t n = 0; n < angles.size(); ++n) {
    angles[n] =
        turn.angle.front() + kSpinTurn * static_cast<double>(n) / static_cast<double>(kSteps);
  }
  const std::vector<double> times = cubic(turn.angle, turn.t, turn.slowness, angles);
  const auto at = [&](const char* place, const char* rate) {
    return cubic(run.column("t"), run.column(place), run.column(rate), times);
  };
  const std::vector<double> x = at("rotor_x", "rotor_vx"), y = at("rotor_y", "rotor_vy");
  const std::vector<double> speed = linear(run.column("t"), run.column("spin_speed"), times);

  constexpr std::size_t kHop = kSteps / 4;
  const std::size_t stretches = (turns - OrderTrack::kTurns) * kSteps / kHop + 1;
  const std::size_t every = (stretches + most - 1) / most;
  const Eigen::ArrayXd window = hann_window(static_cast<Eigen::Index>(length));
  const double weight = window.sum();
  for (std::size_t first = 0; first < stretches; first += every) {
    std::array<Complex, OrderTrack::kOrders> forward{}, backward{};
    for (std::size_t n = 0; n < length; ++n) {
      const std::size_t i = first * kHop + n;
      const Complex z = window[static_cast<Eigen::Index>(n)] * Complex(x[i], y[i]);
      for (std::size_t k = 0; k < forward.size(); ++k) {
        const double phi = turn.sense * angles[i] * static_cast<double>(k + 1);
        forward[k] += z * std::polar(1.0, -phi);
        backward[k] += z * std::polar(1.0, phi);
      }
    }
    const std::size_t middle = first * kHop + length / 2;
    track.t.push_back(times[middle]);
    track.speed.push_back(speed[middle]);
    auto& vectors = track.probe.emplace_back();
    for (std::size_t k = 0; k < vectors.size(); ++k) {
      vectors[k] = (forward[k] + std::conj(backward[k])) / weight;
      // In the direction of time, whichever way the rotor turns.
      if (turn.sense < 0.0) vectors[k] = std::conj(vectors[k]);
    }
  }
  return track;
}

}  // namespace rotorub
