#include "native_model/contact/coupled_law.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "native_model/contact/disc_law.h"
#include "native_model/contact/impact_friction.h"

namespace rotorub {
namespace {

// Up to so many contacts all cases are tried, which counts the motions.
constexpr int kMostTried = 3;
// Up to so many contacts all cases are tried if nothing else leads to a solution.
constexpr int kMostTriedBlind = 5;
constexpr int kSweeps = 2000;
constexpr double kCaseRoundOff = 1e-11;  // relative to the rates and impulses of the problem
constexpr double kSingular = 1e-12;      // pivots below this share of the largest count as 0
// Motions count as the same if their rates differ by less than this share of the rates. It is
// coarse because symmetric contacts, which can share their forces in several ways, are equal only
// to the accuracy of the shaft's modes.
constexpr double kSameMotion = 1e-6;
// Small compliance of each contact, as a share of the largest element of a, for contacts that can
// share their impulses in several ways. It must be larger than the round-off of the rates divided
// by kSameMotion. by_rounds() tries all values in turn.
constexpr double kGive = 1e-4;
constexpr std::array kGives{kGive, 1e-8, 1e-2, 1e-6};
constexpr int kMostRounds = 50;  // rounds of cases that follow from each other

enum class Bound { kLow, kHigh, kStick };
struct Case {
  bool at_least = true;  // L_N = n, otherwise y_N = 0
  Bound friction = Bound::kLow;
  bool operator==(const Case&) const = default;
};
using Cases = std::array<Case, kMaxContacts>;

// False if the case is excluded or duplicates another one: a pressed contact has no other normal
// case, there is no sticking without friction, and an open contact has no friction.
bool distinct(const Case& c, const ContactSet& set) {
  if (set.pressed && !c.at_least) return false;
  if (c.friction == Bound::kLow) return true;
  const bool one_bound = set.slides != 0.0 || (set.friction == 0.0 && set.floor == 0.0);
  return !one_bound && !(c.at_least && set.least_normal == 0.0);
}

class CoupledProblem {
 public:
  CoupledProblem(const ContactMatrix& a, const ContactVector& b, std::span<const ContactSet> sets)
      : a_(a), b_(b), sets_(sets), n_(static_cast<int>(sets.size())) {
    rate_ = b.cwiseAbs().maxCoeff();
    for (int i = 0; i < n_; ++i) impulse_ = std::max(impulse_, set(i).least_normal);
    rate_ = std::max(rate_, impulse_ * a.cwiseAbs().maxCoeff());
  }

  const ContactSet& set(int i) const { return sets_[static_cast<std::size_t>(i)]; }
  int size() const { return n_; }
  double rate() const { return rate_; }  // m/s, size of the rates that the impulses change

  // The same cases, but with every contact closed that the solution leaves on its circle. If the
  // contacts can share their forces in several ways, the solution of these cases is the smallest
  // one, for any order of the contacts.
  Cases all_closed(const Cases& cases, const CoupledSolution& s) const {
    const double rates =
        kCaseRoundOff * (rate_ + s.p.cwiseAbs().maxCoeff() * a_.cwiseAbs().maxCoeff());
    Cases closed = cases;
    for (int i = 0; i < n_; ++i) {
      Case& c = closed[static_cast<std::size_t>(i)];
      if (set(i).pressed || !c.at_least || s.y[2 * i] > rates) continue;
      const double slip = s.y[2 * i + 1];
      c = {false, slip > rates ? Bound::kLow : slip < -rates ? Bound::kHigh : Bound::kStick};
      if (!distinct(c, set(i))) c.friction = Bound::kLow;
    }
    return closed;
  }

  // The cases that follow from p: those of the projections of p - y / (mobility of the contact
  // itself) onto the sets.
  Cases cases_of(const ContactVector& p) const {
    const ContactVector y = a_ * p + b_;
    const auto next = [&](Eigen::Index row) {
      return a_(row, row) > 0.0 ? p[row] - y[row] / a_(row, row) : p[row];
    };
    Cases cases{};
    for (int i = 0; i < n_; ++i) {
      const double friction = next(2 * i + 1);
      Case& c = cases[static_cast<std::size_t>(i)];
      c.at_least = set(i).pressed || next(2 * i) <= set(i).least_normal;
      c.friction = friction < set(i).low(p[2 * i])    ? Bound::kLow
                   : friction > set(i).high(p[2 * i]) ? Bound::kHigh
                                                      : Bound::kStick;
      if (!distinct(c, set(i))) c.friction = Bound::kLow;
    }
    return cases;
  }

  // Finds the impulses of these cases; false if they are not in the sets.
  bool meets(const Cases& cases, CoupledSolution& out) const {
    out.p = impulses(cases);
    if (!out.p.allFinite()) return false;
    out.y = a_ * out.p + b_;
    const double largest = std::max(out.p.cwiseAbs().maxCoeff(), impulse_);
    const double rates = kCaseRoundOff * (rate_ + largest * a_.cwiseAbs().maxCoeff());
    const double impulses = kCaseRoundOff * largest;
    for (int i = 0; i < n_; ++i) {
      if (!in_set(cases[static_cast<std::size_t>(i)], set(i), i, out, rates, impulses))
        return false;
    }
    return true;
  }

  ContactVector impulses(const Cases& cases) const {
    CaseSystem s(2 * n_);
    for (int i = 0; i < n_; ++i) {
      const Case& c = cases[static_cast<std::size_t>(i)];
      const int normal = 2 * i, friction = normal + 1;
      if (c.at_least) {
        s.given[normal] = set(i).least_normal;
      } else {
        s.free(normal);
      }
      if (c.friction == Bound::kStick) {
        s.free(friction);
        continue;
      }
      const auto bound = [&](double l) {
        return c.friction == Bound::kLow ? set(i).low(l) : set(i).high(l);
      };
      s.given[friction] = bound(s.given[normal]);
      if (!c.at_least) s.bring(friction, bound(1.0) - bound(0.0));
    }
    return s.solve(a_, b_);
  }

 private:
  static bool in_set(const Case& c, const ContactSet& set, int i, CoupledSolution& s, double rates,
                     double impulses) {
    double &normal = s.p[2 * i], &friction = s.p[2 * i + 1];
    double &gap_rate = s.y[2 * i], &slip = s.y[2 * i + 1];
    if (!set.pressed) {
      if (c.at_least ? gap_rate < -rates : std::abs(gap_rate) > rates) return false;
      if (normal < set.least_normal - impulses) return false;
      normal = std::max(normal, set.least_normal);
      gap_rate = c.at_least ? std::max(gap_rate, 0.0) : 0.0;  // removes round-off
    }
    const double low = set.low(normal), high = set.high(normal);
    const bool one_bound = high - low <= impulses;
    s.sticks[static_cast<std::size_t>(i)] = c.friction == Bound::kStick;
    switch (c.friction) {
      case Bound::kLow:
        return one_bound || slip >= -rates;
      case Bound::kHigh:
        return slip <= rates;
      case Bound::kStick:
        if (std::abs(slip) > rates || friction < low - impulses || friction > high + impulses) {
          return false;
        }
        friction = std::clamp(friction, low, std::max(low, high));
        slip = 0.0;
    }
    return true;
  }

  const ContactMatrix& a_;
  const ContactVector& b_;
  std::span<const ContactSet> sets_;
  int n_;
  double rate_ = 0.0, impulse_ = 0.0;  // typical sizes
};

// Calls action(cases) for each combination.
template <typename Action>
void for_each_combination(const CoupledProblem& problem, Cases& cases, int from, Action& action) {
  if (from == problem.size()) {
    action(cases);
    return;
  }
  for (const bool at_least : {true, false}) {
    for (const Bound f : {Bound::kStick, Bound::kLow, Bound::kHigh}) {
      const Case c{at_least, f};
      if (!distinct(c, problem.set(from))) continue;
      cases[static_cast<std::size_t>(from)] = c;
      for_each_combination(problem, cases, from + 1, action);
    }
  }
}

// of: receives the cases of the solution.
CoupledSolution by_cases(const CoupledProblem& problem, Cases& of) {
  CoupledSolution best, tried;
  const auto action = [&](const Cases& cases) {
    if (!problem.meets(cases, tried)) return;
    const bool first = best.solutions == 0;
    const bool same =
        !first && (best.y - tried.y).cwiseAbs().maxCoeff() <= kSameMotion * problem.rate();
    tried.solutions = best.solutions + (same ? 0 : 1);
    if (first || (same && tried.p.squaredNorm() < (1.0 - kSameMotion) * best.p.squaredNorm())) {
      best = tried;
      of = cases;
    }
    best.solutions = tried.solutions;
  };
  Cases cases{};
  for_each_combination(problem, cases, 0, action);
  return best;
}

// Contacts that all have a small compliance share their impulses in one way only.
ContactMatrix softened(const ContactMatrix& a, double give) {
  ContactMatrix soft = a;
  soft.diagonal().array() += give * a.cwiseAbs().maxCoeff();
  return soft;
}

// For bodies that can share impulses in several ways, where friction leads to several motions:
// selects the motion of contacts with equal small compliance. several: the result without
// compliance, returned if this fails.
CoupledSolution shared_alike(const ContactMatrix& a, const ContactVector& b,
                             std::span<const ContactSet> sets, const CoupledProblem& problem,
                             const CoupledSolution& several) {
  const ContactMatrix soft = softened(a, kGive);
  Cases cases{};
  CoupledSolution shared;
  if (by_cases(CoupledProblem(soft, b, sets), cases).solutions != 1) return several;
  if (!problem.meets(cases, shared)) return several;
  shared.solutions = 1;
  return shared;
}

// Finds the cases of contacts with a small compliance: each round takes the cases that follow from
// the last impulses, until they no longer change. The impulses of these cases are then exact, and
// independent of the order of the contacts.
CoupledSolution by_rounds(const ContactMatrix& a, const ContactVector& b,
                          std::span<const ContactSet> sets, const CoupledProblem& problem) {
  CoupledSolution out;
  for (const double give : kGives) {
    const ContactMatrix soft = softened(a, give);
    const CoupledProblem giving(soft, b, sets);
    Cases cases{}, next = giving.cases_of(ContactVector::Zero(b.size()));
    for (int k = 0; k < kMostRounds && next != cases; ++k) {
      cases = next;
      next = giving.cases_of(giving.impulses(cases));
    }
    if (next == cases && problem.meets(cases, out)) {
      out.solutions = 1;
      return out;
    }
  }
  return {};
}

// Solves each contact by itself, in turn, until the cases of all fit together (projected
// Gauss-Seidel). The impulses of these cases are then exact.
CoupledSolution by_sweeps(const ContactMatrix& a, const ContactVector& b,
                          std::span<const ContactSet> sets, const CoupledProblem& problem) {
  const int n = problem.size();
  ContactVector p = ContactVector::Zero(2 * n);
  Cases cases{};
  CoupledSolution out;
  for (int k = 0; k < kSweeps; ++k) {
    Cases found{};
    for (int i = 0; i < n; ++i) {
      const ContactMatrix own = a.block(2 * i, 2 * i, 2, 2);
      const ContactVector rest =
          b.segment(2 * i, 2) + a.middleRows(2 * i, 2) * p - own * p.segment(2 * i, 2);
      const std::span<const ContactSet> set = sets.subspan(static_cast<std::size_t>(i), 1);
      Cases of{};
      const CoupledSolution s = by_cases(CoupledProblem(own, rest, set), of);
      if (s.solutions == 0) return {};
      p.segment(2 * i, 2) = s.p;
      Case& c = found[static_cast<std::size_t>(i)];
      c.at_least = set[0].pressed || s.p[0] <= set[0].least_normal;
      c.friction = s.sticks[0]                    ? Bound::kStick
                   : s.p[1] <= set[0].low(s.p[0]) ? Bound::kLow
                                                  : Bound::kHigh;
      if (!distinct(c, set[0])) c.friction = Bound::kLow;
    }
    const bool known = k > 0 && found == cases;
    cases = found;
    if (known && k % 8 != 0) continue;  // these cases were not a solution
    if (problem.meets(cases, out)) {
      CoupledSolution shared;
      if (problem.meets(problem.all_closed(cases, out), shared) &&
          shared.p.squaredNorm() < out.p.squaredNorm()) {
        out = shared;
      }
      out.solutions = 1;
      return out;
    }
  }
  return {};
}

// For more contacts than kMostTried.
CoupledSolution solve_many(const ContactMatrix& a, const ContactVector& b,
                           std::span<const ContactSet> sets) {
  const CoupledProblem problem(a, b, sets);
  if (const CoupledSolution s = by_rounds(a, b, sets, problem); s.solutions > 0) return s;
  const CoupledSolution swept = by_sweeps(a, b, sets, problem);
  if (swept.solutions > 0 || problem.size() > kMostTriedBlind) return swept;
  Cases of{};
  return by_cases(problem, of);
}

// Sorts the contacts by their properties, so that a list in another order has the same solution
// even if there are several.
using Order = std::array<Eigen::Index, kMaxContacts>;
Order order_of(const ContactMatrix& a, const ContactVector& b, std::span<const ContactSet> sets) {
  Order order{};
  const auto end = order.begin() + static_cast<std::ptrdiff_t>(sets.size());
  std::iota(order.begin(), end, Eigen::Index{0});
  const auto key = [&](Eigen::Index i) {
    const ContactSet& set = sets[static_cast<std::size_t>(i)];
    return std::array{set.friction,
                      set.least_normal,
                      set.side,
                      set.floor,
                      set.slides,
                      set.pressed ? 1.0 : 0.0,
                      b[2 * i],
                      b[2 * i + 1],
                      a(2 * i, 2 * i),
                      a(2 * i, 2 * i + 1),
                      a(2 * i + 1, 2 * i + 1)};
  };
  std::sort(order.begin(), end, [&](Eigen::Index i, Eigen::Index j) {
    return std::pair(key(i), i) < std::pair(key(j), j);
  });
  return order;
}

bool moves_both_ways(const ContactMatrix& a) {
  return a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0) > kSingular * a(0, 0) * a(1, 1);
}

// True for one contact with Coulomb's set that can move in both directions; planar_contact.h solves
// it in closed form.
bool is_plain(const ContactMatrix& a, std::span<const ContactSet> sets) {
  return sets.size() == 1 && sets[0].least_normal == 0.0 && sets[0].side == 0.0 &&
         sets[0].slides == 0.0 && !sets[0].pressed && moves_both_ways(a);
}

CoupledSolution one_plain(const ContactMatrix& a, const ContactVector& b, const ContactSet& set) {
  const CoulombSolution c =
      solve_coulomb({a(0, 0), a(0, 1), a(1, 0), a(1, 1)}, b[0], b[1], set.friction);
  CoupledSolution s;
  s.solutions = c.solutions;
  s.p = Eigen::Vector2d(c.normal, c.friction);
  s.y = a * s.p + b;
  s.sticks[0] = c.contact_case == ContactCase::kStick;
  if (c.contact_case != ContactCase::kOpen) s.y[0] = 0.0;
  if (s.sticks[0]) s.y[1] = 0.0;
  return s;
}

// The slip of contact i in a vector of all contacts; with two tangential directions, its magnitude.
struct SlipOf {
  Eigen::Index size;
  std::size_t contacts;
  double operator()(const ContactVector& y, std::size_t i) const {
    const Eigen::Index rows = size / static_cast<Eigen::Index>(contacts),
                       at = rows * static_cast<Eigen::Index>(i);
    return rows == 3 ? y.segment<2>(at + 1).norm() : y[at + 1];
  }
};

// The expansion after `compressed` (0: Coulomb's law alone). The mu of each contact is improved
// until it fits the slips: improve(friction, normal impulse, impulse along the slip, slip,
// mobility).
template <typename Friction, typename Improve>
CoupledSolution solve_with_friction(const ContactMatrix& a, const ContactVector& b,
                                    std::span<const ImpactLaw> laws,
                                    const ContactVector& compressed,
                                    std::array<Friction, kMaxContacts>& friction, Improve improve) {
  std::array<ContactSet, kMaxContacts> sets{};
  std::array<DiscSet, kMaxContacts> discs{};
  const std::size_t n = laws.size();
  const auto rows = b.size() / static_cast<Eigen::Index>(n);
  const SlipOf slip{b.size(), n};
  for (;;) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = rows * static_cast<Eigen::Index>(i);
      const double mu = friction[i].mu();
      if (rows == 3) {
        discs[i] = expansion_disc(laws[i], mu, compressed[at], compressed.segment<2>(at + 1));
      } else {
        sets[i] = expansion_set(laws[i], mu, compressed[at], compressed[at + 1]);
      }
    }
    const CoupledSolution s = rows == 3 ? solve_discs(a, b, std::span(discs).first(n))
                                        : solve_coupled(a, b, std::span(sets).first(n));
    bool improved = false;
    for (std::size_t i = 0; i < n && s.solutions == 1; ++i) {
      const auto at = rows * static_cast<Eigen::Index>(i);
      const double along_slip = rows == 3 ? -friction[i].mu() * s.p[at] : s.p[at + 1];
      improved =
          improve(friction[i], s.p[at], along_slip, slip(s.y, i), a(at + 1, at + 1)) || improved;
    }
    if (!improved) return s;
  }
}

}  // namespace

ContactVector shared_solution(const ContactMatrix& matrix, const ContactVector& right) {
  const Eigen::PartialPivLU<ContactMatrix> lu(matrix);
  const auto pivots = lu.matrixLU().diagonal().cwiseAbs();
  if (pivots.minCoeff() > kSingular * matrix.cwiseAbs().maxCoeff()) return lu.solve(right);
  Eigen::CompleteOrthogonalDecomposition<ContactMatrix> least(matrix.rows(), matrix.cols());
  least.setThreshold(kSingular);
  least.compute(matrix);
  return least.solve(right);
}

ContactVector CaseSystem::solve(const ContactMatrix& a, const ContactVector& b) const {
  if (count == 0) return given;
  const auto c = columns.leftCols(count);
  const auto r = rows.leftCols(count);
  const ContactMatrix matrix = r.transpose() * (a * c);
  const ContactVector right = -(r.transpose() * (a * given + b));
  return given + c * shared_solution(matrix, right);
}

CoupledSolution solve_coupled(const ContactMatrix& a, const ContactVector& b,
                              std::span<const ContactSet> sets) {
  assert(a.rows() == b.size() && b.size() == 2 * static_cast<Eigen::Index>(sets.size()));
  if (is_plain(a, sets)) return one_plain(a, b, sets[0]);
  const CoupledProblem problem(a, b, sets);
  Cases of{};
  if (problem.size() <= kMostTried) {
    const CoupledSolution s = by_cases(problem, of);
    return s.solutions > 1 ? shared_alike(a, b, sets, problem, s) : s;
  }
  const Order order = order_of(a, b, sets);
  ContactMatrix ordered_a(a.rows(), a.cols());
  ContactVector ordered_b(b.size());
  ContactList<ContactSet> ordered_sets;
  for (Eigen::Index i = 0; i < problem.size(); ++i) {
    const Eigen::Index from = 2 * order[static_cast<std::size_t>(i)];
    ordered_sets.push_back(sets[static_cast<std::size_t>(from / 2)]);
    ordered_b.segment<2>(2 * i) = b.segment<2>(from);
    for (Eigen::Index j = 0; j < problem.size(); ++j) {
      ordered_a.block<2, 2>(2 * i, 2 * j) =
          a.block<2, 2>(from, 2 * order[static_cast<std::size_t>(j)]);
    }
  }
  const CoupledSolution found = solve_many(ordered_a, ordered_b, ordered_sets);
  CoupledSolution s = found;
  for (Eigen::Index i = 0; i < problem.size() && found.solutions > 0; ++i) {
    const Eigen::Index to = 2 * order[static_cast<std::size_t>(i)];
    s.p.segment<2>(to) = found.p.segment<2>(2 * i);
    s.y.segment<2>(to) = found.y.segment<2>(2 * i);
    s.sticks[static_cast<std::size_t>(to / 2)] = found.sticks[static_cast<std::size_t>(i)];
  }
  return s;
}

CoupledSolution solve_compression(const ContactMatrix& a, const ContactVector& b,
                                  std::span<const ImpactLaw> laws) {
  return solve_expansion(a, b, laws, ContactVector::Zero(b.size()));
}

CoupledSolution solve_expansion(const ContactMatrix& a, const ContactVector& b,
                                std::span<const ImpactLaw> laws, const ContactVector& compressed) {
  std::array<ImpactFriction, kMaxContacts> friction;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    friction[i] = {laws[i].friction, SlipOf{b.size(), laws.size()}(b, i)};
  }
  return solve_with_friction(
      a, b, laws, compressed, friction,
      [](ImpactFriction& mu, double normal, double rubbed, double slip, double mobility) {
        return mu.improve(normal, rubbed, slip, mobility);
      });
}

CoupledSolution solve_lasting(const ContactMatrix& a, const ContactVector& b,
                              std::span<const ImpactLaw> laws, std::span<const double> before) {
  std::array<SlipFriction, kMaxContacts> friction;
  for (std::size_t i = 0; i < laws.size(); ++i) friction[i] = {laws[i].friction, before[i]};
  return solve_with_friction(a, b, laws, ContactVector::Zero(b.size()), friction,
                             [](SlipFriction& mu, double normal, double, double slip,
                                double mobility) { return mu.improve(slip, mobility * normal); });
}

CoupledSolution solve_coupled_impact(const ContactMatrix& a, const ContactVector& b,
                                     std::span<const ImpactLaw> laws) {
  if (laws.size() == 1 && b.size() == 2 && moves_both_ways(a)) {
    const ImpactResult r = solve_impact({a(0, 0), a(0, 1), a(1, 0), a(1, 1)}, b[0], b[1], laws[0]);
    CoupledSolution s;
    s.solutions = r.status == Status::kOk ? 1 : r.status == Status::kNoSolution ? 0 : 2;
    s.p = Eigen::Vector2d(r.normal(), r.friction());
    s.y = Eigen::Vector2d(r.gap_rate, r.slip);
    s.sticks[0] = r.slip == 0.0;
    return s;
  }
  const CoupledSolution c = solve_compression(a, b, laws);
  if (c.solutions != 1) return c;
  CoupledSolution e = solve_expansion(a, c.y, laws, c.p);
  e.p += c.p;
  return e;
}

}  // namespace rotorub
