// One impact in a fixed step, together with all rigid contacts that are closed at that instant.
#pragma once

#include <array>

#include "native_model/model/constraint.h"
#include "native_model/stepping/step_contacts.h"

namespace rotorub {

class SharedImpact {
 public:
  // `contacts` must outlive this object.
  explicit SharedImpact(StepContacts& contacts) : contacts_(&contacts) {}

  // Adds a contact with the normal e_r and the velocities and accelerations (nq values) of the
  // instant. closed: it lasted until then.
  void join(std::size_t contact, bool closed, const Eigen::Vector2d& e_r, const double* velocity,
            const double* acceleration);
  // Solves the impact and notes its impulses as impacts at time t. load: receives the impulses on
  // the coordinates. (at, q): time and coordinates at which M is taken. ends: no contact may
  // rebound. Returns another status than kOk if the laws have no unique solution.
  Status strike(const StepState& x, double t, double at, const double* q, bool ends, double* load);

  std::size_t count() const { return count_; }
  std::size_t contact(std::size_t i) const { return of_[i].index; }
  // True if the contact is closed after the impact.
  bool rests(std::size_t i) const { return rests_[i]; }
  double approach() const { return approach_; }  // m/s, the largest
  // True if the first contact flies for more than a step of h (s) after the impact.
  bool rebounds(double h) const { return rebounds(0, h, approach_); }

 private:
  // True if an impact at the speed `approach` (m/s) is followed by a flight (contact/impact.h)
  // longer than a step of h (s) and longer than the impact itself.
  bool rebounds(std::size_t i, double h, double approach) const;

  StepContacts* contacts_;
  std::size_t count_ = 0;
  double approach_ = 0.0;
  std::array<ClosedContact, kMaxContacts> of_{};
  std::array<bool, kMaxContacts> closed_{}, rests_{};
  std::array<ImpactLaw, kMaxContacts> laws_{};
  std::array<double, kMaxContacts> closing_acceleration_{};  // m/s^2 (contact/impact.h)
  ContactVector before_ = ContactVector(2 * kMaxContacts);
  ContactMatrix g_;
};

}  // namespace rotorub
