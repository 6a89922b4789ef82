#include "native_model/contact/coupled_problem.h"

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <utility>

#include "native_model/contact/coupled_cases.h"
#include "native_model/contact/planar_contact.h"

namespace rotorub {
namespace {

using coupled_cases::Bound;
using coupled_cases::Case;
using coupled_cases::Cases;
using coupled_cases::CoupledProblem;
using coupled_cases::distinct;

constexpr double kSingular = 1e-12;  // pivots below this share of the largest count as 0
// With at most this number of contacts all cases are tried, which counts the motions.
constexpr int kMostTried = 3;
// With at most this number of contacts all cases are tried if nothing else leads to a solution.
constexpr int kMostTriedBlind = 5;
constexpr int kSweeps = 2000;
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

// Calls action(cases) for each combination.
template <typename Action>
void for_each_combination(const CoupledProblem& problem, Cases& cases, int from, Action& action) {
  if (from == problem.size()) {
    action(cases);
    return;
  }
  for (const bool at_bound : {true, false}) {
    for (const Bound f : {Bound::kStick, Bound::kLow, Bound::kHigh}) {
      const Case c{at_bound, f};
      if (!distinct(c, problem.set(from))) continue;
      cases[static_cast<std::size_t>(from)] = c;
      for_each_combination(problem, cases, from + 1, action);
    }
  }
}

// A solution and its cases.
struct SolvedCases {
  CoupledSolution solution;
  Cases cases{};
};

// Tries all combinations of cases. If several solutions have the same motion, it keeps the solution
// with the least impulses; if there are several motions, it keeps the first.
SolvedCases by_cases(const CoupledProblem& problem) {
  SolvedCases found;
  CoupledSolution& best = found.solution;
  const auto action = [&](const Cases& cases) {
    const std::optional<CoupledSolution> tried = problem.solution_of(cases);
    if (!tried) return;
    const bool first = best.solutions == 0;
    const bool same =
        !first && (best.y - tried->y).cwiseAbs().maxCoeff() <= kSameMotion * problem.rate();
    const int motions = best.solutions + (same ? 0 : 1);
    if (first || (same && tried->p.squaredNorm() < (1.0 - kSameMotion) * best.p.squaredNorm())) {
      best = *tried;
      found.cases = cases;
    }
    best.solutions = motions;
  };
  Cases cases{};
  for_each_combination(problem, cases, 0, action);
  return found;
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
  const SolvedCases found = by_cases(CoupledProblem(soft, b, sets));
  if (!found.solution.is_unique()) return several;
  return problem.solution_of(found.cases).value_or(several);
}

// Finds the cases of contacts with a small compliance: each round takes the cases that follow from
// the last impulses, until they no longer change. The impulses of these cases are then exact, and
// independent of the order of the contacts.
CoupledSolution by_rounds(const ContactMatrix& a, const ContactVector& b,
                          std::span<const ContactSet> sets, const CoupledProblem& problem) {
  for (const double give : kGives) {
    const ContactMatrix soft = softened(a, give);
    const CoupledProblem giving(soft, b, sets);
    Cases cases{}, next = giving.cases_of(ContactVector::Zero(b.size()));
    for (int k = 0; k < kMostRounds && next != cases; ++k) {
      cases = next;
      next = giving.cases_of(giving.impulses(cases));
    }
    if (next != cases) continue;
    if (const auto solution = problem.solution_of(cases)) return *solution;
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
  for (int k = 0; k < kSweeps; ++k) {
    Cases found{};
    for (int i = 0; i < n; ++i) {
      const ContactMatrix own = a.block(2 * i, 2 * i, 2, 2);
      const ContactVector rest =
          b.segment(2 * i, 2) + a.middleRows(2 * i, 2) * p - own * p.segment(2 * i, 2);
      const std::span<const ContactSet> set = sets.subspan(static_cast<std::size_t>(i), 1);
      const CoupledSolution s = by_cases(CoupledProblem(own, rest, set)).solution;
      if (s.solutions == 0) return {};
      p.segment(2 * i, 2) = s.p;
      Case& c = found[static_cast<std::size_t>(i)];
      c.at_bound = set[0].normal_known || s.p[0] <= set[0].least_normal;
      c.friction = s.sticks[0]                    ? Bound::kStick
                   : s.p[1] <= set[0].low(s.p[0]) ? Bound::kLow
                                                  : Bound::kHigh;
      if (!distinct(c, set[0])) c.friction = Bound::kLow;
    }
    const bool known = k > 0 && found == cases;
    cases = found;
    if (known && k % 8 != 0) continue;  // these cases were not a solution
    const auto solution = problem.solution_of(cases);
    if (!solution) continue;
    const auto shared = problem.solution_of(problem.all_closed(cases, *solution));
    const bool smaller = shared && shared->p.squaredNorm() < solution->p.squaredNorm();
    return smaller ? *shared : *solution;
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
  return by_cases(problem).solution;
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
                      set.normal_known ? 1.0 : 0.0,
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

// True for one contact with Coulomb's set that can move in both directions; planar_contact.h solves
// it in closed form.
bool is_plain(const ContactMatrix& a, std::span<const ContactSet> sets) {
  return sets.size() == 1 && sets[0].least_normal == 0.0 && sets[0].side == 0.0 &&
         sets[0].slides == 0.0 && !sets[0].normal_known && moves_both_ways(a);
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

}  // namespace

bool moves_both_ways(const ContactMatrix& a) {
  return a(0, 0) * a(1, 1) - a(0, 1) * a(1, 0) > kSingular * a(0, 0) * a(1, 1);
}

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
  if (problem.size() <= kMostTried) {
    const CoupledSolution s = by_cases(problem).solution;
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

}  // namespace rotorub
