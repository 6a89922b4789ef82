// One run of a model in fixed steps, by one of two schemes for the same equations:
// - verlet: leapfrog with located impacts, order 2 (verlet.h);
// - euler: the scheme of the paper, order 1 (euler.h).
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

// A stepper must not be used by two threads at once.
class FixedStepper {
 public:
  virtual ~FixedStepper() = default;

  // Steps from t_k = t_0 + k step to t_{k+1} under the commands u, one for each auxiliary bearing.
  // k counts from 0 without gaps. works: the result must contain the works. Does not allocate. With
  // a status other than kOk the state stays unchanged.
  virtual FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) = 0;
  virtual const double* q() const = 0;  // at t_{k+1}, nq values
  virtual const double* v() const = 0;  // at t_{k+1}; at t_{k+1/2} for a leapfrog

  // True for a leapfrog: the impacts of a step are those between t_k and t_{k+1}, and all other
  // results belong to t_k. The functions below are only for leapfrogs.
  virtual bool leaps() const { return false; }
  // Announces a jump of the command within the next step.
  virtual void announce_command_jump(std::size_t, const CommandJump&) {}
  // Call it before step k: the velocities at t_k under the held commands and the contact forces of
  // the step before.
  virtual void velocity_now(std::int64_t, std::span<const Eigen::Vector2d>, double*) {}
  // Call it after step k: the state at t_k, valid until the next step; the velocities do not
  // contain impacts of the step.
  virtual const double* last_q() const { return q(); }
  virtual const double* last_velocity() const { return v(); }
};

// Starts at the model's initial state. step: s, > 0. The model must outlive the stepper.
std::unique_ptr<FixedStepper> make_stepper(scene::Integrator integrator, const Model& model,
                                           double step);

class VerletStep;

// The stepper of `verlet`. The command of step k is its mean over (t_k - step/2, t_k + step/2).
// Forces in the result belong to t_k, impacts lie between t_k and t_{k+1}.
class VerletStepper final : public FixedStepper {
 public:
  // Starts at the model's initial state, or at another state at its time. step: s, > 0. The model
  // must outlive the stepper.
  VerletStepper(const Model& model, double step);
  VerletStepper(const Model& model, double step, const State& start);
  ~VerletStepper() override;

  FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) override;
  const double* q() const override;
  // Velocities at t_{k+1/2}; the part of a velocity jump that is deferred to the next step is not
  // included.
  const double* v() const override;
  bool leaps() const override { return true; }
  void announce_command_jump(std::size_t contact, const CommandJump& command) override;
  void velocity_now(std::int64_t k, std::span<const Eigen::Vector2d> held, double* v) override;
  const double* last_q() const override;
  const double* last_velocity() const override;
  // The duration in steps for which the last step's lasting forces act: 1/2 in the first step.
  double last_kick() const;

  // The same for a single actuator.
  FixedStep step(std::int64_t k, const Eigen::Vector2d& u = {0.0, 0.0}, bool works = false) {
    return step(k, std::span(&u, 1), works);
  }
  void velocity_now(std::int64_t k, const Eigen::Vector2d& held, double* v) {
    velocity_now(k, std::span(&held, 1), v);
  }
  void announce_command_jump(const CommandJump& command) { announce_command_jump(0, command); }

  // Restarts from another state (nq values each) at time t. Does not allocate.
  void begin(double t, const double* q, const double* v);
  // For the next step: adopt() replaces the state by other numbers for the same instant (as MuJoCo
  // keeps it), and apply() adds loads (nq values, held over the step; they must outlive it; null:
  // none).
  void adopt(const double* q, const double* v);
  void apply(const double* loads);

  // The complete state as plain numbers. A stepper of the same model and step that restores what
  // another one saved after step k takes step k + 1 with bitwise the same result. The status is not
  // saved; restore() resets it. save() and restore() do not allocate.
  static std::size_t memory_size(const Model& model);
  void save(double* to) const;
  void restore(const double* from);
  // The coordinates in a saved memory; the velocities follow them.
  static const double* saved_q(const double* memory) {
    constexpr std::size_t kBeforeState = 3;  // numbers that precede q (stepper.cc)
    return memory + kBeforeState;
  }

 private:
  void command(std::span<const Eigen::Vector2d> u);
  template <class Action>
  void visit_saved(Action action) const;

  std::unique_ptr<VerletStep> step_;
};

}  // namespace rotorub
