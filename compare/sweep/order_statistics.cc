#include "compare/sweep/order_statistics.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/policies/policy.hpp>
#include <cassert>
#include <cmath>
#include <numeric>

namespace rotorub::sweep {
namespace {

// Computes in double, as in distribution.cc.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Binomial = boost::math::binomial_distribution<double, InDouble>;

// The smallest k in [0, n] with P(B <= k) >= share, for B binomial(n, p). Boost's quantile rounds
// by a policy, and round-off decides at the edge; here P itself decides.
std::size_t least_at_share(std::size_t n, double p, double share) {
  const Binomial law(static_cast<double>(n), p);
  std::size_t below = 0, at = n;
  while (below < at) {
    const std::size_t middle = below + (at - below) / 2;
    if (cdf(law, static_cast<double>(middle)) >= share) {
      at = middle;
    } else {
      below = middle + 1;
    }
  }
  return at;
}

}  // namespace

Estimate quantile_of(std::span<const double> sorted, double p, double confidence) {
  assert(!sorted.empty() && p > 0.0 && p < 1.0);
  const std::size_t n = sorted.size();
  const double tail = 0.5 * (1.0 - confidence);
  const double place = static_cast<double>(n - 1) * p;
  const auto below = static_cast<std::size_t>(std::floor(place));
  const double share = place - std::floor(place);
  Estimate out;
  out.value = sorted[below];
  if (share > 0.0) out.value += share * (sorted[below + 1] - sorted[below]);

  // Indices from 0: x_(l) is sorted[l - 1]. l is the number of k with P(B <= k) <= tail.
  const Binomial law(static_cast<double>(n), p);
  std::size_t l = least_at_share(n, p, tail);
  if (cdf(law, static_cast<double>(l)) <= tail) ++l;
  if (l >= 1) out.low = sorted[l - 1];
  const std::size_t u = least_at_share(n, p, 1.0 - tail);
  if (u < n) out.high = sorted[u];
  return out;
}

Estimate mean_of(std::span<const double> values, double confidence) {
  assert(!values.empty());
  const auto n = static_cast<double>(values.size());
  Estimate out;
  out.value = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < 2) return out;
  const boost::math::students_t_distribution<double, InDouble> law(n - 1.0);
  const double half = quantile(law, 0.5 * (1.0 + confidence)) * deviation_of(values) / std::sqrt(n);
  out.low = out.value - half;
  out.high = out.value + half;
  return out;
}

double deviation_of(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / (n - 1.0));
}

Estimate share_of(std::size_t hits, std::size_t count, double confidence) {
  assert(count >= 1 && hits <= count);
  const auto n = static_cast<double>(count), k = static_cast<double>(hits);
  const double tail = 0.5 * (1.0 - confidence);
  return {k / n, hits == 0 ? 0.0 : Binomial::find_lower_bound_on_p(n, k, tail),
          hits == count ? 1.0 : Binomial::find_upper_bound_on_p(n, k, tail)};
}

}  // namespace rotorub::sweep
