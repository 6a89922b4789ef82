// The rotor of a generated model in MuJoCo: its state in the native model's coordinates, what the
// joints of the modal chain do not have by themselves, and what a user has put on it.
#pragma once

#include <mujoco/mujoco.h>

#include "plugin/model/config.h"

namespace rotorub::plugin {

// The state of an mjData in the order of the native layout.
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

// What the modal chain's joints do not have by themselves, as passive forces: gyroscopic and
// circulatory terms, bearing dampers, unbalance, excitation, drive, gravity on the modes.
//
// MuJoCo's Euler step solves (M + h D) dv = h f, M and D diagonal here. Explicit gyroscopic forces
// would feed h g^2/2; instead the force handed over is that which gives the velocity change of
//   (M(phi) + h D) dv = h (f - Omega G (v + dv/2)),
// the gyroscopic part at the midpoint and the spin-bending coupling of unbalance in M(phi). The
// contact's own share of dv is not known yet; it is left explicit in the gyroscopic term.
// Adds to d->qfrc_passive, which holds the joints' springs and dampers.
void add_passive_force(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// Puts the geoms of the contacts beyond the first where the modes move the rotor: in MuJoCo's next
// pass they are there, a step late.
void place_contacts_beside(const Config& config, const mjModel* m, mjData* d,
                           const Coordinates& state);

// The diagonal of M + h D (nq values) that the model's integrator solves with; M alone for RK4.
void step_mass(const Config& config, const mjModel* m, double* diagonal);

// What a user has put on the rotor or the ring of a generated model beside what the writer wrote:
// equalities, limits, friction loss, tendons with either, contacts, and what MuJoCo steps
// implicitly beyond the dampers of the joints. The native step of `rigid` (contact/verlet.h) and
// the diagonal mass of `coulomb` know none of it; such a model takes the general path
// (contact/pairs.h), of first order.
//
// Takes the contacts off the chain where anything can act on a body of the kinematic trees of rotor
// and ring, and warns of what is left out then. `cone` is MuJoCo's own, and knows them.
void choose_path(const mjModel* m, Config& config);

// With `implicit` actuators whose force has a rate (servos), damped tendons, fluid; dampers of
// joints that are no constant with Euler too (contact/step_matrix.h). May change with mjModel:
// Config::damping_added.
bool damping_is_added(const mjModel* m, const Config& config);

}  // namespace rotorub::plugin
