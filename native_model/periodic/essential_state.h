// The part of the state that determines a motion. Some entries of y = (q, v) do not act back on any
// other: the spin angle if no load or eccentricity is fixed to the rotor, the angle of a ring that
// turns, the coordinates whose rates are the states (bristles, integrators, coils; see
// model/model.h), and clocks in the memory of a sampled controller. A motion is periodic if all
// other entries return.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/model/model.h"

namespace rotorub::periodic {

class EssentialState {
 public:
  explicit EssentialState(const Model& model);

  Eigen::Index size() const { return static_cast<Eigen::Index>(entries_.size()); }
  // Indices in y = (q, v), 2 nq values.
  const std::vector<int>& entries() const { return entries_; }
  // The index of the spin angle among the entries; kAbsent if the angle is not essential.
  int spin_angle() const { return spin_angle_; }
  Eigen::VectorXd take(const double* y) const;

  // Sizes of all 2 nq entries of y, > 0, in the units of y, from typical states `motion` of 2 nq
  // values each: the clearance, or the largest displacement if it is larger; the largest speed of
  // displacements; 1 rad and the largest angular speed; and the largest value of each other state.
  // The memory of a sampled controller that is not essential has an infinite size.
  static Eigen::VectorXd sizes(const Model& model, const std::vector<const double*>& motion);
  // Memory of sampled controllers may be near 0 in the whole motion. Its sizes become at least what
  // the next sample after t (s) at y (2 nq) makes of changes of the other states by their sizes.
  static void widen_control_states(const Model& model, double t, const std::vector<double>& y,
                                   Eigen::VectorXd& sizes);

 private:
  std::vector<int> entries_;
  int spin_angle_ = kAbsent;
};

// True if a load or an eccentricity is fixed to a rotor whose spin is free, so that the spin angle
// acts on the motion.
bool spin_angle_acts(const Model& model);

}  // namespace rotorub::periodic
