// The response of MuJoCo's constraints to a load of the contact. MuJoCo's solver is run on a trial
// load within the forward pass, in mjcb_control, where the rows and references of the step
// (equalities, limits, friction loss, tendons, other contacts) are already known. A probe changes
// nothing in mjData that the present pass does not compute again. It restores qacc_warmstart,
// unless `keep` passes on the solution.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include <algorithm>
#include <span>

#include "plugin/contact/contact_space.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

// True if a row of the solver is coupled to the contact: J_row M^-1 J^T != 0. `but`: rows that do
// not count; values below 0 are ignored.
bool constraints_couple(const mjModel* m, mjData* d, const ContactSpace& space,
                        std::span<const int> but = {});

// Issues a mju_warning that no impulse meets the contact laws with these rows, so that the one
// with the least error is taken, and names the rows.
void warn_unsolved(const mjModel* m, mjData* d, const ContactSpace& space);

// Make it after mj_fwdActuation and mj_fwdAcceleration. It uses the stack of mjData during its
// lifetime.
class ConstraintProbe {
 public:
  ConstraintProbe(const mjModel* m, mjData* d);
  ~ConstraintProbe();
  ConstraintProbe(const ConstraintProbe&) = delete;
  ConstraintProbe& operator=(const ConstraintProbe&) = delete;

  // Tries the loads that add(force) adds to the generalised force. d->qacc is then the solver's
  // result.
  template <typename Add>
  void solve(Add add) {
    std::copy_n(force_, m_->nv, d_->qfrc_smooth);
    add(d_->qfrc_smooth);
    run();
  }
  // Tries them as impulses in no time, without the loads of the step and without the bounded forces
  // of the rows (friction losses). add() adds impulse / h, so that h d->qacc is the change of the
  // velocities.
  template <typename Add>
  void solve_instant(Add add) {
    std::fill_n(d_->qfrc_smooth, count(m_->nv), 0.0);
    add(d_->qfrc_smooth);
    run_instant();
  }
  // The acceleration of the last trial in contact space, over MuJoCo's step (by H).
  Eigen::Vector3d acceleration(const ContactSpace& space);
  double accuracy() const;  // m/s^2, error of an acceleration by the solver's tolerance

  // Call it if the last trial is the solution of the pass: MuJoCo's solver then starts from it.
  void keep() { kept_ = true; }

 private:
  void run();
  void run_instant();

  const mjModel* m_;
  mjData* d_;
  StackFrame room_;
  int solved_;
  bool kept_ = false;
  const mjtNum *force_, *warm_, *smooth_;  // kept qfrc_smooth, qacc_warmstart and qacc_smooth
  mjtNum* total_;                          // the total force of a trial
};

}  // namespace rotorub::plugin
