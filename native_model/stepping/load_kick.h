// The change of velocities by all loads over a fixed step about one instant,
//
//   M(q) (v+ - v-) = h F(q, (v- + v+)/2, t) + J^T p,
//
// with the impulses p of the contacts (step_contacts.h). With A = M + h/2 D (velocity_matrix.h) the
// linear part is solved directly, v+ = v- + A^-1 (h F(q, v-) + J^T p). Other dependence on
// velocities is iterated: a free spin with gyroscopics or unbalance, the curve of a motor, coils,
// integrators, a magnetic bearing at its limit. Parts that a model does not have cost nothing.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "native_model/contact/contact_list.h"
#include "native_model/model/equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/step_state.h"
#include "native_model/stepping/stepped_loads.h"
#include "native_model/stepping/velocity_matrix.h"

namespace rotorub {

class LoadKick {
 public:
  // The model must outlive this object. h: s.
  LoadKick(const Model& m, double h);

  // The commands of the actuators over the step (model/actuation.h): the force on each ring, N, or
  // the currents of the two axes, A.
  using Commands = std::array<Eigen::Vector2d, kMaxContacts>;
  Commands command;
  const double* applied = nullptr;               // nq further loads; null: none
  std::span<const CommandJump> command_jumps{};  // `command` then holds the means

  // Lets the command of the first ring act even if the ring has no controller.
  void drive_first_ring() { commanded_ = true; }
  // True if M(phi) changes from step to step.
  bool coupled() const { return matrix_.coupled(); }
  // True if a load depends on velocities beyond the linear part, so that iterate_once() must be
  // called.
  bool needs_iteration() const { return needs_iteration_; }

  // Calls action for every number that must be saved between steps.
  template <class Action>
  void visit_saved(Action& action) {
    for (std::size_t i = 0; coupled() && i < m_.unbalances.size(); ++i) {
      action(angles_.cosine[i]);
      action(angles_.sine[i]);
    }
    loads_.visit_saved(action);
  }
  // Call it when the step numbers start again, or after the saved numbers have been written.
  void forget() {
    loads_.forget();
    if (coupled()) matrix_.couple_at(angles_);
  }

  // Computes v_free, and v_end equal to it, from v_start: the velocities after the loads of step
  // k, taken at the instant t and at q_k, have acted over h. Switched loads count as they act from
  // `begin` (s) to t + h/2.
  // defer_iteration: omits the iteration, because iterate() or an iteration together with the
  // contact follows.
  void free_velocity(StepState& state, std::int64_t k, double begin, double t,
                     bool defer_iteration = false);
  // The same for a whole step in which the switched loads act as they do between `begin` and `end`.
  void free_velocity_of_part(StepState& state, double begin, double end);

  // Changes v_free of this step from the commands `before` to the present commands; v_end is then
  // equal to it. Returns false, and changes nothing, if the commands act on more than the
  // velocities of their rings.
  bool exchange_commands(StepState& state, const Commands& before);

  // Iterates v_free; v_end is then equal to it.
  void iterate(StepState& state);
  // kick: duration of the kick, in steps.
  void begin_iteration(double kick) {
    kick_ = kick;
    rounds_ = 0;
  }
  // One round of the iteration: v_free from the forces at the mean of v_start and `end`, the
  // velocities at the end of the step with contact. Returns false when it has converged or failed.
  bool iterate_once(StepState& state, const double* end);

  // f <- A_0^-1 f, the part of A^-1 that is the same in all steps.
  void solve_uncoupled(double* f) { matrix_.solve_uncoupled(f); }
  const VelocityMatrix& matrix() const { return matrix_; }

  // J, work over h of the forces F at the velocities `mean`, the mean over the step. It excludes
  // forces that the stored energy contains (springs and, with a free spin, unbalance, which is
  // inertial). If the velocities were iterated, it takes the forces of the last round.
  double external_work(const StepState& state, const double* mean);
  // Call it if the velocities are changed otherwise after the iteration.
  void forget_forces() { forces_known_ = false; }

 private:
  using Coordinates = StepState::Coordinates;

  enum class Forces { kAll, kWorking };
  void force(const StepState& state, const double* v, double* f, Forces which = Forces::kAll);
  void add_parts(const StepState& state, const double* v, double omega, bool all, double* f) const;
  void add_ring_forces(const StepState& state, const double* v, double* f) const;
  void weighed_free_velocity(StepState& state, double begin, double end, bool defer_iteration);
  double noise(const StepState& state, const double* end) const;
  void find_round_off(double h);
  // Magnetic bearings (sampled_bearings.cc).
  void find_samples(const StepState& state, double t, double begin);
  void add_samples(double* f) const;
  void find_working(const StepState& state, double begin, double end);
  void find_switched(const StepState& state, double begin, double end);

  const Model& m_;
  VelocityMatrix matrix_;
  SteppedLoads loads_;
  equations::DiscAngles angles_{};
  bool needs_iteration_ = false, commanded_ = false;
  bool parts_ = false;               // add_parts() has something to add
  bool rings_by_actuators_ = false;  // magnets, which also drive the coils, or several rings
  // The commands are forces, and no load depends on the velocity of a ring beyond the matrix.
  bool commands_move_rings_alone_ = false;
  // Controls of magnetic bearings that are sampled at the instants of the loads.
  bool samples_ = false, sampled_now_ = false;
  std::vector<double> sampled_;  // N, loads that make the states of the feedbacks jump
  struct AxisCommand {           // of a magnetic bearing, around a sample
    double before = 0.0, mean = 0.0, after = 0.0;  // A; the equations use the mean
    // The effect of the commands before and after the sample, each over its share of the working
    // time, minus the effect of the mean command over all of it: N, and A/s with an amplifier.
    double force = 0.0, rate = 0.0;
  };
  std::array<std::array<AxisCommand, 2>, scene::kMaxMagneticBearings> commands_{};
  // Fraction of the step in which each magnetic bearing works.
  std::array<double, scene::kMaxMagneticBearings> working_{};
  Coordinates f_, change_;
  Coordinates forces_;         // F of the last round of the iteration
  bool forces_known_ = false;  // and at the velocities of the step
  Coordinates last_end_;       // velocities at the end of the step, used by the last round
  // (1e-15 h k_i)^2/m_i: times q_i^2 this is the least energy that a step resolves at a deflection
  // q_i.
  Coordinates round_off_;
  double magnets_round_off_ = 0.0;
  double kick_ = 1.0;  // duration of the kick that is being computed, in steps
  int rounds_ = 0;
  double instant_ = 0.0;  // s, instant of the loads
};

}  // namespace rotorub
