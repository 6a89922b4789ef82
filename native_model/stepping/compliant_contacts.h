// Contacts that give (contact/compliance.h) in a fixed step of one run. Their force is one more
// load at the coordinates that the step sees, with its damping and its friction implicit:
//
//   P = w_0 + w_1 p',   |T| <= mu P,   slip of the step's end != 0: T = -mu P sign(slip)
//
// p' the mean of the step's begin and end, w_0 the impulse of the spring and w_1 that of the damper
// for a rate of 1, over the part of the step in which the straight paths to the place that is seen,
// and on from there, are in the wall. Where a touch is, and how fast, is found on them: order 2.
// Explicit in the spring: h < 2 / sqrt(k g_NN) (step_limit.h).
#pragma once

#include "native_model/stepping/contact_columns.h"

namespace rotorub {

class CompliantContacts : public ContactColumns {
 public:
  // Nothing is held on a circle.
  struct Lasting {};
  Lasting now;

  CompliantContacts(StepState& x, LoadKick& loads) : ContactColumns(x, loads) {}

  static constexpr bool lasts() { return false; }
  void forget_last() {}
  void begin(const StepState& x);
  bool go_on(StepState& x, LoadKick& loads, bool unsettled = false);
  void hold_on(StepState& x, LoadKick& loads);
  const double* end_without_impacts(const StepState& x) const { return x.after.data(); }
  void tell(FixedStep& out, double sign_before) const;
  double lasting_work(const StepState& x) const { return work_of_lasting(x.after.data()); }

 private:
  struct Contact {
    bool touches = false;        // in the wall since the last touch,
    double hunt_crossley = 0.0;  // s/m, by whose speed
    double slip_sign = 0.0;
    // Of the step: w_0 (N s) and w_1 (N s^2/m); its impulses, N s.
    double spring = 0.0, damper = 0.0, normal = 0.0, friction = 0.0;
  };
  void meet_wall(std::size_t i, const Eigen::Vector3d& free);
  bool meet_walls(StepState& x, LoadKick& loads);
  std::size_t touching() const;
  bool press(StepState& x);
  // Of the contact at the rates (ddot, spin) that it would end with but for its own impulses.
  void press_one(std::size_t i, const Eigen::Vector3d& end);
  // before, after: (gap rate, slip) at the step's ends, but for its own impulses, which add what
  // the matrix tells.
  void find_impulses(std::size_t i, const Eigen::Vector2d& before, const Eigen::Vector2d& after,
                     const Delassus& a);

  std::array<Contact, kMaxContacts> of_{};
  double before_ = 0.0, after_ = 0.0;             // s, of the step, of the place that it sees
  std::array<double, kMaxContacts> last_sign_{};  // of the slip, of the step before
};

}  // namespace rotorub
