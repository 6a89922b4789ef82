// Statistics of a sample of independent values, with intervals that hold them with a confidence.
#pragma once

#include <optional>
#include <span>

namespace rotorub::sweep {

// A value, and the bounds between which what it estimates lies with the confidence asked for;
// nothing: the sample is too small for a bound.
struct Estimate {
  double value = 0.0;
  std::optional<double> low, high;
};

// Each: `confidence` in (0, 1), two-sided.

// The p-quantile, p in (0, 1): between the order statistics x_(h), h = (n - 1) p + 1, linearly
// (type 7 of Hyndman and Fan 1996, that of numpy). Its bounds are order statistics, whatever the
// distribution (Conover, Practical Nonparametric Statistics, 3.2): of B binomial(n, p),
//   low x_(l), l the largest with P(B <= l - 1) <= (1 - confidence)/2,
//   high x_(u), u the smallest with P(B <= u - 1) >= 1 - (1 - confidence)/2.
// sorted: ascending, one value or more.
Estimate quantile_of(std::span<const double> sorted, double p, double confidence);

// The mean, with the bounds of Student's t: exact of normal values, else of many. One value or
// more; of one it has no bounds.
Estimate mean_of(std::span<const double> values, double confidence);

// The standard deviation, divisor n - 1; 0 of one value. No bounds.
double deviation_of(std::span<const double> values);

// A share of `count` trials that came out `hits` times, with the bounds of Clopper and Pearson
// (1934), which hold at least with the confidence. count: 1 or more, hits in [0, count].
Estimate share_of(std::size_t hits, std::size_t count, double confidence);

}  // namespace rotorub::sweep
