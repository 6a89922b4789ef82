#include "native_model/rotor/mode_scaling.h"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace rotorub {
namespace {

constexpr double kNode = 1e-6;  // of the largest value: a node at the contact
constexpr double kTie = 1e-6;   // relative: peaks that symmetry makes equal, round-off apart

// Peak of |value| in [left, right] by golden-section search.
double peak_between(const std::function<double(double)>& value, double left, double right) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSteps = 40;  // to 4e-9 of the interval: the value there is right to round-off
  for (int step = 0; step < kSteps; ++step) {
    const double a = right - kGolden * (right - left);
    const double b = left + kGolden * (right - left);
    if (std::abs(value(a)) < std::abs(value(b))) {
      left = a;
    } else {
      right = b;
    }
  }
  return 0.5 * (left + right);
}

// Value, with its sign, where it is largest; the first of equal ones.
double largest(const std::function<double(double)>& value, const std::vector<double>& stations) {
  std::vector<double> values;
  double bound = 0.0;
  for (double z : stations) {
    values.push_back(value(z));
    bound = std::max(bound, std::abs(values.back()));
  }
  // Stations lie close enough for a peak between two of them to be at most this much higher.
  constexpr double kNearPeak = 0.9;
  double best = 0.0;
  const std::size_t n = stations.size();
  for (std::size_t i = 0; i < n; ++i) {
    const bool local_peak = (i == 0 || std::abs(values[i]) >= std::abs(values[i - 1])) &&
                            (i + 1 == n || std::abs(values[i]) >= std::abs(values[i + 1]));
    if (!local_peak || std::abs(values[i]) < kNearPeak * bound) continue;
    double peak = values[i];
    if (i > 0 && i + 1 < n) {
      const double between = value(peak_between(value, stations[i - 1], stations[i + 1]));
      if (std::abs(between) > std::abs(peak)) peak = between;
    }
    if (std::abs(peak) > (1.0 + kTie) * std::abs(best)) best = peak;
  }
  return best;
}

}  // namespace

ModeScale mode_scale(const std::function<double(double)>& value,
                     const std::vector<double>& stations, std::optional<double> contact) {
  assert(stations.size() >= 2);
  const double peak = largest(value, stations);
  if (!contact) return {1.0 / peak, 1.0};
  const double at_contact = value(*contact);
  if (std::abs(at_contact) < kNode * std::abs(peak)) return {1.0 / peak, 0.0};
  return {1.0 / at_contact, 1.0};
}

}  // namespace rotorub
