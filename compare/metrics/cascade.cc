#include "compare/metrics/cascade.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

#include "compare/metrics/fourier.h"
#include "compare/metrics/orbit.h"
#include "compare/metrics/rows.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;
constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr std::size_t kSamples = 512;  // per stretch, 64 per turn

// s: the first time at which the absolute speed reaches `speed`.
std::optional<double> first_time(const std::vector<double>& t, const std::vector<double>& speeds,
                                 double speed) {
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double a = std::abs(speeds[i - 1]) - speed, b = std::abs(speeds[i]) - speed;
    if (a == 0.0) return t[i - 1];
    if ((a < 0.0) != (b < 0.0)) return t[i - 1] + (t[i] - t[i - 1]) * a / (a - b);
  }
  return std::nullopt;
}

void append_row(const std::vector<Complex>& z, double h, const std::vector<double>& frequencies,
                std::vector<double>& out) {
  const Eigen::Map<const Eigen::ArrayXcd> all(z.data(), static_cast<Eigen::Index>(z.size()));
  const Eigen::ArrayXd window = hann_window(all.size());
  const Eigen::ArrayXcd shown = windowed(all, window);
  const double weight = window.sum();
  for (const double f : frequencies) {
    const Complex step = std::polar(1.0, -kTurn * f * h);
    Complex turn = 1.0, sum = 0.0;
    for (const Complex& place : shown) {
      sum += place * turn;
      turn *= step;
    }
    out.push_back(std::abs(sum) / weight);
  }
}

}  // namespace

Cascade cascade(const Trajectory& run, std::size_t rows, std::size_t frequencies, double highest) {
  Cascade out;
  if (run.rows() < 2) return out;
  const auto &t = run.column("t"), &speeds = run.column("spin_speed");
  double slow = std::abs(speeds.front()), fast = slow;
  for (const double s : speeds)
    slow = std::min(slow, std::abs(s)), fast = std::max(fast, std::abs(s));
  for (std::size_t k = 0; k < frequencies; ++k) {
    out.frequency.push_back(
        highest * (2.0 * static_cast<double>(k) / static_cast<double>(frequencies - 1) - 1.0));
  }
  for (std::size_t k = 0; k < rows; ++k) {
    const double speed =
        slow + (fast - slow) * (static_cast<double>(k) + 0.5) / static_cast<double>(rows);
    const std::optional<double> at = first_time(t, speeds, speed);
    if (!at || speed == 0.0) continue;
    const double half = 0.5 * Cascade::kTurns * kTurn / speed;
    if (*at - half < t.front() || *at + half > t.back()) continue;
    const auto dense = std::upper_bound(t.begin(), t.end(), *at + half) -
                       std::lower_bound(t.begin(), t.end(), *at - half);
    if (static_cast<double>(dense) < kRowsOfATurn * Cascade::kTurns) continue;
    out.t.push_back(*at);
    out.speed.push_back(speed);
    const double h = 2.0 * half / static_cast<double>(kSamples);
    append_row(even_orbit(run, *at - half, *at + half - h, kSamples), h, out.frequency,
               out.amplitude);
  }
  return out;
}

}  // namespace rotorub
