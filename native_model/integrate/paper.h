// The paper's time stepping (10)-(13) at a fixed step, with Poisson's impact law (15)-(19) on
// closing contacts. First order through impacts: they are not located within the step.
//
// (11) is taken at the midpoint, q_m = q + h/2 v, v+ from the loads at (t + h/2, q_m), then
// q+ = q_m + h/2 v+; the contact's normal is that at q_m and the gap that of the next midpoint.
// So a billiard keeps speed and angular momentum to round-off (the impulse is along q_m), and a
// sustained rub is the SHAKE scheme on the midpoints, which does not drift. Damping is implicit
// at the midpoint, the gyroscopic part a rotation.
#pragma once

#include <Eigen/Core>
#include <string>

#include "native_model/contact/impact.h"
#include "native_model/integrate/gyroscopic_rotation.h"
#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct PaperStep {
  Status status = Status::kOk;
  Mode mode = Mode::kFree;        // at the end of the step
  bool impact = false;            // Poisson's law was applied; `detail` holds it
  double normal_impulse = 0.0;    // N s over the step, impact and persistent contact alike
  double friction_impulse = 0.0;  // N s, on the rotor along e_t
  Impact detail;
};

class PaperStepper {
 public:
  // step: s, > 0. The model must outlive the stepper.
  PaperStepper(const Model& model, double step);

  // Empty, or why this step cannot work: beyond 2 / omega_max nothing is stable.
  std::string refusal() const;

  // One step of `state` under the actuator force u, held over it. No allocation.
  PaperStep step(State& state, const Eigen::Vector2d& u);

  bool in_contact() const { return in_contact_; }

 private:
  void project(double t);
  void free_velocity(const State& state, const Eigen::Vector2d& u);
  PaperStep contact(const State& state);
  PaperStep impact(const State& state, const Eigen::Vector2d& e_r, double closing_time);
  PaperStep persist(const State& state, const Eigen::Vector2d& e_r, double predicted_gap);
  void apply(const State& state, const double* diagonal, const Eigen::Vector2d& e_r, double normal,
             double friction);

  const Model* model_;
  double step_;
  GyroscopicRotation gyroscopic_;
  Eigen::VectorXd implicit_mass_;      // M + h/2 D, diagonal
  Eigen::VectorXd q_, v_, f_;          // midpoint, new velocity, loads
  Eigen::Matrix3d implicit_admittance_;
  Eigen::Vector3d start_velocity_;     // contact space, of the state before
  bool in_contact_ = false;
};

}  // namespace rotorub
