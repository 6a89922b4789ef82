#include "plugin/contact/constrained_law.h"

#include <algorithm>
#include <cmath>

namespace rotorub::plugin {
namespace {

constexpr int kIterations = 40;
constexpr int kUndamped = 8;        // of them; then a circle between two pieces is cut by halving
constexpr double kLocal = 1e-4;     // share of the impulse that a later trial is off by
constexpr double kRelative = 1e-9;  // of the rates that are to be changed
constexpr double kFarOff = 1e-2;    // above this error, relative, new slopes are tried

// The laws' answer to a line y = a p + b.
struct Answer {
  ContactVector p;
  bool solved = true;
  std::array<bool, kMaxPairs> sticks{};
};

using Frictions = std::array<double, kMaxPairs>;

class Slopes {
 public:
  Slopes(const ContactMatrix& without, const Frictions& frictions)
      : expected(without), frictions_(frictions) {}

  // dy/dp at p by trials. Of a passive system they are symmetric and positive but for round-off; what
  // a constraint holds still moves by a little.
  void find(ContactResponse& response, const ContactVector& p, const ContactVector& y, double size) {
    const Eigen::Index n = p.size();
    a = expected;
    std::array<bool, 2 * kMaxPairs> tried{};
    for (Eigen::Index k = 0; k < n; ++k) {
      const bool friction = k % 2 == 1;
      if (friction && frictions_[static_cast<std::size_t>(k / 2)] == 0.0) continue;
      tried[static_cast<std::size_t>(k)] = true;
      ContactVector moved = p;
      moved[k] += size;
      a.col(k) = (response.at(moved) - y) / size;
    }
    const auto known = [&](Eigen::Index k) { return tried[static_cast<std::size_t>(k)]; };
    for (Eigen::Index j = 0; j < n; ++j) {
      for (Eigen::Index i = 0; i < j; ++i) {
        double& one = a(i, j);
        double& other = a(j, i);
        if (known(i) && known(j)) one = 0.5 * (one + other);
        if (known(i) && !known(j)) one = other;
        other = one;
      }
      a(j, j) = std::max(a(j, j), 1e-9 * expected(j, j));
    }
    known_ = true;
  }
  bool known() const { return known_; }

  const ContactMatrix& expected;
  ContactMatrix a;

 private:
  const Frictions& frictions_;
  bool known_ = false;
};

// The largest normal impulse of `a` beyond that of `b`.
double normal_beyond(const ContactVector& a, const ContactVector& b) {
  double most = 0.0;
  for (Eigen::Index k = 0; k < a.size(); k += 2) most = std::max(most, std::abs(a[k] - b[k]));
  return most;
}

// From p, y(p) on.
template <typename Law>
ConstrainedContact iterate(ContactResponse& response, ContactVector p, ContactVector y,
                           Slopes& line, Law law) {
  ConstrainedContact best;
  best.converged = false;
  best.p = ContactVector::Zero(p.size());
  best.y = best.error = best.p;
  double least = 1e300;
  Answer guess = law(line.expected, y - line.expected * p);
  if (!guess.solved) guess.p = p;
  const ContactVector none = ContactVector::Zero(p.size());
  double size = std::max(normal_beyond(guess.p, p), kLocal * normal_beyond(guess.p, none));
  if (!(size > 0.0)) {
    size = std::max(y.cwiseAbs().maxCoeff(), 1e-12) / line.expected.diagonal().maxCoeff();
  }
  const double scale = y.norm() + (line.expected * (guess.p - p)).norm();
  const double tolerance = kRelative * scale + response.accuracy();
  if (!line.known()) line.find(response, p, y, size);
  for (int k = 0; k < kIterations; ++k) {
    const Answer next = law(line.a, y - line.a * p);
    if (!next.solved) {
      best.solved = least < 1e300;
      return best;
    }
    const ContactVector found = response.at(next.p);
    const ContactVector error = found - y - line.a * (next.p - p);
    const double off = error.norm();
    if (off < least) {
      least = off;
      best.p = next.p;
      best.y = found;
      best.error = error;
      best.sticks = next.sticks;
    }
    if (off <= tolerance) {
      best.converged = true;
      return best;
    }
    if (k < kUndamped) {
      p = next.p;
      y = found;
    } else {
      p = 0.5 * (p + next.p);
      y = response.at(p);
    }
    if (off > kFarOff * (found - y).norm() + kFarOff * kFarOff * scale || k >= kUndamped) {
      line.find(response, p, y, kLocal * std::max(normal_beyond(p, none), size));
    }
  }
  return best;
}

ConstrainedContact closed(ContactResponse& response, const ContactVector& free,
                          const Frictions& frictions, Slopes& line) {
  std::array<ContactSet, kMaxPairs> sets{};
  const auto count = static_cast<std::size_t>(free.size() / 2);
  for (std::size_t i = 0; i < count; ++i) sets[i].friction = frictions[i];
  const std::span<const ContactSet> used(sets.data(), count);
  return iterate(response, ContactVector::Zero(free.size()), free, line,
                 [&](const ContactMatrix& a, const ContactVector& b) {
                   const CoupledSolution s = solve_coupled(a, b, used);
                   return Answer{s.p, s.solutions == 1, s.sticks};
                 });
}

}  // namespace

ConstrainedContact solve_constrained(ContactResponse& response, const ContactVector& free,
                                     const ContactMatrix& expected,
                                     std::span<const double> frictions) {
  Frictions all{};
  std::copy(frictions.begin(), frictions.end(), all.begin());
  Slopes line(expected, all);
  return closed(response, free, all, line);
}

ConstrainedContact solve_constrained_impact(ContactResponse& response, const ContactVector& free,
                                            const ContactMatrix& expected,
                                            std::span<const ImpactLaw> laws) {
  Frictions frictions{};
  for (std::size_t i = 0; i < laws.size(); ++i) frictions[i] = laws[i].friction;
  Slopes line(expected, frictions);
  const ConstrainedContact c = closed(response, free, frictions, line);
  if (!c.solved) return c;
  std::array<ContactSet, kMaxPairs> sets{};
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(2 * i);
    sets[i] = expansion_set(laws[i], c.p[at], c.p[at + 1]);
  }
  const std::span<const ContactSet> used(sets.data(), laws.size());
  const auto expansion = [&](const ContactMatrix& a, const ContactVector& b) {
    const CoupledSolution s = solve_coupled(a, b + a * c.p, used);
    return Answer{s.solutions > 0 ? ContactVector(c.p + s.p) : c.p, s.solutions == 1, {}};
  };
  ConstrainedContact e = iterate(response, c.p, c.y, line, expansion);
  e.converged = e.converged && c.converged;
  return e;
}

}  // namespace rotorub::plugin
