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
#include <cstddef>
#include <memory>
#include <string>

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

// Empty, or why a fixed step cannot work: beyond 2 / omega_max nothing is stable.
std::string step_refusal(const Model& model, double step);
// "step ... s is not below 2 / omega_max = ... s".
std::string step_beyond(double step, double limit);

class PaperStepper {
 public:
  // From the model's initial state, or from another, at its own time. step: s, > 0. The model must
  // outlive the stepper.
  PaperStepper(const Model& model, double step);
  PaperStepper(const Model& model, double step, const State& start);
  ~PaperStepper();

  // From t = t_0 + k step to t_0 + (k + 1) step, t_0 the start's time, under the actuator's command u
  // (system/actuation.h), held over it. k counts from 0, one by one. No allocation. With a status the
  // state stays where it was.
  PaperStep step(std::int64_t k, const Eigen::Vector2d& u = {0.0, 0.0});

  // As newly made, from another state (nq values each) at time t. No allocation.
  void begin(double t, const double* q, const double* v);

  const double* q() const;  // nq each
  const double* v() const;

  // The whole state as plain numbers: a stepper of the same model and step that restores it takes
  // step k + 1 to the same bits as the one that saved it after step k. A status is not among them;
  // restoring ends it. No allocation.
  static std::size_t memory_size(const Model& model);
  void save(double* to) const;
  void restore(const double* from);
  // The coordinates in a memory; the velocities follow them.
  static const double* saved_q(const double* memory);

 private:
  struct Kernel;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace rotorub
