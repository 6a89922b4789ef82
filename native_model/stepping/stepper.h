// One run of a model in fixed steps, by one of two schemes of the same equations:
// - verlet: leapfrog with located impacts, second order (verlet.h);
// - euler: the paper's own, first order (euler.h).
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "native_model/model/model.h"
#include "native_model/scene/run.h"
#include "native_model/stepping/fixed_step.h"

namespace rotorub {

// Not for two threads at once.
class FixedStepper {
 public:
  virtual ~FixedStepper() = default;

  // From t_k = t_0 + k step to t_{k+1}, under the commands u of the actuators, one for each
  // auxiliary bearing. k counts from 0, one by one. `works`: those of the result are wanted. No
  // allocation. With a status the state stays where it was.
  virtual FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) = 0;
  virtual const double* q() const = 0;  // of t_{k+1}, nq values
  virtual const double* v() const = 0;  // of t_{k+1}; of a leapfrog of t_{k+1/2}

  // A leapfrog: impacts of a step are those between t_k and t_{k+1}, all else is what acts about
  // t_k. The rest is for leapfrogs alone.
  virtual bool leaps() const { return false; }
  // The command of the step that comes jumps within it.
  virtual void jump(std::size_t, const CommandJump&) {}
  // Before step k: the velocities of t_k under the commands that hold and the contact forces of the
  // step before.
  virtual void velocity_now(std::int64_t, std::span<const Eigen::Vector2d>, double*) {}
  // After step k: the state of t_k, velocities before an impact of the step.
  virtual const double* last_q() const { return q(); }
  virtual void last_velocity(double*) const {}
};

// From the model's initial state. step: s, > 0. The model must outlive it.
std::unique_ptr<FixedStepper> make_stepper(scene::Integrator integrator, const Model& model,
                                           double step);

// A stepper whose whole state others can keep, as plain numbers.
class KeptStepper : public FixedStepper {
 public:
  // As newly made, from another state (nq values each) at time t. No allocation.
  virtual void begin(double t, const double* q, const double* v) = 0;
  // A stepper of the same model and step that restores what another one saved after step k takes
  // step k + 1 to the same bits as that one. A status is not among them; restoring ends it. No
  // allocation.
  virtual std::size_t memory_size() = 0;
  virtual void save(double* to) = 0;
  virtual void restore(const double* from) = 0;
  // Of the step that comes: the state at its begin in other numbers (those of who keeps it,
  // MuJoCo), and further loads (nq values, held over it; they must outlive it; null: none).
  virtual void adopt(const double* q, const double* v) = 0;
  virtual void apply(const double* loads) = 0;
  // The time that the last step's lasting forces are for, in steps: 1/2 for a leapfrog's first.
  virtual double last_kick() const = 0;
};

// By `verlet`, from the state at its own time. The model must outlive it. step: s, > 0.
std::unique_ptr<KeptStepper> make_kept_stepper(const Model& model, double step, const State& start);

// The same for a single actuator. The command of step k is its mean over (t_k - step/2, t_k +
// step/2); forces of the result are those about t_k, impacts those between t_k and t_{k+1}.
class VerletStepper {
 public:
  // From the model's initial state, or from another, at its own time. step: s, > 0.
  VerletStepper(const Model& model, double step)
      : VerletStepper(model, step, initial_state(model)) {}
  VerletStepper(const Model& model, double step, const State& start)
      : stepper_(make_kept_stepper(model, step, start)) {}

  FixedStep step(std::int64_t k, const Eigen::Vector2d& u = {0.0, 0.0}, bool works = false) {
    return stepper_->step(k, std::span(&u, 1), works);
  }
  const double* q() const { return stepper_->q(); }
  const double* v() const { return stepper_->v(); }
  // Of t_{k+1/2}: what the next impact does to it is not in it.
  const double* v_half() const { return stepper_->v(); }
  const double* last_q() const { return stepper_->last_q(); }
  void last_velocity(double* v) const { stepper_->last_velocity(v); }
  void velocity_now(std::int64_t k, const Eigen::Vector2d& held, double* v) {
    stepper_->velocity_now(k, std::span(&held, 1), v);
  }
  void jump(const CommandJump& command) { stepper_->jump(0, command); }
  double last_kick() const { return stepper_->last_kick(); }

  void begin(double t, const double* q, const double* v) { stepper_->begin(t, q, v); }
  void adopt(const double* q, const double* v) { stepper_->adopt(q, v); }
  void apply(const double* loads) { stepper_->apply(loads); }

  static std::size_t memory_size(const Model& model) {
    return VerletStepper(model, 1.0).stepper_->memory_size();
  }
  void save(double* to) const { stepper_->save(to); }
  void restore(const double* from) { stepper_->restore(from); }
  // The coordinates in a memory; the velocities follow them.
  static const double* saved_q(const double* memory) {
    constexpr std::size_t kBeforeState = 3;  // numbers before q, see stepper.cc
    return memory + kBeforeState;
  }

 private:
  std::unique_ptr<KeptStepper> stepper_;
};

}  // namespace rotorub
