#include "native_model/numerics/root.h"

#include <algorithm>

namespace rotorub {
namespace {

// A polynomial in Bernstein form on an interval, with degree + 1 coefficients.
struct Bernstein {
  int degree;
  std::array<double, Polynomial::kMaxDegree + 1> b;
  const double* end() const { return b.data() + degree + 1; }
  const double* begin() const { return b.data(); }
  double last() const { return *(end() - 1); }
};

// b_k = sum_i C(k, i) / C(n, i) a_i.
Bernstein bernstein(const Polynomial& p) {
  Bernstein form{p.degree, {}};
  for (int k = 0; k <= p.degree; ++k) {
    double sum = 0.0, ratio = 1.0;
    for (int i = 0; i <= k; ++i) {
      sum += ratio * p.a[static_cast<std::size_t>(i)];
      ratio *= static_cast<double>(k - i) / static_cast<double>(std::max(p.degree - i, 1));
    }
    form.b[static_cast<std::size_t>(k)] = sum;
  }
  return form;
}

// De Casteljau's algorithm at 1/2: `right` becomes the right half, and the left half is returned.
Bernstein split(Bernstein& right) {
  Bernstein left = right;
  auto& w = right.b;
  for (std::size_t n = static_cast<std::size_t>(right.degree), k = 0; k <= n; ++k) {
    left.b[k] = w[0];
    for (std::size_t i = 0; i + k < n; ++i) w[i] = 0.5 * (w[i] + w[i + 1]);
    // w[n - k] is now a coefficient of the right half.
  }
  return left;
}

std::optional<double> first_crossing(const Polynomial& p, Bernstein form, double lo, double hi,
                                     int depth) {
  const double* positive = std::find_if(form.begin(), form.end(), [](double x) { return x > 0.0; });
  if (positive == form.end()) return {};
  if (positive == form.begin()) return lo;
  // A single sign change, from negative to positive, means a single root.
  const double* negative = std::find_if(form.begin(), form.end(), [](double x) { return x < 0.0; });
  if (negative < positive && form.last() > 0.0 &&
      std::all_of(positive, form.end(), [](double x) { return x >= 0.0; })) {
    return root([&p](double x) { return p(x); }, lo, hi, *negative, form.last()).second;
  }
  if (depth == 0) return lo;  // a double root within round-off
  const Bernstein left = split(form);
  const double middle = 0.5 * (lo + hi);
  if (auto found = first_crossing(p, left, lo, middle, depth - 1)) return found;
  return first_crossing(p, form, middle, hi, depth - 1);
}

}  // namespace

double Polynomial::operator()(double x) const {
  double sum = 0.0;
  for (int i = degree; i >= 0; --i) sum = sum * x + a[static_cast<std::size_t>(i)];
  return sum;
}

std::optional<double> first_crossing(const Polynomial& p, RootStart start) {
  constexpr int kHalvings = 60;  // down to the round-off of 1
  Bernstein form = bernstein(p);
  if (start == RootStart::kBelowZero) form.b[0] = std::min(form.b[0], 0.0);
  return first_crossing(p, form, 0.0, 1.0, kHalvings);
}

}  // namespace rotorub
