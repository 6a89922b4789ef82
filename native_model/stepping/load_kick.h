// What all loads do in a fixed step: the velocity change that they give about one instant,
//
//   M(q) (v+ - v-) = h F(q, (v- + v+)/2, t) + J^T p,
//
// p the contacts' impulses (step_contacts.h). With A = M + h/2 D
// (velocity_matrix.h) the linear part is solved at once, v+ = v- + A^-1 (h F(q, v-) + J^T p); what
// depends on velocities beyond that (free spin with gyroscopics or unbalance, a motor's curve,
// coils, integrators, a magnetic bearing at its limit) is iterated. What a model lacks costs
// nothing.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "native_model/contact/most_contacts.h"
#include "native_model/model/equations.h"
#include "native_model/stepping/fixed_step.h"
#include "native_model/stepping/step_state.h"
#include "native_model/stepping/stepped_loads.h"
#include "native_model/stepping/velocity_matrix.h"

namespace rotorub {

class LoadKick {
 public:
  // The model must outlive this. h: s.
  LoadKick(const Model& m, double h);

  // The commands of the actuators over the step (model/actuation.h): the force on each ring, N, or
  // the currents of the two axes, A.
  using Commands = std::array<Eigen::Vector2d, kMaxContacts>;
  Commands command;
  const double* applied = nullptr;       // nq further loads, or none
  std::span<const CommandJump> jumps{};  // `command` has their means

  // A force that comes without a controller acts from here on.
  void drive_first_ring() { commanded_ = true; }
  // M(phi) changes from step to step.
  bool coupled() const { return matrix_.coupled(); }
  // What depends on velocities beyond the linear part: improve() is to be called.
  bool iterates() const { return iterates_; }

  // All that outlives a step, as plain numbers.
  template <class Action>
  void for_each_kept(Action& action) {
    for (std::size_t i = 0; coupled() && i < m_.unbalances.size(); ++i) {
      action(angles_.cosine[i]);
      action(angles_.sine[i]);
    }
    loads_.for_each_kept(action);
  }
  // Step numbers begin anew, or what is kept has been written.
  void forget() {
    loads_.forget();
    if (coupled()) matrix_.couple_at(angles_);
  }

  // x.start -> x.free, and x.after alike: the velocities that the loads of step k give, about the
  // instant t and at x.seen; begin (s): of the loads, they end at t + h/2. `later`: without what is
  // to be iterated; settle() or an iteration with the contact is to come.
  void free_velocity(StepState& x, std::int64_t k, double begin, double t, bool later = false);
  // The same as if what is switched on between begin and end had held for the whole step.
  void free_velocity_of_part(StepState& x, double begin, double end);

  // x.free iterated, and x.after alike.
  void settle(StepState& x);
  void begin_iteration() { rounds_ = 0; }
  // One round of the iteration: x.free from the forces at the middle of x.start and `end`, the
  // step's end with its contact. False once it has come to rest.
  bool improve(StepState& x, const double* end);

  // f <- A_0^-1 f, the part of A^-1 that does not change from step to step; and then what A^-1 has
  // beside it.
  void solve_uncoupled(double* f) { matrix_.solve_uncoupled(f); }
  void couple(double* f) const { matrix_.add(matrix_.coupled_part(f), f); }
  const VelocityMatrix& matrix() const { return matrix_; }

  // J: of the forces of F at the middle of the step from x.start to `end`, but those that energy
  // holds (springs, and with a free spin unbalance, which is inertial), over h.
  double external_work(const StepState& x, const double* end);

 private:
  using Coordinates = StepState::Coordinates;

  enum class Of { kAll, kWorking };
  void force(const StepState& x, const double* v, double* f, Of of = Of::kAll);
  void add_parts(const StepState& x, const double* v, double omega, bool all, double* f) const;
  void add_ring_forces(const StepState& x, const double* v, double* f) const;
  void weighed_free_velocity(StepState& x, double begin, double end, bool later);
  double noise(const StepState& x, const double* end) const;
  void find_round_off(double h);
  void find_samples(const StepState& x, double t, double begin);
  void add_samples(double* f) const;
  void find_working(const StepState& x, double begin, double end);
  void find_switched(const StepState& x, double begin, double end);

  const Model& m_;
  VelocityMatrix matrix_;
  SteppedLoads loads_;
  equations::DiscAngles angles_{};
  bool iterates_ = false, commanded_ = false;
  bool parts_ = false;               // there is a load of add_parts()
  bool rings_by_actuators_ = false;  // magnets, which drive the coils too, or several rings
  // Controls of magnetic bearings that are sampled at the instants of the loads.
  bool samples_ = false, sampled_now_ = false;
  std::vector<double> sampled_;  // N, what makes the jumps of the feedbacks' states
  struct AxisCommand {           // of a magnetic bearing, about a sample
    double before = 0.0, mean = 0.0, after = 0.0;  // A, as the equations see them: the mean
    // What the commands before and after the sample do, each over its share of the working time,
    // less what the mean command does over all of it: N, and A/s of an amplifier.
    double force = 0.0, rate = 0.0;
  };
  std::array<std::array<AxisCommand, 2>, scene::kMaxMagneticBearings> commands_{};
  // Share of the step for which each magnetic bearing has not failed.
  std::array<double, scene::kMaxMagneticBearings> working_{};
  Coordinates f_, change_;
  Coordinates seen_end_;  // the step's end of which the last round had the forces
  // Of a deflection q_i the least energy that a step can tell is (1e-15 h k_i)^2/m_i q_i^2.
  Coordinates round_off_;
  double magnets_round_off_ = 0.0;
  int rounds_ = 0;
  double instant_ = 0.0;  // s, of the loads
};

}  // namespace rotorub
