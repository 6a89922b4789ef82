// Ranges of spin speed in which a whirl grows.

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "native_model/linear/campbell.h"
#include "native_model/numerics/eigenvalues.h"
#include "native_model/numerics/root.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// Modes with |s| below this share of the largest are rigid: their real part is round-off.
constexpr double kRigid = 1e-7;
constexpr double kGrows = 1e-9;  // of |s|: beyond the round-off of an undamped mode

double growth_of(const Complex& s) { return s.real() / std::abs(s); }

// Whether nothing can grow: no rotating damping, no oil film, and no negative net stiffness in
// either plane.
bool passive(const WhirlSystem& system) {
  const auto holds = [](const Eigen::MatrixXd& K) {
    constexpr double kRoundOff = 1e-14;
    if (K != K.transpose()) return false;  // magnets that sense elsewhere
    const Eigen::VectorXd values = found_by(symmetric_eigenvalues(K));
    return values.minCoeff() >= -kRoundOff * values.maxCoeff();
  };
  return system.films.empty() && system.internal_xy.isZero(0.0) && holds(system.stiffness_x) &&
         holds(system.stiffness_y);
}

// The kept modes at one speed, without the rigid ones.
struct Sample {
  double speed = 0.0;      // rad/s, absolute value
  std::vector<Complex> s;  // anisotropic planes: Im s >= 0, since a mode may change its sense
  double growth = -1.0;    // largest Re s / |s|, > 0 if a mode grows
  bool grows() const { return growth > kGrows; }
};

class StabilitySearch {
 public:
  StabilitySearch(const WhirlSystem& system, double sense) : system_(system), sense_(sense) {}

  Sample at(double speed) const {
    const std::vector<Complex> values = whirl_eigenvalues(system_, sense_ * speed);
    const double size = largest_size(values);
    Sample sample{speed, {}};
    for (const Complex& s : values) {
      if (std::abs(s) <= kRigid * size) continue;
      sample.s.emplace_back(s.real(), system_.isotropic ? s.imag() : std::abs(s.imag()));
      sample.growth = std::max(sample.growth, growth_of(s));
    }
    return sample;
  }

  // The first speed in (a, b] at which a mode grows; none grows at a.
  std::optional<double> first_growth(const Sample& a, const Sample& b, int depth = 0) const {
    constexpr int kDeepest = 20;  // a window of 1e-6 of the interval
    const std::vector<Pair> pairs = matched(a, b);
    const Sample m = at(a.speed + dividing(pairs) * (b.speed - a.speed));
    if (m.grows()) return depth < kDeepest ? first_growth(a, m, depth + 1) : crossing(a, m);
    const bool deeper = depth < kDeepest;
    if (deeper && may_grow(pairs, a, m, b, true)) {
      if (const auto found = first_growth(a, m, depth + 1)) return found;
    }
    if (deeper && may_grow(pairs, a, m, b, false)) return first_growth(m, b, depth + 1);
    return b.grows() ? std::optional(crossing(m, b)) : std::nullopt;
  }

 private:
  using Pair = std::pair<Complex, Complex>;  // a mode at both ends of an interval

  // Pairs of modes of a and b, nearest first; each mode is used once.
  static std::vector<Pair> matched(const Sample& a, const Sample& b) {
    struct Candidate {
      double distance;
      std::size_t i, j;
    };
    std::vector<Candidate> all;
    for (std::size_t i = 0; i < a.s.size(); ++i) {
      for (std::size_t j = 0; j < b.s.size(); ++j) all.push_back({std::abs(a.s[i] - b.s[j]), i, j});
    }
    std::stable_sort(all.begin(), all.end(), [](const Candidate& x, const Candidate& y) {
      return x.distance < y.distance;
    });
    std::vector<bool> left(a.s.size()), right(b.s.size());
    std::vector<Pair> pairs;
    for (const Candidate& c : all) {
      if (left[c.i] || right[c.j]) continue;
      left[c.i] = right[c.j] = true;
      pairs.emplace_back(a.s[c.i], b.s[c.j]);
    }
    return pairs;
  }

  // Fraction of the interval at which to divide it: the first speed where two whirls have the same
  // frequency, since they may drive each other there, but not close to the ends, which are known;
  // otherwise the middle.
  static double dividing(const std::vector<Pair>& pairs) {
    constexpr double kEnd = 0.02;
    double share = 1.0;
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const double before = pairs[i].first.imag() - pairs[j].first.imag();
        const double after = pairs[i].second.imag() - pairs[j].second.imag();
        if (!(before * after < 0.0)) continue;
        const double at = before / (before - after);
        if (at > kEnd && at < 1.0 - kEnd) share = std::min(share, at);
      }
    }
    return share < 1.0 ? share : 0.5;
  }

  // Whether a mode's damping may reach 0 in the left or right part of the interval a, m, b. The
  // mode's growth at m deviates by e from the straight line from a to b; their parabola rises at
  // most e above the higher end. If a mode grows at b, the right part is searched only for earlier
  // growth.
  static bool may_grow(const std::vector<Pair>& pairs, const Sample& a, const Sample& m,
                       const Sample& b, bool left) {
    const double share = (m.speed - a.speed) / (b.speed - a.speed);
    return std::any_of(pairs.begin(), pairs.end(), [&](const Pair& pair) {
      const Complex guess = (1.0 - share) * pair.first + share * pair.second;
      const auto middle =
          std::min_element(m.s.begin(), m.s.end(), [&](const Complex& x, const Complex& y) {
            return std::abs(x - guess) < std::abs(y - guess);
          });
      if (middle == m.s.end()) return false;
      const double from = growth_of(pair.first), at_m = growth_of(*middle),
                   to = growth_of(pair.second);
      const double off = std::abs(at_m - ((1.0 - share) * from + share * to));
      const double higher = left ? std::max(from, at_m) : b.grows() ? at_m : std::max(at_m, to);
      return higher + off > kGrows;
    });
  }

 public:
  // The first speed in (a, b] at which no mode grows; one grows at a. Samples the thirds of the
  // interval.
  std::optional<std::pair<double, Sample>> first_recovery(const Sample& a, const Sample& b) const {
    constexpr int kParts = 3;
    Sample grows = a;
    for (int part = 1; part <= kParts; ++part) {
      Sample next = part < kParts ? at(a.speed + part * (b.speed - a.speed) / kParts) : b;
      if (!next.grows()) {
        const bool clear = grows.growth > std::max(kGrows, next.growth);
        return std::pair(clear ? crossing(next, grows) : grows.speed, std::move(next));
      }
      grows = std::move(next);
    }
    return std::nullopt;
  }

 private:
  // Zero of growth between a stable and an unstable speed, returned from the unstable side.
  double crossing(const Sample& before, const Sample& after) const {
    constexpr double kAccuracy = 1e-10;
    // Next to an undamped mode the threshold is the round-off level.
    const double none = before.growth > -kGrows ? kGrows : 0.0;
    const auto excess = [&](double speed) { return at(speed).growth - none; };
    const bool rising = before.speed < after.speed;
    const Sample &low = rising ? before : after, &high = rising ? after : before;
    const auto [below, above] = root(excess, low.speed, high.speed, low.growth - none,
                                     high.growth - none, kAccuracy * high.speed);
    return rising ? above : below;
  }

  const WhirlSystem& system_;
  double sense_;
};

}  // namespace

double stability_bound(const WhirlSystem& system) {
  if (passive(system)) return std::numeric_limits<double>::infinity();
  constexpr double kBound = 20.0;
  double bound = kBound * largest_size(whirl_eigenvalues(system, 0.0));
  for (const double sense : {1.0, -1.0})
    bound = std::max(bound, table_speeds(system, sense).back());
  return bound;
}

namespace {

// first_alone: stop at the start of the first range, for the threshold.
std::vector<UnstableRange> ranges_of(const WhirlSystem& system, double sense, bool first_alone) {
  const double bound = stability_bound(system);
  if (std::isinf(bound)) return {};
  constexpr double kStep = 1.5;
  constexpr double kFirst = 0.1;  // of the lowest frequency
  const StabilitySearch search(system, sense);
  // A growing whirl whose frequency rises with the speed may leave the modes kept while it still
  // grows. The growth of the modes kept then jumps.
  constexpr double kJump = 1e-6;  // of |s|; a growth that passes 0 is at most its round-off there
  WhirlSystem more = system;
  more.kept = std::min(2 * system.kept, static_cast<int>(system.size()));
  const StabilitySearch wide(more, sense);
  constexpr double kEver = std::numeric_limits<double>::infinity();
  std::vector<UnstableRange> ranges;
  Sample before = search.at(0.0);
  if (before.grows()) ranges.push_back({0.0, kEver});
  if (first_alone && !ranges.empty()) return ranges;

  double lowest = bound;
  for (const Complex& s : before.s) lowest = std::min(lowest, std::abs(s));
  std::vector<double> speeds = table_speeds(system, sense);
  for (double speed = kFirst * lowest; speed < bound; speed *= kStep) speeds.push_back(speed);
  speeds.push_back(bound);
  std::sort(speeds.begin(), speeds.end());
  for (const double speed : speeds) {
    if (speed <= before.speed) continue;
    const Sample next = search.at(speed);
    while (before.speed < speed) {
      if (!ranges.empty() && std::isinf(ranges.back().to)) {
        auto found = search.first_recovery(before, next);
        if (found && (!before.grows() || search.at(found->first).growth > kJump)) {
          found = wide.first_recovery(wide.at(before.speed), wide.at(speed));
        }
        if (!found) break;
        ranges.back().to = found->first;
        before = search.at(found->second.speed);
      } else {
        const std::optional<double> found = search.first_growth(before, next);
        if (!found) break;
        ranges.push_back({*found, kEver});
        if (first_alone) return ranges;
        before = search.at(*found);
      }
    }
    before = next;
  }
  return ranges;
}

}  // namespace

std::vector<UnstableRange> unstable_ranges(const WhirlSystem& system, double sense) {
  return ranges_of(system, sense, false);
}

std::optional<double> stability_threshold(const WhirlSystem& system, double sense) {
  const std::vector<UnstableRange> ranges = ranges_of(system, sense, true);
  return ranges.empty() ? std::nullopt : std::optional(ranges.front().from);
}

}  // namespace rotorub
