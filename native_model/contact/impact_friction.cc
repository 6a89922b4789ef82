#include "native_model/contact/impact_friction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "native_model/numerics/dop853.h"
#include "native_model/numerics/root.h"

namespace rotorub {
namespace {

// The mean of mu over a normal impulse L (N s, > 0). before: m/s, slip v at its start; drift: c,
// 1/kg; mobility: g_TT, 1/kg, > 0. Integrates u = |v| over the share x of the impulse, u' = L (s c
// - g_TT mu(u)) with s = sign(v); the mean of mu follows from the result.
double mean_friction(const FrictionLaw& law, double before, double drift, double mobility,
                     double normal) {
  const double sticking = law.sticking();
  double sign = before > 0.0 ? 1.0 : before < 0.0 ? -1.0 : 0.0;
  if (sign == 0.0) {
    if (std::abs(drift) <= sticking * mobility) return sticking;
    sign = drift > 0.0 ? 1.0 : -1.0;
  }
  const double along = sign * drift * normal, braked = mobility * normal;
  const auto slope = [&](double, const double* u, double* du) {
    *du = along - braked * law.along(*u);
  };
  double u = std::abs(before), x = 0.0, h = 1.0;
  const double start = u, tolerance = 1e-15 * (u + std::abs(along) + braked * sticking);
  const auto mean_until = [&](double share, double end) {
    return (along * share - (end - start)) / braked;
  };
  Dop853 step(1);
  slope(x, &u, step.first_slope());
  while (x < 1.0) {
    h = std::min(h, 1.0 - x);
    const double error = step.trial(slope, x, &u, h, &tolerance);
    if (error > 1.0) {
      h *= std::min(Dop853::step_factor(error), 0.9);
      continue;
    }
    if (*step.end() <= 0.0) {  // the slip stops
      step.prepare_dense(slope, x);
      const auto left = [&](double theta) { return u + step.increment(0, theta); };
      const double share = x + h * root(left, 0.0, 1.0, u, *step.end()).first;
      return mean_until(share, 0.0) + sticking * (1.0 - share);
    }
    u = *step.end();
    x += h;
    step.advance();
    h *= Dop853::step_factor(error);
    // Where friction and drift balance, nothing changes any more, even if the equation is stiff.
    if (std::abs(*step.first_slope()) * (1.0 - x) <= tolerance) break;
  }
  return mean_until(1.0, u);
}

}  // namespace

bool ImpactFriction::improve(double normal, double friction, double after, double mobility) {
  constexpr int kMostRounds = 100;
  constexpr double kSettled = 16.0 * std::numeric_limits<double>::epsilon();
  if (law_.is_constant() || !(normal > 0.0) || ++rounds_ > kMostRounds) return false;
  const double drift = (after - before_ - mobility * friction) / normal;
  const double next = mean_friction(law_, before_, drift, mobility, normal);
  const bool moves = std::abs(next - mu_) > kSettled * next;
  mu_ = next;
  return moves;
}

}  // namespace rotorub
