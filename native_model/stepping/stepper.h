// One run of a model with one contact or none in fixed steps, by one of two schemes of the same
// equations:
// - midpoint: the loads at the middle of the step, impacts not located; first order
//   (midpoint_step.h);
// - verlet: leapfrog with located impacts, second order (verlet_step.h).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <string>

#include "native_model/stepping/fixed_step.h"
#include "native_model/system/model.h"

namespace rotorub {

// Not for two threads at once.
class Stepper {
 public:
  ~Stepper();

  // FixedStepper::step, t_0 the start's time, under the actuator's command u (system/actuation.h).
  FixedStep step(std::int64_t k, const Eigen::Vector2d& u = {0.0, 0.0}, bool works = false);

  // As newly made, from another state (nq values each) at time t. No allocation.
  void begin(double t, const double* q, const double* v);

  const double* q() const;  // of t_{k+1}, nq values

  // The whole state as plain numbers: a stepper of the same model and step that restores it takes
  // step k + 1 to the same bits as the one that saved it after step k. A status is not among them;
  // restoring ends it. No allocation.
  void save(double* to) const;
  void restore(const double* from);
  // The coordinates in a memory; the velocities follow them.
  static const double* saved_q(const double* memory);

 protected:
  friend std::unique_ptr<FixedStepper> make_stepper(scene::Integrator, const Model&, double);
  struct Kernel;  // midpoint_step.h or verlet_step.h, of the model's size
  explicit Stepper(std::unique_ptr<Kernel> kernel);
  std::unique_ptr<Kernel> kernel_;
};

class MidpointStepper : public Stepper {
 public:
  // From the model's initial state, or from another, at its own time. step: s, > 0. The model must
  // outlive the stepper. The command is held over a step.
  MidpointStepper(const Model& model, double step);
  MidpointStepper(const Model& model, double step, const State& start);
  static std::size_t memory_size(const Model& model);

  const double* v() const;  // of t_{k+1}
};

class VerletStepper : public Stepper {
 public:
  // As MidpointStepper. The command of step k is its mean over (t_k - step/2, t_k + step/2); forces
  // of the result are those about t_k, impacts those between t_k and t_{k+1}.
  VerletStepper(const Model& model, double step);
  VerletStepper(const Model& model, double step, const State& start);
  static std::size_t memory_size(const Model& model);

  // Of the step that comes: the state at its begin in other numbers (those of who keeps it,
  // MuJoCo), and further loads (nq values, held over it; they must outlive it; null: none).
  void adopt(const double* q, const double* v_half);
  void apply(const double* loads);
  // The command of the step that comes jumps within it.
  void jump(const CommandJump& command);

  const double* v_half() const;  // of t_{k+1/2}: what the next impact does to it is not in it
  // Of FixedStepper.
  void velocity_now(std::int64_t k, const Eigen::Vector2d& held, double* v);
  const double* last_q() const;
  void last_velocity(double* v) const;
  // The time that the last step's lasting forces are for, in steps: 1/2 for the first, else 1.
  double last_kick() const;
};

}  // namespace rotorub
