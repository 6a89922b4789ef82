#include "compare/figures/figure_sample.h"

#include <algorithm>
#include <cmath>

namespace rotorub {
namespace {

// Quantile of Student's t for the quantile z of the normal distribution (Cornish and Fisher;
// accurate to 1 % for 3 or more degrees of freedom).
double student(double z, double freedom) {
  const double z2 = z * z, n = freedom;
  return z * (1.0 + (z2 + 1.0) / (4.0 * n) + ((5.0 * z2 + 16.0) * z2 + 3.0) / (96.0 * n * n) +
              (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / (384.0 * n * n * n));
}

constexpr double kTwoSided = 1.959964, kPower = 0.841621;  // for 95 % and for 80 %

}  // namespace

FigureSample figure_sample(const Figure& figure, const Metrics& run,
                           std::span<const Metrics> twins) {
  FigureSample s;
  s.value = s.mean = figure.value(run);
  s.count = 1 + static_cast<int>(twins.size());
  const double n = s.count;
  // Differences from the run itself make the mean of equal values exact.
  double sum = 0.0, square = 0.0;
  for (const Metrics& m : twins) {
    const double apart = figure.value(m) - s.value;
    sum += apart;
    square += apart * apart;
    const double share = std::abs(deviation(figure, s.value, figure.value(m)));
    if (std::isfinite(share)) s.floor = std::max(s.floor, share);
  }
  s.mean += sum / n;
  if (s.count > 1) s.deviation = std::sqrt(std::max(0.0, square - sum * sum / n) / (n - 1.0));
  return s;
}

std::vector<FigureSample> figure_samples(const Metrics& run, std::span<const Metrics> twins) {
  std::vector<FigureSample> all;
  for (const Figure& f : figures()) all.push_back(figure_sample(f, run, twins));
  return all;
}

Interval interval(const FigureSample& a, const FigureSample& b) {
  const auto variance = [](const FigureSample& s, const FigureSample& other) {
    const double deviation = s.count > 1 ? s.deviation : other.deviation;
    return deviation * deviation / s.count;
  };
  const double of_a = variance(a, b), of_b = variance(b, a), sum = of_a + of_b;
  if (!(sum > 0.0)) return {};
  const auto part = [](double of, int count) { return count > 1 ? of * of / (count - 1.0) : 0.0; };
  const double both = part(of_a, a.count) + part(of_b, b.count);
  const double freedom =
      b.count > 1 && a.count > 1 ? sum * sum / both : std::max(a.count, b.count) - 1.0;
  const double error = std::sqrt(sum), half = student(kTwoSided, freedom) * error;
  return {half, half + student(kPower, freedom) * error};
}

std::vector<double> single_run_intervals(const std::vector<FigureSample>& groups) {
  std::vector<double> all;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    const FigureSample& s = groups[k];
    all.push_back(share_of(figures()[k], s.mean, interval(s, FigureSample{s.value, s.mean}).half));
  }
  return all;
}

}  // namespace rotorub
