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

// One contact. The impulses are stored in the contact itself.
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
    store(sign, {true, r.normal, r.friction});
    return status_of(r.solutions);
  }

 private:
  // Impulses (N s) with which the centre ends on the circle, and the slip at the end, m/s.
  struct Candidate {
    bool holds = false;  // there are such impulses
    double normal = 0.0, friction = 0.0, slip = 0.0;
  };
  // Sliding with T = ratio N.
  Candidate slide(double ratio) const {
    const Eigen::Vector3d g = along_normal_ + ratio * along_friction_;
    const auto normal = reach_circle(end_, h_ * g.head<2>(), c_.clearance);
    if (!normal) return {};
    return {true, *normal, ratio * *normal, slip_of(c_, c_.free + *normal * g)};
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
    const auto normal = reach_circle(end, h_ * g.head<2>(), c_.clearance);
    // Without a solution only the sign of this friction is used, for the direction of sliding.
    if (!normal) return {false, 0.0, constant - ratio, 0.0};
    return {true, *normal, constant + ratio * *normal, 0.0};
  }
  // Stores the candidate in c_ and returns whether it holds.
  bool store(double slip_sign, const Candidate& c) const {
    c_.slip_sign = slip_sign;
    c_.normal_impulse = c.normal;
    c_.friction_impulse = c.friction;
    return c.holds;
  }

  // Tries sliding on, stopping and reversing, and stores the case that holds. Returns false if no
  // point of the circle is in reach.
  bool solve_by_cases() const {
    const double before = slip_before(c_), mu = c_.friction.sticking();
    const Candidate stopped = stick();
    if (before == 0.0) {
      if (stopped.holds && std::abs(stopped.friction) <= mu * stopped.normal) {
        return store(0.0, stopped);
      }
      const double sign = stopped.friction > 0.0 ? -1.0 : 1.0;
      return store(sign, slide_on(sign, 0.0));
    }
    const double sign = before > 0.0 ? 1.0 : -1.0;
    const Candidate sliding = slide_on(sign, before);
    if (!sliding.holds || sliding.slip * sign > 0.0) return store(sign, sliding);
    if (!stopped.holds) return false;
    // Friction brakes until the slip is 0. `hold` is the force that then keeps it at 0, as an
    // impulse over a whole step.
    const double share = before / (before - sliding.slip);
    const double hold = (stopped.friction + share * sign * mu * stopped.normal) / (1.0 - share);
    if (share >= 1.0 || hold * sign <= mu * stopped.normal) return store(0.0, stopped);
    return store(-sign, slide(mu * sign * (1.0 - 2.0 * share)));
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
