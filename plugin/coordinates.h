// The state of an mjData in the order of the native layout.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/config.h"

namespace rotorub::plugin {

class Coordinates {
 public:
  Coordinates(const Config& config, const mjData* d) {
    if (config.same_order) {
      q_ = d->qpos;
      v_ = d->qvel;
      return;
    }
    const auto n = static_cast<std::size_t>(config.model.nq());
    if (config.segments) {
      native_position(*config.segments, config.model, d->qpos, own_q_);
      native_velocity(*config.segments, config.model, d->qvel, own_v_);
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (config.qpos_address[i] < 0) continue;
      own_q_[i] = d->qpos[config.qpos_address[i]];
      own_v_[i] = d->qvel[config.dof_address[i]];
    }
    q_ = own_q_;
    v_ = own_v_;
  }
  Coordinates(const Coordinates&) = delete;
  Coordinates& operator=(const Coordinates&) = delete;

  const double* q() const { return q_; }
  const double* v() const { return v_; }

 private:
  const double* q_;
  const double* v_;
  double own_q_[kMaxCoordinates], own_v_[kMaxCoordinates];  // used where the order differs
};

// to[dof of i] += from[i].
inline void add_to_dofs(const Config& config, const double* from, mjtNum* to) {
  const auto n = static_cast<std::size_t>(config.model.nq());
  for (std::size_t i = 0; i < n; ++i) to[config.dof_address[i]] += from[i];
}

}  // namespace rotorub::plugin
