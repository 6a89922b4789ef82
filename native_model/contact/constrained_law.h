// The laws of coupled_law.h for bodies on which other constraints act too. The response of the step
// to the contacts' impulses p, (normal, friction) of each, is then not a matrix but a map y(p) to
// the (gap rate, slip) of each contact at the end of the step. The map is monotone and piecewise
// smooth, and known only by evaluation. Newton's iteration repeats
//   G = dy/dp at p by trials,   p <- solution of the laws for the line y(p) + G (p' - p)
// until the line agrees with the next evaluation.
//
// An impact takes no time, so bounded forces have no impulse in it: neither friction losses nor the
// load that presses a joint against its limit or another contact together. Compression, (17), and
// expansion, (18)-(19), are therefore two such problems, one after the other, for the map
//   y = y(0) + s(p),   s(c p) = c s(p), c > 0: the constraints' response to the impulses alone.
// Over the whole step the bounded forces do act. If they close the gap again, y_N(p) < 0, a third
// problem finds the further impulses p' of the lasting contact, (12)-(13), from y(p + p') with a
// normal impulse p'_N >= 0.
#pragma once

#include <array>
#include <span>

#include "native_model/contact/coupled_law.h"

namespace rotorub {

class ContactResponse {
 public:
  virtual ~ContactResponse() = default;
  // y at the end of the step, m/s (or m/s^2, if p holds forces). It includes what the law adds to
  // the gap rates: a gap over the step, or a reference.
  virtual ContactVector at(const ContactVector& p) = 0;
  // s(p), the change of y by impulses that take no time. By default the constraints have no bounded
  // forces.
  virtual ContactVector instant_change(const ContactVector& p) {
    const ContactVector none = ContactVector::Zero(p.size());
    return at(p) - at(none);
  }
  // Bound on the error of y, in its unit: the tolerance of the solver behind it.
  virtual double accuracy() const = 0;
};

struct ConstrainedContact {
  bool solved = true;     // a solution of the law was found
  bool converged = true;  // false: p has the least error that was reached
  ContactVector p;        // N s (or N): normal >= 0, friction on the rotor along e_t
  ContactVector y;        // y(p)
  ContactVector after;    // for an impact: y just after it
  ContactVector error;    // y(p) minus the prediction of the line, in the unit of y
  std::array<bool, kMaxContacts> sticks{};
  std::array<bool, kMaxContacts> lasts{};  // for an impact: the gap closed again in the step
};

// Normal law with y_N >= 0 and Coulomb's law, (12)-(13); of `laws` only the friction counts. free:
// y(0), with two or three numbers for each contact (coupled_problem.h); expected: the matrix
// without the constraints, for the size of the first trials.
ConstrainedContact solve_constrained(ContactResponse& response, const ContactVector& free,
                                     const ContactMatrix& expected,
                                     std::span<const ImpactLaw> laws);

// Poisson's law for an instantaneous impact, and a lasting contact if the rest of the step closes a
// gap again.
ConstrainedContact solve_constrained_impact(ContactResponse& response, const ContactVector& free,
                                            const ContactMatrix& expected,
                                            std::span<const ImpactLaw> laws);

}  // namespace rotorub
