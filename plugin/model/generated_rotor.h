// The rotor of a generated model in MuJoCo: its state in the native model's coordinates, the loads
// that the joints of the modal chain do not have by themselves, and the parts that a user has
// added.
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
  double own_q_[kMaxCoordinates], own_v_[kMaxCoordinates];  // used if the order differs
};

// to[dof of i] += from[i].
inline void add_to_dofs(const Config& config, const double* from, mjtNum* to) {
  const auto n = static_cast<std::size_t>(config.model.nq());
  for (std::size_t i = 0; i < n; ++i) to[config.dof_address[i]] += from[i];
}

// Adds to d->qfrc_passive the loads that the modal chain's joints do not have by themselves:
// gyroscopic and circulatory terms, bearing dampers, unbalance, excitation, drive, and gravity on
// the modes.
//
// MuJoCo's Euler step solves (M + h D) dv = h f, with M and D diagonal here. Explicit gyroscopic
// forces would be unstable with the growth rate h g^2/2. Therefore the force handed to MuJoCo is
// the one that produces the velocity change of
//   (M(phi) + h D) dv = h (f - Omega G (v + dv/2)),
// with the gyroscopic part at the midpoint and the spin-bending coupling of unbalance in M(phi).
// The contact's own share of dv is not known yet, so it stays explicit in the gyroscopic term.
// d->qfrc_passive must contain the forces of the joints' springs and dampers.
void add_passive_force(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// Puts the geoms of the further contacts where the modes move the rotor. MuJoCo uses these places
// from its next pass on, so they are one step late.
void place_further_contacts(const Config& config, const mjModel* m, mjData* d,
                            const Coordinates& state);

// The diagonal of M + h D (nq values), which the model's integrator uses; M alone with RK4.
void step_mass(const Config& config, const mjModel* m, double* diagonal);

// Looks for parts that a user has added to the rotor or the ring of a generated model: equalities,
// limits, friction loss, tendons with either of these, contacts, and terms that MuJoCo steps
// implicitly beyond the dampers of the joints. The native step of `rigid` (contact/verlet.h) and
// the diagonal mass of `coulomb` do not include them. Such a model takes the general path
// (contact/pairs.h), which is of first order.
//
// If anything can act on a body of the kinematic trees of rotor and ring, this function takes the
// contact off the chain, and warns if the coupling of spin and bending is left out then. It throws
// ConfigError if there are several contacts. It does nothing for the cones, which MuJoCo solves
// together with the added parts.
void choose_path(const mjModel* m, Config& config);

// True if MuJoCo's step has further damping on the rotor or the ring. With the implicit integrators
// these are actuators whose force depends on the velocity (servos), damped tendons and fluid; with
// Euler too, these are dampers of joints that are not constant (contact/step_matrix.h). This may
// change when mjModel is edited (Config::damping_added).
bool damping_is_added(const mjModel* m, const Config& config);

}  // namespace rotorub::plugin
