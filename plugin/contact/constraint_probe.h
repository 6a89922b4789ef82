// What MuJoCo's constraint solver answers to a load of the contact: its solver is run on a trial
// load within the forward pass, in mjcb_control, where rows and references of the step stand
// (equalities, limits, friction loss, tendons, other contacts). A Probe leaves in mjData nothing
// that the pass under way does not compute again; qacc_warmstart is put back, unless `keep` hands
// on the solution.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include <algorithm>
#include <span>

#include "plugin/contact/contact_space.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {

// Whether a row of the solver moves with the contact: J_row M^-1 J^T != 0. `but`: rows that do not
// count.
bool constraints_couple(const mjModel* m, mjData* d, const ContactSpace& space,
                        std::span<const int> but = {});

// mju_warning that no impulse was found beside them, with the names of those rows.
void warn_unsolved(const mjModel* m, mjData* d, const ContactSpace& space);

// After mj_fwdActuation and mj_fwdAcceleration. Lives on the stack of mjData.
class ConstraintProbe {
 public:
  ConstraintProbe(const mjModel* m, mjData* d);
  ~ConstraintProbe();
  ConstraintProbe(const ConstraintProbe&) = delete;
  ConstraintProbe& operator=(const ConstraintProbe&) = delete;

  // Tries the loads that add(force) adds to the generalised force; d->qacc is then that of the
  // solver.
  template <typename Add>
  void solve(Add add) {
    reset();
    add(d_->qfrc_smooth);
    run();
  }
  // Tries them as impulses alone, in no time: without the loads of the step and without forces of
  // the rows that have a bound. qacc is then the change by them.
  template <typename Add>
  void solve_sudden(Add add) {
    std::fill_n(d_->qfrc_smooth, count(m_->nv), 0.0);
    add(d_->qfrc_smooth);
    run_sudden();
  }
  // Of the last trial, in contact space, over the Euler step.
  Eigen::Vector3d acceleration(const ContactSpace& space);
  double accuracy() const;  // m/s^2, of the solver's tolerance

  // The last trial is what the pass will find: its solver starts from there.
  void keep() { kept_ = true; }

 private:
  void reset();
  void run();
  void run_sudden();

  const mjModel* m_;
  mjData* d_;
  StackFrame room_;
  int solved_;
  bool kept_ = false;
  mjtNum *force_, *warm_, *total_;  // qfrc_smooth, qacc_warmstart; the sum of a trial
  mjtNum* smooth_;                  // qacc_smooth
};

}  // namespace rotorub::plugin
