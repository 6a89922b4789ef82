// Several contacts in a fixed step of one run: as one_contact.h, but lasting contacts and impacts
// of all of them are solved together (contact/coupled_law.h).
//
// Contacts that last end the step on their circles: step impulses p with
//   |d_i + h (w_i + sum A_ij p_j)| = delta_i,    A = J (M + h D/2)^-1 J^T,
// by Newton's method on the linear complementarity problem of all of them, friction by the slip of
// the middle of the step. An impact takes with it every contact that is closed there
// (shared_impact.h).
#pragma once

#include "native_model/contact/coupled_law.h"
#include "native_model/stepping/contact_columns.h"

namespace rotorub {

class SeveralContacts : public ContactColumns {
 public:
  // Of lasting contact, as in OneContact.
  struct Lasting {
    struct Of {
      bool lasts = false;
      double slip_sign = 0.0;
      double normal = 0.0, friction = 0.0, normal_at_end = 0.0, friction_at_end = 0.0;  // N s
    };
    std::array<Of, kMaxContacts> of{};
  };
  SeveralContacts(StepState& x, LoadKick& loads);

  Lasting now;
  std::vector<Impact> impacts;  // of the step, in order

  bool lasts() const;

  // As OneContact's. go_on: an impact may have come.
  void forget_last();
  void begin(const StepState& x);
  bool go_on(StepState& x, LoadKick& loads, bool unsettled = false);
  void hold_on(StepState& x, LoadKick& loads);
  bool alike(const Lasting& part, const Lasting& was) const;
  Lasting second_part(const Lasting& was, const Lasting& first) const;
  void join_parts(double share, double rest, const Lasting& first);
  void go_on_as(const Lasting& mean);
  const double* end_without_impacts(const StepState& x) const {
    return impacts.empty() ? x.after.data() : without_impacts_.data();
  }
  void tell(FixedStep& out, double sign_before) const;
  double lasting_work(const StepState& x) const { return work_of_lasting(end_without_impacts(x)); }

  // x.after is about to be changed by impacts.
  void keep_end(const StepState& x) { without_impacts_ = x.after; }
  // Contact lasts from here on, or does not.
  void set_lasting(std::size_t i, bool lasts) {
    if (now.of[i].lasts != lasts) now.of[i].slip_sign = 0.0;
    now.of[i].lasts = lasts;
  }
  // The straight path of a step with the relative velocity leaves the circle.
  bool leaves(std::size_t i, const Eigen::Vector3d& velocity) const;

 private:
  // How the friction of a lasting contact is found: by the slip (Coulomb's set), or in a ratio to
  // the normal impulse.
  struct Friction {
    double bound = 0.0;  // mu
    bool given = false;
    double ratio = 0.0;
  };
  bool press(StepState& x, std::span<const std::size_t> lasting);
  bool whirls_too_far(std::span<const std::size_t> lasting) const;
  CoupledSolution solve_on_circles(std::span<const std::size_t> lasting,
                                   std::span<const Friction> friction) const;
  void note_lasting();

  Columns without_impacts_;                       // velocities at the step's end
  std::array<double, kMaxContacts> last_sign_{};  // of the slip, before the step
};

}  // namespace rotorub
