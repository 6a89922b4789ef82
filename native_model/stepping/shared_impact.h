// One impact in a fixed step, in which all rigid contacts that are closed at that instant take
// part: Poisson's law for all of them as one problem (contact/coupled_law.h). Usage: add() each of
// the contacts, then solve().
#pragma once

#include <span>

#include "native_model/model/constraint.h"
#include "native_model/stepping/step_contacts.h"

namespace rotorub {

class SharedImpact {
 public:
  // `contacts` must outlive this object.
  explicit SharedImpact(StepContacts& contacts) : contacts_(&contacts) {}

  // Adds a contact with the normal e_r and the velocities and accelerations (nq values) of the
  // instant. closed: it lasted until then.
  void add(std::size_t contact, bool closed, const Eigen::Vector2d& e_r, const double* velocity,
           const double* acceleration);
  // Solves the impact and adds its impulses to the contacts' list of impacts, with the time t (s).
  // mass_time (s), q: where M is taken. is_last: no contact may rebound. impulses: output, nq
  // values, the impulses on the coordinates (W p), N s. Returns another status than kOk if the laws
  // have no unique solution; there is then no impulse.
  Status solve(const StepState& state, double t, double mass_time, const double* q, bool is_last,
               double* impulses);

  // A contact that takes part.
  struct Member {
    std::size_t contact = 0;        // its index
    Eigen::Vector2d e_r{1.0, 0.0};  // outward normal
    bool lasted = false;            // it lasted until the impact
    ImpactLaw law{};
    double closing_acceleration = 0.0;  // m/s^2 (contact/impact.h)
    bool stays_closed = false;          // after solve(): it is closed after the impact
  };
  std::span<const Member> members() const { return {members_.data(), members_.size()}; }
  double approach() const { return approach_; }  // m/s, the largest approach speed
  // True if the first contact flies for more than a step of h (s) after the impact.
  bool rebounds(double h) const { return rebounds(members_[0], h, approach_); }

 private:
  // True if an impact at the speed `approach` (m/s) is followed by a flight (contact/impact.h)
  // longer than a step of h (s) and longer than the impact itself.
  bool rebounds(const Member& member, double h, double approach) const;
  CoupledSolution solve_with_laws(const ContactMatrix& g, const ContactVector& before) const;

  StepContacts* contacts_;
  double approach_ = 0.0;
  ContactList<Member> members_;
  ContactVector before_ = ContactVector(2 * kMaxContacts);  // m/s, (gap rate, slip) of each contact
};

}  // namespace rotorub
