// The contact of a generated model on the modal chain in contact space: J constant, the mode values
// at the contact; M(phi) and M(phi) + h D by the native model, where unbalance and a drive couple
// spin and bending. MuJoCo's own matrix, H0, is diagonal: a load p that is to act through M(phi) +
// h D is handed over as H0 (M(phi) + h D)^-1 p.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"
#include "plugin/contact/contact_space.h"

namespace rotorub::plugin {

// Lives on the stack of mjData for as long as the object does.
class ChainSpace final : public ContactSpace {
 public:
  ChainSpace(const Config& config, const mjModel* m, mjData* d, const StepMatrix& matrix);

  // Of MuJoCo's forces, which have been through H0 (M(phi) + h D)^-1 already (passive.h).
  Eigen::Vector3d response(const mjtNum* f) const override;
  // With the masses of the native model: MuJoCo's links weigh a little.
  Eigen::Vector3d smooth() const override { return product(plain_, d_->qfrc_smooth); }
  void add_side(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
                mjtNum* to) const override;
  void add_side_acceleration(const Eigen::Vector3d& normal, const Eigen::Vector3d& friction,
                             mjtNum* to) const override;

 private:
  const Config& config_;
  StackFrame room_;
  mjtNum* step_mass_;  // nq
};

}  // namespace rotorub::plugin
