// The contact in a fixed step of a model that has one contact or none: where the straight path of a
// step leaves the circle, lasting contact goes on or an impact begins. Lasting contact ends the
// step on the circle (contact/step_contact.h), most often by sliding on as in the step before.
// Impacts: verlet_impacts.cc. Several contacts: several_contacts.h.
#pragma once

#include <Eigen/Core>

#include "native_model/model/equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/load_kick.h"

namespace rotorub {

class OneContact {
 public:
  // Lasting contact: as the step before left it, and from go_on() on of this step.
  struct Lasting {
    bool lasts = false;
    double slip_sign = 0.0;               // sliding: +1, -1; 0: free or sticking
    double normal = 0.0, friction = 0.0;  // N s, of the step
    // N s, if the forces at the end of the step acted over the whole step.
    double normal_at_end = 0.0, friction_at_end = 0.0;
  };

  OneContact(const StepState& x, LoadKick& loads);

  Lasting now;
  ImpactList impacts;  // of the step, in order
  bool impacted = false;

  bool exists() const { return exists_; }
  bool lasts() const { return now.lasts; }

  // The step's beginning.
  void forget_last() {
    impacts.count = 0;
    impacted = false;
  }
  // A state has been written: what stands on the circle and does not close is lasting contact.
  void begin(const StepState& x);

  // go_on() may get x.free without what is iterated: lasting contact iterates it anyway.
  bool settles() const { return lasts(); }

  // Lasting contact over the step, where the straight path from x.seen with x.free would leave the
  // circle: x.after from x.free. True where the path leaves the circle out of flight.
  bool go_on(StepState& x, LoadKick& loads, bool unsettled = false);

  // x.free with the forces of the last step's end, by the normal of now.
  void hold_on(StepState& x, LoadKick& loads);

  // Of a step in two parts, `first` for `share` of it and the one just taken for `rest`. Alike: the
  // part goes on as contact was before the step.
  bool alike(const Lasting& part, const Lasting& was) const {
    return part.lasts && part.slip_sign == was.slip_sign;
  }
  static Lasting second_part(const Lasting& was, const Lasting& first) {
    Lasting second;
    second.lasts = was.lasts;
    second.slip_sign = first.slip_sign;
    return second;
  }
  void join_parts(double share, double rest, const Lasting& first);
  // Of such a step as if its mean loads had acted throughout.
  void go_on_as(const Lasting& mean) { now = mean; }

  // An impact has come; contact lasts from here on, or does not.
  void note_impact(const Impact& impact);
  void set_lasting(bool lasts) {
    now.lasts = lasts;
    now.slip_sign = 0.0;
  }

  // What outlives a step, and the forces.
  template <class Action>
  void for_each_kept(Action& action) {
    keep_flag(now.lasts, action);
    action(now.slip_sign);
  }
  template <class Action>
  void for_each_force_kept(Action& action) {
    action(now.normal_at_end);
    action(now.friction_at_end);
  }
  // Velocities at the step's end as they would be without its impacts.
  const double* end_without_impacts(const StepState& x) const {
    return impacted ? x.free.data() : x.after.data();
  }
  double slip_sign() const { return now.slip_sign; }
  // What the step did; sign_before: of the slip.
  void tell(FixedStep& out, double sign_before) const;
  // J, on the coordinates: of lasting contact, from velocities x.start to x.after.
  double lasting_work(const StepState& x) const;

 private:
  using Pair = equations::Pair;

  bool leaves(const StepState& x, const Pair& d, const Pair& w) const;
  void press_on(StepState& x, LoadKick& loads, const Pair& d, Pair w);
  void press(StepState& x, const Pair& d, const Pair& w);
  void press_anew(StepState& x, const Pair& d, const Pair& w);
  void couple(const StepState& x, const LoadKick& loads);
  void push(const StepState& x, const LoadKick& loads, const Pair& e,
            const Eigen::Vector2d& impulses, double* to) const;

  bool exists_ = false;
  double clearance_ = 0.0, radius_ = 0.0;
  // mu. Where it depends on the slip not a number, with which nothing slides on.
  double friction_ = 0.0;
  double last_sign_ = 0.0;                                // of the slip, before the step
  Pair normal_{1.0, 0.0};                                 // of the last lasting contact
  double normal_impulse_ = 0.0, friction_impulse_ = 0.0;  // N s, of a step with impacts

  // What a load (x, y, torque about z) does to the velocities: the columns A^-1 J^T and the
  // admittance J A^-1 J^T. Where a free spin is coupled with bending (velocity_matrix.h) the
  // columns are A_0^-1 J^T, and what A^-1 J^T has beside them changes from step to step.
  StepState::Coordinates column_[3];
  double uncoupled_[3][3] = {}, admittance_[3][3] = {};
  VelocityMatrix::Coupled coupled_[3];
};

}  // namespace rotorub
