// The smooth system between events: free flight, sliding with a given sign, or sticking, as an
// ordinary differential equation in y = (q, qdot, integrals). In contact the multipliers follow
// from the constraints on acceleration level,
//
//   gddot_N = -e_r . d'' - v_t^2 / delta = 0,   gddot_T = e_t . d'' + r Omega_c' - R Omega_r' = 0
//                                                 (sticking; Omega_r of a ring that turns),
//   lambda_T = -mu sign lambda_N (sliding),
//
// v_t = e_t . d' the whirl speed; gdot_N = 0 has been used in gddot_T.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>

#include "native_model/contact/kinematics.h"
#include "native_model/event/contact_state.h"
#include "native_model/event/motion.h"
#include "native_model/system/model.h"

namespace rotorub {

// Of an instant that never comes, a bound that binds nothing.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Multipliers {
  double normal = 0.0, friction = 0.0;  // N, lambda_N, lambda_T
};

class Phase {
 public:
  explicit Phase(const Model& model);

  // What holds now.
  void set(const ContactState& state) { state_ = state; }
  const ContactState& state() const { return state_; }
  bool in_contact() const { return state_.mode != Mode::kFree; }

  // Sampled controllers and recorded commands: the command is held; otherwise it follows the state.
  void hold(const Eigen::Vector2d& command) { held_ = command; }
  Eigen::Vector2d command(double t, const double* y) const;
  // Of a sampled law, at its last sample (ActuatorState::outputs).
  using Outputs = std::array<double, kMostOutputs>;
  void show(const Outputs& outputs) { outputs_ = outputs; }
  const Outputs& outputs() const { return outputs_; }
  // The rates of the gap are summed up from here on, s.
  void first_touch(double t) { first_touch_ = t; }
  double first_touch() const { return first_touch_; }

  // y' = f(t, y). Multipliers and margins (infinite in free flight) are those of the last call. No
  // allocation.
  void derivative(double t, const double* y, double* dy);
  const Multipliers& multipliers() const { return multipliers_; }
  const Margins& margins() const { return margins_; }

  struct Contact {
    ContactPoint point;
    ContactAccelerations b;
  };
  Contact contact(double t, const double* y);

 private:
  void accelerate(double t, const double* q, const double* v, const Eigen::Vector2d& u);
  Contact contact_of(double t, const double* q, const double* v) const;

  const Model* model_;
  ContactState state_;
  Eigen::Vector2d held_{0.0, 0.0};
  Outputs outputs_{};
  double first_touch_;
  Multipliers multipliers_;
  Margins margins_;
  Eigen::VectorXd f_, a_;  // loads and accelerations
};

}  // namespace rotorub
