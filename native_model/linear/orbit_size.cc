#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <vector>

#include "native_model/linear/free_motion.h"

namespace rotorub {
namespace {

// Maximum of f over a period, from `looks` samples and a closer search around the highest.
template <class F>
double largest_of(const F& f, double period, int looks) {
  const double spacing = period / looks;
  double best = 0.0, most = f(0.0);
  for (int k = 1; k < looks; ++k) {
    const double value = f(k * spacing);
    if (value > most) {
      most = value;
      best = k * spacing;
    }
  }
  double low = best - spacing, high = best + spacing;
  for (int round = 0; round < 60; ++round) {
    const double a = low + (high - low) / 3.0, b = high - (high - low) / 3.0;
    (f(a) < f(b) ? low : high) = f(a) < f(b) ? a : b;
  }
  return std::max(most, f(0.5 * (low + high)));
}

// Frequency in rad/s of which all parts are whole multiples; empty if there is none or fewer than
// two parts.
std::optional<double> base(const std::vector<OrbitPart>& turning) {
  if (turning.size() < 2) return {};
  for (int divisor = 1; divisor <= OrbitSize::kHighest; ++divisor) {
    const double frequency = turning.front().frequency / divisor;
    const auto whole = [&](const OrbitPart& part) {
      const double ratio = part.frequency / frequency;
      return ratio < OrbitSize::kHighest + 0.5 && std::abs(ratio - std::round(ratio)) < 1e-9;
    };
    if (std::all_of(turning.begin(), turning.end(), whole)) return frequency;
  }
  return {};
}

}  // namespace

double OrbitSize::largest() const {
  Eigen::Vector2d middle = centre;
  std::vector<OrbitPart> turning;
  for (const OrbitPart& part : parts) {
    if (part.frequency > 0.0) {
      turning.push_back(part);
    } else {
      middle += part.amplitude.real();
    }
  }
  if (turning.empty()) return middle.norm();
  constexpr double kTurn = 2.0 * std::numbers::pi;
  if (const auto frequency = base(turning)) {
    const auto distance = [&](double t) {
      Eigen::Vector2d d = middle;
      for (const OrbitPart& part : turning) {
        d += (part.amplitude * std::polar(1.0, part.frequency * t)).real();
      }
      return d.norm();
    };
    return largest_of(distance, kTurn / *frequency, 64 * kHighest);
  }
  const auto along = [&](double angle) {
    const Eigen::Vector2d u{std::cos(angle), std::sin(angle)};
    double sum = middle.dot(u);
    for (const OrbitPart& part : turning) {
      sum += std::abs(part.amplitude.x() * u.x() + part.amplitude.y() * u.y());
    }
    return sum;
  };
  return largest_of(along, kTurn, 720);
}

}  // namespace rotorub
