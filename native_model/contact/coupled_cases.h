// The cases of the contacts in a coupled problem (coupled_problem.h), and the impulses of given
// cases. Internal to this folder.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "native_model/contact/coupled_problem.h"

namespace rotorub::coupled_cases {

enum class Bound { kLow, kHigh, kStick };
struct Case {
  bool at_bound = true;  // L_N = n, otherwise y_N = 0
  Bound friction = Bound::kLow;
  bool operator==(const Case&) const = default;
};
using Cases = std::array<Case, kMaxContacts>;

// False if the case is excluded or duplicates another one: a known normal impulse has no other
// case, there is no sticking without friction, and an open contact has no friction.
bool distinct(const Case& c, const ContactSet& set);

class CoupledProblem {
 public:
  // The arguments must outlive this object.
  CoupledProblem(const ContactMatrix& a, const ContactVector& b, std::span<const ContactSet> sets);

  const ContactSet& set(int i) const { return sets_[static_cast<std::size_t>(i)]; }
  int size() const { return n_; }
  double rate() const { return rate_; }  // m/s, size of the rates that the impulses change

  // The same cases, but with every contact closed that the solution leaves on its circle. If the
  // contacts can share their forces in several ways, the solution of these cases is the smallest
  // one, for any order of the contacts.
  Cases all_closed(const Cases& cases, const CoupledSolution& s) const;

  // The cases that follow from p: the cases of the projections of p - y / (mobility of the contact
  // itself) onto the sets.
  Cases cases_of(const ContactVector& p) const;

  // The solution with these cases, whose `solutions` is 1; empty if its impulses are not in the
  // sets.
  std::optional<CoupledSolution> solution_of(const Cases& cases) const;

  // The impulses of these cases, whether or not they are in the sets.
  ContactVector impulses(const Cases& cases) const;

 private:
  static bool in_set(const Case& c, const ContactSet& set, int i, CoupledSolution& s, double rates,
                     double impulses);

  const ContactMatrix& a_;
  const ContactVector& b_;
  std::span<const ContactSet> sets_;
  int n_;
  double rate_ = 0.0, impulse_ = 0.0;  // typical sizes
};

}  // namespace rotorub::coupled_cases
