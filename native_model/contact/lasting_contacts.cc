#include "native_model/contact/lasting_contacts.h"

#include <cmath>

#include "native_model/contact/kinematics.h"
#include "native_model/contact/planar_contact.h"
#include "native_model/contact/several_on_circles.h"

namespace rotorub {
namespace {

Eigen::Vector2d end_of_path(double h, const LastingContact& c) {
  return c.d + h * c.free.head<2>();
}

class OneOnCircle {
 public:
  OneOnCircle(double h, LastingContact& contact, const Eigen::Matrix3d& admittance)
      : h_(h),
        c_(contact),
        end_(end_of_path(h, contact)),
        along_normal_(admittance * contact_load(contact.e_r, contact.radius, 1.0, 0.0)),
        along_friction_(admittance * contact_load(contact.e_r, contact.radius, 0.0, 1.0)) {}

  Status solve() const {
    const double nn = -c_.e_r.dot(along_normal_.head<2>());
    const double nt = -c_.e_r.dot(along_friction_.head<2>());
    const double mu = c_.friction.at(slip_of(c_, c_.start));
    if (mu * std::abs(nt) < nn && solve_by_cases()) return Status::kOk;
    const Delassus g{nn, nt, slip_of(c_, along_normal_), slip_of(c_, along_friction_)};
    const CoulombSolution r =
        solve_coulomb(g, (c_.clearance - end_.norm()) / h_, slip_of(c_, c_.free), mu);
    const double sign = r.contact_case == ContactCase::kSlidePositive   ? 1.0
                        : r.contact_case == ContactCase::kSlideNegative ? -1.0
                                                                        : 0.0;
    take(sign, {true, r.normal, r.friction});
    return status_of(r.solutions);
  }

 private:
  struct Candidate {
    bool holds = false;
    double normal = 0.0, friction = 0.0;
    double slip = 0.0;  // at the end
  };
  // Sliding with T = ratio N.
  Candidate slide(double ratio) const {
    const Eigen::Vector3d g = along_normal_ + ratio * along_friction_;
    const double normal = reach_circle(end_, h_ * g.head<2>(), c_.clearance);
    return {normal > 0.0, normal, ratio * normal, slip_of(c_, c_.free + normal * g)};
  }
  // Sliding in one direction throughout, with mu at the slip of the middle.
  Candidate slide_on(double sign, double before) const {
    SlipFriction friction(c_.friction, before);
    for (;;) {
      const Candidate c = slide(-friction.mu() * sign);
      if (!c.holds || !friction.improve(0.5 * (before + c.slip))) return c;
    }
  }
  // Slip 0 at the end: T = T_0 + T_1 N.
  Candidate stick() const {
    const double compliance = slip_of(c_, along_friction_);
    const double constant = -slip_of(c_, c_.free) / compliance;
    const double ratio = -slip_of(c_, along_normal_) / compliance;
    const Eigen::Vector3d g = along_normal_ + ratio * along_friction_;
    const Eigen::Vector2d end = end_ + h_ * constant * along_friction_.head<2>();
    const double normal = reach_circle(end, h_ * g.head<2>(), c_.clearance);
    return {normal > 0.0, normal, constant + ratio * normal, 0.0};
  }
  bool take(double slip_sign, const Candidate& c) const {
    c_.slip_sign = slip_sign;
    c_.normal_impulse = c.normal;
    c_.friction_impulse = c.friction;
    return c.holds;
  }

  // Tries sliding on, stopping and reversing, and stores what holds in c_. Returns false if no
  // point of the circle is in reach.
  bool solve_by_cases() const {
    const double before = slip_before(c_), mu = c_.friction.sticking();
    const Candidate rest = stick();
    if (before == 0.0) {
      if (std::abs(rest.friction) <= mu * rest.normal) return take(0.0, rest);
      const double sign = rest.friction > 0.0 ? -1.0 : 1.0;
      return take(sign, slide_on(sign, 0.0));
    }
    const double sign = before > 0.0 ? 1.0 : -1.0;
    const Candidate through = slide_on(sign, before);
    if (!through.holds || through.slip * sign > 0.0) return take(sign, through);
    if (!rest.holds) return false;
    // Friction brakes until the slip is 0. `hold` is the force that then keeps it at 0, as an
    // impulse over a whole step.
    const double share = before / (before - through.slip);
    const double hold = (rest.friction + share * sign * mu * rest.normal) / (1.0 - share);
    if (share >= 1.0 || hold * sign <= mu * rest.normal) return take(0.0, rest);
    return take(-sign, slide(mu * sign * (1.0 - 2.0 * share)));
  }

  double h_;
  LastingContact& c_;
  Eigen::Vector2d end_;
  Eigen::Vector3d along_normal_, along_friction_;
};

}  // namespace

Status solve_lasting_contacts(double h, std::span<LastingContact> contacts,
                              const ContactAdmittance& admittance) {
  if (contacts.size() == 1) return OneOnCircle(h, contacts[0], admittance(0, 0)).solve();
  return solve_several_on_circles(h, contacts, admittance);
}

}  // namespace rotorub
