// One step of `verlet`: leapfrog, order 2 through impacts, their accumulation and lasting contact.
// The velocity that goes with q_k is that of half a step before, v_{k-1/2}.
//
//   1. Kick: v' = v_{k-1/2} + what the last step's impacts left over; free velocity v_f = v_{k+1/2}
//      from all loads at (t_k, q_k), velocity-dependent ones at the mean of v' and v_f. The first
//      step is half a kick.
//   2. Contact: where the straight path q_k + h v_f stays in every ring nothing more is done. What
//      lasts ends the step on its circle, or presses into its wall (step_contacts.h). Where a load
//      or the command jumps within a step of lasting contact: split().
//   3. Impact: where a path leaves its circle out of flight, Poisson's law at that instant.
//   4. Drift: q_{k+1} = q_k + h v_{k+1/2}.
//
// Of the jump w of the velocities by an impact at the share theta of the step, this step takes
// (1 - theta) w, the next one the rest, and what the loads that depend on velocities miss of it,
// -(theta - 1/2) h M^-1 (F(v + w) - F(v)); without that term order 2 is lost. An impact that takes
// time (model/finite_impact.h) goes on over steps; flight is taken up again where it ends, at any
// share of a step.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "native_model/model/finite_impact.h"
#include "native_model/stepping/step_contacts.h"

namespace rotorub {

class VerletStep {
 public:
  // The model must outlive this. h: s.
  VerletStep(const Model& model, double h);

  StepState x;
  LoadKick loads;
  StepContacts contacts;

  // From t_k = origin + k h to t_{k+1}. With a status the state stays where it was.
  void step(std::int64_t k);
  // The velocities of t_k before step k: v_{k-1/2} + h/2 a(t_k-), with the command as it stands and
  // the contact force of the step before. For controllers, which see them before there is a
  // command.
  void velocity_now(std::int64_t k, double* now);
  // A state (q, v at one instant) has been written: the next step is half a kick.
  void restart();
  // The command of a ring jumps within the step that comes.
  void jump(std::size_t ring, const CommandJump& command);

  // The last step was half a kick.
  bool was_first() const { return was_first_; }
  // s, of an impact that takes time and began in the step; 0: none did.
  double impact_time() const { return impact_time_; }
  // N, normal and friction force at t_k of an impact that takes time.
  Eigen::Vector2d impact_force(std::int64_t k) const {
    return slow_impact_ ? slow_impact_->force(x.time_of(k)) : Eigen::Vector2d(0.0, 0.0);
  }
  // After step k: velocities of t_k, the mean of the two middles, just before an impact of the step
  // and before its samples.
  void last_velocity(double* now) const;
  // J, of the step's loads on the coordinates.
  double external_work();

  // All of the scheme that outlives a step beside state and contacts.
  template <class Action>
  void for_each_kept(Action& action) {
    keep_flag(first_, action);
    contacts.for_each_force_kept(action);
    keep_flag(owes_, action);
    for (double& value : late_) action(value);
    if (slow_impact_) slow_impact_->for_each_kept(action);
  }

 private:
  using Coordinates = StepState::Coordinates;
  struct Flight;

  void kick(std::int64_t k, bool later = false);
  void halve_kick();

  double share_before_jump(double begin, double end);
  void split(double share, double begin, double end);
  void take_part(const StepContacts::State& was, double begin, double end);
  void command_part(bool before, double share);
  void forget_jumps();

  void collide(std::int64_t k);
  std::size_t next_touch(Flight& flight) const;
  void knock_open(std::size_t contact, Flight& flight);
  void take_jump(const Flight& flight, double t, const double* q, double* jump);
  void begin_slow_impact(std::int64_t k, const Flight& flight);
  void follow_slow_impact(std::int64_t k);

  Coordinates late_;                  // m/s, rad/s: what the last step left over
  bool first_ = true, owes_ = false;  // the next step is half a kick; `late_` holds something
  bool was_first_ = true;
  // J, of the impacts of the step: what the mean of the step's velocities misses of the loads'
  // work.
  double late_work_ = 0.0;

  bool switches_ = false;  // a load is switched at some time
  // s, the next such time after switch_from_.
  double switch_from_ = std::numeric_limits<double>::infinity(), switch_at_ = 0.0;
  bool command_jumps_ = false;  // in the step that comes
  std::array<CommandJump, kMaxContacts> jumps_;
  // Of a step in parts: contact before it; x.after of the mean loads, of the parts.
  StepContacts::State before_parts_;
  Coordinates mean_after_, part_sum_;

  std::optional<FiniteImpact> slow_impact_;  // of one contact alone
  bool held_open_ = false;                   // it is under way
  double impact_time_ = 0.0;
  double last_time_ = 0.0;  // s, of the last step, from the origin
};

}  // namespace rotorub
