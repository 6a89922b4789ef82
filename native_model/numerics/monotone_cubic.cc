#include "native_model/numerics/monotone_cubic.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

namespace rotorub {
namespace {

std::vector<double> monotone_tangents(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = x.size();
  std::vector<double> secant(n - 1), tangent(n);
  for (std::size_t i = 0; i + 1 < n; ++i) secant[i] = (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
  tangent.front() = secant.front();
  tangent.back() = secant.back();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    tangent[i] = secant[i - 1] * secant[i] > 0.0 ? 0.5 * (secant[i - 1] + secant[i]) : 0.0;
  }
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (secant[i] == 0.0) {
      tangent[i] = tangent[i + 1] = 0.0;
      continue;
    }
    const double a = tangent[i] / secant[i], b = tangent[i + 1] / secant[i];
    const double radius = std::hypot(a, b);
    if (radius > 3.0) {
      tangent[i] = 3.0 / radius * a * secant[i];
      tangent[i + 1] = 3.0 / radius * b * secant[i];
    }
  }
  return tangent;
}

std::size_t interval(const std::vector<double>& x, double at) {
  return static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), at) - x.begin() - 1);
}

}  // namespace

MonotoneCubic::MonotoneCubic(std::vector<double> x, std::vector<double> y)
    : x_(std::move(x)), y_(std::move(y)) {
  assert(x_.size() >= 2 && x_.size() == y_.size());
  tangent_ = monotone_tangents(x_, y_);
}

double MonotoneCubic::value(double x) const {
  if (x <= x_.front()) return y_.front();
  if (x >= x_.back()) return y_.back();
  const std::size_t i = interval(x_, x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h;
  const double s2 = s * s, s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * y_[i] + (s3 - 2 * s2 + s) * h * tangent_[i] +
         (3 * s2 - 2 * s3) * y_[i + 1] + (s3 - s2) * h * tangent_[i + 1];
}

double MonotoneCubic::slope(double x) const {
  if (x <= x_.front() || x >= x_.back()) return 0.0;
  const std::size_t i = interval(x_, x);
  const double h = x_[i + 1] - x_[i], s = (x - x_[i]) / h;
  const double s2 = s * s;
  return (6 * s2 - 6 * s) * (y_[i] - y_[i + 1]) / h + (3 * s2 - 4 * s + 1) * tangent_[i] +
         (3 * s2 - 2 * s) * tangent_[i + 1];
}

}  // namespace rotorub
