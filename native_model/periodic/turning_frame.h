// The frame that turns with the loads. In a machine that looks the same from all directions, and
// whose loads all turn at one speed Omega, nothing depends on time in the frame that turns with
// them. There a motion may repeat with a period of its own,
//
//   x(t + T) = R(Omega T) x(t),   R: turn about the axis,
//
// for example bouncing by internal resonance (Shaw, Champneys and Friswell 2016). At rest, such a
// motion has two frequencies.
#pragma once

#include <Eigen/Core>

#include "native_model/model/model.h"

namespace rotorub::periodic {

class TurningFrame {
 public:
  TurningFrame() = default;  // at rest
  // The frame that turns with the loads of the model; at rest if there is none. The model must
  // outlive this object.
  explicit TurningFrame(const Model& model);

  double speed() const { return speed_; }  // rad/s, Omega; 0: at rest
  bool turns() const { return speed_ != 0.0; }
  // y = (q, v), 2 nq values, after `duration` (s) as the frame shows it.
  Eigen::VectorXd seen(const Eigen::VectorXd& y, double duration) const;
  // y' as the frame shows it, where it coincides with the frame at rest.
  Eigen::VectorXd slope_seen(const Eigen::VectorXd& y, const Eigen::VectorXd& slope) const;

 private:
  Eigen::VectorXd turned(const Eigen::VectorXd& y, double angle) const;
  bool is_symmetric(const Model& model) const;

  double speed_ = 0.0;
  Layout layout_{};
};

}  // namespace rotorub::periodic
