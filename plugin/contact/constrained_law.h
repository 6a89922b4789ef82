// The laws of rigid_law.h where other constraints act on the same bodies. The response of the step
// to the contact's impulses p = (normal, friction) is then no matrix, but a map y(p) = (gap rate,
// slip) at its end: monotone and piecewise smooth, known by trying it alone. Newton's iteration:
//   G = dy/dp at p by two trials,   p <- solution of the law for the line y(p) + G (p' - p)
// until the line meets what the next trial finds. Compression, (17), and expansion, (18)-(19), are
// two such problems, one after the other.
#pragma once

#include <Eigen/Core>

#include "native_model/contact/impact.h"
#include "native_model/contact/planar_contact.h"

namespace rotorub::plugin {

class ContactResponse {
 public:
  virtual ~ContactResponse() = default;
  // y at the end of the step, m/s (or m/s^2, with forces for impulses).
  virtual Eigen::Vector2d at(const Eigen::Vector2d& p) = 0;
  // How far y may be off, in its unit: the tolerance of what finds it.
  virtual double accuracy() const = 0;
};

struct ConstrainedContact {
  bool solved = true;                  // a solution of the law was found
  bool converged = true;               // false: p has the least error that was found
  Eigen::Vector2d p{0.0, 0.0};         // N s (or N): normal >= 0, friction on the rotor along e_t
  Eigen::Vector2d y{0.0, 0.0};         // y(p)
  Eigen::Vector2d error{0.0, 0.0};     // y(p) less that of the law, in the unit of y
  bool sticks = false;
};

// Normal law with y_N + offset >= 0 and Coulomb's, (12)-(13). `free` is y(0); `expected` the matrix
// without the constraints, for the size of the first trial.
ConstrainedContact solve_constrained(ContactResponse& response, const Eigen::Vector2d& free,
                                     const Delassus& expected, double offset, double friction);

// Poisson's law, in no time. y: after the impact.
ConstrainedContact solve_constrained_impact(ContactResponse& response, const Eigen::Vector2d& free,
                                            const Delassus& expected, const ImpactLaw& law);

}  // namespace rotorub::plugin
