// What MuJoCo's constraint solver answers to a load of the contact: its solver is run on a trial
// load within the forward pass, in mjcb_control, where rows and references of the step stand
// (equalities, limits, friction loss, tendons, other contacts). A Probe leaves in mjData nothing
// that the pass under way does not compute again; qacc_warmstart is put back, unless `keep` hands
// on the solution.
#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>

#include "plugin/contact/contact_space.h"
#include "plugin/contact/rigid_law.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

// Whether a row of the solver moves with the contact: J_row M^-1 J^T != 0. `but`: a row that does
// not count, or -1.
bool constraints_couple(const mjModel* m, mjData* d, const ContactSpace& space, int but = -1);

// mju_warning that no impulse was found beside them, with the names of those rows.
void warn_unsolved(const mjModel* m, mjData* d, const ContactSpace& space);
// The same, that the contact is solved without them.
void warn_unknown(const mjModel* m, mjData* d, const ContactSpace& space);

// After mj_fwdActuation and mj_fwdAcceleration. Lives on the stack of mjData.
class ConstraintProbe {
 public:
  ConstraintProbe(const mjModel* m, mjData* d, const ContactSpace& space);
  ~ConstraintProbe();
  ConstraintProbe(const ConstraintProbe&) = delete;
  ConstraintProbe& operator=(const ConstraintProbe&) = delete;

  // Contact-space acceleration over the Euler step under a force load (x, y, torque) on the rotor,
  // of add_load or, `impact`, of add_impact. d->qacc is that of the solver.
  Eigen::Vector3d acceleration(const Eigen::Vector3d& load, bool impact);
  double accuracy() const;  // m/s^2, of the solver's tolerance

  // The last trial is what the pass will find: its solver starts from there.
  void keep() { kept_ = true; }

 private:
  const mjModel* m_;
  mjData* d_;
  const ContactSpace& space_;
  StackFrame room_;
  int solved_;
  bool kept_ = false;
  mjtNum *force_, *warm_, *total_;  // qfrc_smooth, qacc_warmstart; room
  mjtNum* smooth_;                  // qacc_smooth
};

// The response of rigid_law.h: impulses over the step as forces.
class ProbedStep final : public StepResponse {
 public:
  ProbedStep(ConstraintProbe& probe, const Eigen::Vector3d& start, double h)
      : probe_(probe), start_(start), h_(h) {}
  Eigen::Vector3d end(const Eigen::Vector3d& load, bool impact) override {
    return start_ + h_ * probe_.acceleration(load / h_, impact);
  }
  double accuracy() const override { return h_ * probe_.accuracy(); }

 private:
  ConstraintProbe& probe_;
  Eigen::Vector3d start_;
  double h_;
};

}  // namespace rotorub::plugin
