// One step of `verlet`: a leapfrog with order 2 also through impacts, their accumulation and
// lasting contact. The velocity that belongs to q_k is v_{k-1/2}, half a step earlier.
//
// A kick changes the velocities over t_{k-1/2} to t_{k+1/2}, a drift the coordinates over t_k to
// t_{k+1}.
//
//   1. Kick: v' = v_{k-1/2} + the velocity change that the last step's impacts deferred. All loads
//      at (t_k, q_k) lead to the free velocity v_f = v_{k+1/2}; loads that depend on velocities are
//      taken at the mean of v' and v_f. The first step is half a kick.
//   2. Contact: if the straight path q_k + h v_f stays inside every ring, nothing else happens. A
//      lasting contact ends the step on its circle, or penetrates its wall (step_contacts.h). If
//      a load or the command jumps within a step of lasting contact, the step is taken in two parts
//      (take_in_two_parts()).
//   3. Impact: if the path of a contact in flight leaves its circle, Poisson's law applies at that
//      instant to all contacts that are closed there (shared_impact.h). The flight goes on from
//      there, and may lead to a further impact in the same step.
//   4. Drift: q_{k+1} = q_k + h v_{k+1/2}.
//
// An impact at the fraction theta of the step causes the velocity jump w. This step takes (1 -
// theta) w, and the rest is deferred to the next one. The kicks do not include how w changes the
// velocity-dependent loads, so the next step also takes -(theta - 1/2) h M^-1 (F(v + w) - F(v));
// without this term order 2 would be lost. An impact that takes time (model/finite_impact.h)
// continues over several steps. Flight resumes where it ends, at any fraction of a step.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "native_model/model/finite_impact.h"
#include "native_model/stepping/step_contacts.h"

namespace rotorub {

class VerletStep {
 public:
  // The model must outlive this object. h: s.
  VerletStep(const Model& model, double h);

  StepState state;
  LoadKick loads;
  StepContacts contacts;

  // Steps from t_k = origin + k h to t_{k+1}. With a status other than kOk the coordinates and
  // velocities stay unchanged, and only restart() may follow.
  void step(std::int64_t k);
  // The velocities at t_k before step k: v_{k-1/2} + h/2 a(t_k-), with the present command and the
  // contact force of the step before. Controllers need them before there is a new command.
  // v: output, nq values.
  void velocity_now(std::int64_t k, double* v);
  // Call it after velocity_now() if the state or the loads have been changed since: the step then
  // computes its kick anew instead of taking it over.
  void discard_precomputed_kick() { precomputed_at_ = kNoStep; }
  // Call it after a state (q, v at one instant) has been written: the next step is half a kick.
  void restart();
  // Announces a jump of the command of a ring within the next step.
  void announce_command_jump(std::size_t ring, const CommandJump& command);

  // s, duration of an impact that takes time and began in the step; 0: there was none.
  double impact_time() const { return impact_time_; }
  // N, (normal, friction) force at t_k of an impact that takes time.
  Eigen::Vector2d impact_force(std::int64_t k) const {
    return finite_impact_ ? finite_impact_->force(state.time_of(k)) : Eigen::Vector2d(0.0, 0.0);
  }
  // After step k: the mean of the velocities at the two ends of its kick, before an impact of the
  // step; nq values. Computed once per step.
  const double* mean_velocity();
  // After step k: the velocities at t_k, before an impact of the step. They are mean_velocity(),
  // except in a first step and in an impact that takes time. States of sampled controllers keep
  // their values from before a sample at t_k. nq values, valid until the next step.
  const double* last_velocity();
  // J, works of the step's loads and of its lasting contacts on the coordinates.
  double external_work();
  double lasting_work() { return contacts.lasting_work(mean_velocity()); }

  // Calls action for the numbers of a saved step that are neither in the state nor visited by
  // visit_saved() of the loads and the contacts.
  template <class Action>
  void visit_saved(Action& action) {
    visit_flag(first_, action);
    contacts.visit_saved_forces(action);
    visit_flag(has_deferred_, action);
    for (double& value : deferred_) action(value);
    if (finite_impact_) finite_impact_->visit_saved(action);
  }

 private:
  using Coordinates = StepState::Coordinates;
  struct Flight;

  const double* deferred_or_null() const { return has_deferred_ ? deferred_.data() : nullptr; }
  bool iterates_with_contact() const;
  void kick(std::int64_t k, bool defer_iteration);
  void halve_kick();

  double share_before_jump(double begin, double end);
  void take_in_two_parts(double share, double begin, double end);
  void take_part(const StepContacts::States& at_start, double begin, double end);
  void set_command_of_part(bool before_jump, double share);
  void forget_command_jumps();

  void solve_impacts(std::int64_t k);
  std::optional<std::size_t> advance_to_touch(Flight& flight) const;
  void open_by_impact(std::size_t contact, Flight& flight);
  void apply_impulses(Flight& flight, double t, const double* q, const double* impulses);
  void begin_finite_impact(std::int64_t k, const Flight& flight);
  void follow_finite_impact(std::int64_t k);

  bool was_first() const { return state.kick_length < 1.0; }

  Coordinates deferred_;                      // m/s, rad/s: deferred by the last step
  Coordinates mean_v_, last_v_;               // see mean_velocity() and last_velocity()
  bool has_mean_ = false;                     // mean_v_ belongs to the last step
  bool first_ = true, has_deferred_ = false;  // the next step is half a kick; deferred_ is in use
  // J, the work of the loads that the mean of the step's velocities misses because of impacts.
  double work_correction_ = 0.0;

  // The step whose free velocities v_end holds since velocity_now(), and their commands.
  static constexpr std::int64_t kNoStep = -1;
  std::int64_t precomputed_at_ = kNoStep;
  LoadKick::Commands precomputed_commands_;

  bool switches_ = false;  // some load is switched during a run
  // s; a cache: no load is switched from switch_from_ until switch_at_.
  double switch_from_ = std::numeric_limits<double>::infinity(), switch_at_ = 0.0;
  bool has_command_jumps_ = false;  // in the step that comes or is under way
  std::array<CommandJump, kMaxContacts> command_jumps_;
  // For a step in two parts: the contacts before the step; v_end under the mean loads; the weighted
  // sum of v_end of the parts.
  StepContacts::States states_before_;
  Coordinates mean_v_end_, part_sum_;

  std::optional<FiniteImpact> finite_impact_;  // only for a single contact
  bool in_finite_impact_ = false;              // such an impact was under way at t_k
  double impact_time_ = 0.0;
  double finite_impact_step_ = 0.0;  // s, start of the last step of such an impact, from the origin
};

}  // namespace rotorub
