#include "native_model/integrate/first_contact.h"

#include <algorithm>
#include <cmath>

namespace rotorub {
namespace {

constexpr int kDegree = 2 * kPathDegree;  // of F

// A polynomial in Bernstein form on [0, 1]; `degree` of its coefficients count.
struct Bernstein {
  int degree;
  std::array<double, kDegree + 1> b;

  bool below_zero() const {
    return std::all_of(b.begin(), b.begin() + degree + 1, [](double x) { return x <= 0.0; });
  }
  int sign_changes() const {
    int changes = 0;
    double last = b[0];
    for (int i = 1; i <= degree; ++i) {
      const double x = b[static_cast<std::size_t>(i)];
      if (x != 0.0 && last * x < 0.0) ++changes;
      if (x != 0.0) last = x;
    }
    return changes;
  }
};

// De Casteljau at 1/2.
void split(const Bernstein& p, Bernstein& left, Bernstein& right) {
  left.degree = right.degree = p.degree;
  std::array<double, kDegree + 1> w = p.b;
  const auto n = static_cast<std::size_t>(p.degree);
  for (std::size_t k = 0; k <= n; ++k) {
    left.b[k] = w[0];
    right.b[n - k] = w[n - k];
    for (std::size_t i = 0; i + 1 + k <= n; ++i) w[i] = 0.5 * (w[i] + w[i + 1]);
  }
}

double power_value(const std::array<double, kDegree + 1>& a, int degree, double x) {
  double sum = 0.0;
  for (int i = degree; i >= 0; --i) sum = sum * x + a[static_cast<std::size_t>(i)];
  return sum;
}

double power_slope(const std::array<double, kDegree + 1>& a, int degree, double x) {
  double sum = 0.0;
  for (int i = degree; i >= 1; --i) sum = sum * x + i * a[static_cast<std::size_t>(i)];
  return sum;
}

// The one root in [lo, hi], from below zero to above: Newton kept in the bracket by bisection.
double root(const std::array<double, kDegree + 1>& a, int degree, double lo, double hi) {
  double x = 0.5 * (lo + hi);
  for (int k = 0; k < 100; ++k) {
    const double f = power_value(a, degree, x);
    if (f == 0.0) return x;
    (f > 0.0 ? hi : lo) = x;
    const double slope = power_slope(a, degree, x);
    double next = slope > 0.0 ? x - f / slope : 0.5 * (lo + hi);
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::abs(next - x) <= 1e-16 * std::abs(x)) return next;
    x = next;
  }
  return x;
}

std::optional<double> first_root(const std::array<double, kDegree + 1>& a, const Bernstein& p,
                                 double lo, double hi, int depth) {
  if (p.below_zero()) return {};
  if (p.b[0] > 0.0) return lo;
  if (p.sign_changes() == 1 && p.b[static_cast<std::size_t>(p.degree)] > 0.0) {
    return root(a, p.degree, lo, hi);
  }
  if (depth == 0) return lo;  // a touch within round-off
  Bernstein left, right;
  split(p, left, right);
  const double middle = 0.5 * (lo + hi);
  if (auto found = first_root(a, left, lo, middle, depth - 1)) return found;
  return first_root(a, right, middle, hi, depth - 1);
}

}  // namespace

Eigen::Vector2d Path::at(double x) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = kPathDegree; i >= 1; --i) sum = (sum + c[static_cast<std::size_t>(i)]) * x;
  return sum;
}

Eigen::Vector2d Path::slope(double x) const {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = kPathDegree; i >= 1; --i) sum = sum * x + i * c[static_cast<std::size_t>(i)];
  return sum;
}

Path path_from_nested(const std::array<Eigen::Vector2d, kPathDegree>& f) {
  // From the inside out: p <- (p + F_d) theta for even d, (p + F_d)(1 - theta) for odd.
  Path p;
  p.c.fill(Eigen::Vector2d::Zero());
  for (int d = kPathDegree - 1; d >= 0; --d) {
    p.c[0] += f[static_cast<std::size_t>(d)];
    for (std::size_t i = kPathDegree; i >= 1; --i) {
      p.c[i] = d % 2 == 0 ? p.c[i - 1] : Eigen::Vector2d(p.c[i] - p.c[i - 1]);
    }
    if (d % 2 == 0) p.c[0].setZero();
  }
  return p;
}

std::optional<double> first_contact(const Path& path, const Eigen::Vector2d& d, double clearance,
                                    Departure departure) {
  // F = |d + Delta d|^2 - delta_0^2, the part of the start without cancellation.
  std::array<double, kDegree + 1> a{};
  a[0] = (d.norm() - clearance) * (d.norm() + clearance);
  for (std::size_t i = 1; i <= kPathDegree; ++i) {
    a[i] += 2.0 * d.dot(path.c[i]);
    for (std::size_t j = 1; j <= kPathDegree; ++j) a[i + j] += path.c[i].dot(path.c[j]);
  }
  const int known = static_cast<int>(departure);
  std::copy(a.begin() + known, a.end(), a.begin());
  const int degree = kDegree - known;

  // Power to Bernstein: b_k = sum_i C(k, i) / C(n, i) a_i.
  Bernstein p{degree, {}};
  for (int k = 0; k <= degree; ++k) {
    double sum = 0.0, ratio = 1.0;
    for (int i = 0; i <= k; ++i) {
      sum += ratio * a[static_cast<std::size_t>(i)];
      ratio *= static_cast<double>(k - i) / static_cast<double>(degree - i == 0 ? 1 : degree - i);
    }
    p.b[static_cast<std::size_t>(k)] = sum;
  }
  if (departure == Departure::kInside && p.b[0] > 0.0) p.b[0] = 0.0;  // round-off of the start
  return first_root(a, p, 0.0, 1.0, 60);
}

}  // namespace rotorub
