// The laws of coupled_law.h where other constraints act on the same bodies. The
// response of the step to the contacts' impulses p = (normal, friction) of each is then no matrix,
// but a map y(p) = (gap rate, slip) of each at its end: monotone and piecewise smooth, known by
// trying it alone. Newton's iteration:
//   G = dy/dp at p by trials,   p <- solution of the laws for the line y(p) + G (p' - p)
// until the line meets what the next trial finds.
//
// An impact takes no time, so only what is without bound acts in it: a friction loss, the load that
// presses a joint into its limit or another contact together have no impulse. Compression, (17),
// and expansion, (18)-(19), are therefore two such problems, one after the other, for the map
//   y = y(0) + s(p),   s(c p) = c s(p), c > 0: the constraints' response to the impulses alone.
// Over the whole step the bounded forces do act. Where they close the gap again, y_N(p) < 0, a
// third problem finds the further impulses of the contact that lasts, (12)-(13): y(p + p') with p'
// >= 0.
#pragma once

#include <array>
#include <span>

#include "native_model/contact/coupled_law.h"

namespace rotorub {

class ContactResponse {
 public:
  virtual ~ContactResponse() = default;
  // y at the end of the step, m/s (or m/s^2, with forces for impulses), with what the law adds to
  // the gap rates: a gap over the step, a reference.
  virtual ContactVector at(const ContactVector& p) = 0;
  // s(p), the change of y by impulses that act in no time. By default the constraints have no
  // bounded forces.
  virtual ContactVector sudden(const ContactVector& p) {
    const ContactVector none = ContactVector::Zero(p.size());
    return at(p) - at(none);
  }
  // How far y may be off, in its unit: the tolerance of what finds it.
  virtual double accuracy() const = 0;
};

struct ConstrainedContact {
  bool solved = true;     // a solution of the law was found
  bool converged = true;  // false: p has the least error that was found
  ContactVector p;        // N s (or N): normal >= 0, friction on the rotor along e_t
  ContactVector y;        // y(p)
  ContactVector after;    // of an impact: y just after it, in no time
  ContactVector error;    // y(p) less that of the law, in the unit of y
  std::array<bool, kMaxContacts> sticks{};
  std::array<bool, kMaxContacts> lasts{};  // of an impact: the step has closed the gap again
};

// Normal law with y_N >= 0 and Coulomb's, (12)-(13), the friction of `laws` alone. `free` is y(0),
// of two or three numbers each (coupled_law.h); `expected` the matrix without the constraints, for
// the size of the first trial.
ConstrainedContact solve_constrained(ContactResponse& response, const ContactVector& free,
                                     const ContactMatrix& expected,
                                     std::span<const ImpactLaw> laws);

// Poisson's law, in no time, and what the rest of the step makes of it.
ConstrainedContact solve_constrained_impact(ContactResponse& response, const ContactVector& free,
                                            const ContactMatrix& expected,
                                            std::span<const ImpactLaw> laws);

}  // namespace rotorub
