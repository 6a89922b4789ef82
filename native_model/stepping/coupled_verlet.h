// One step of `verlet` with several contacts: the leapfrog of verlet_step.h.
//
//   1. Free velocities v_f from all loads, as there.
//   2. Contacts that last end the step on their circles (coupled_step.h).
//   3. Another contact's path leaves its circle: located, and every contact that is closed there
//      takes part in the impact. Of its jump w at the share theta this step takes (1 - theta) w,
//      the next the rest, and what the loads that depend on velocities miss. A resting contact that
//      it knocks open carries nothing from there on: the next step gives back (1/2 - theta) of its
//      step impulse.
//   4. Where a load or a command jumps within a step of lasting contact: as verlet_jumps.h.
#pragma once

#include "native_model/stepping/coupled_step.h"

namespace rotorub {

class CoupledVerlet : public CoupledStep {
 public:
  // From the model's initial state. The model must outlive it. step: s, > 0.
  CoupledVerlet(const Model& model, double step);

  FixedStep step(std::int64_t k, std::span<const Eigen::Vector2d> u, bool works) override;
  bool leaps() const override { return true; }
  void jump(std::size_t contact, const CommandJump& command) override;
  void velocity_now(std::int64_t k, std::span<const Eigen::Vector2d> held, double* v) override;
  const double* last_q() const override { return seen_.data(); }
  void last_velocity(double* v) const override;

 private:
  bool rebounds(const Contact& c, double approach, double pressed) const override;
  double begin_of(std::int64_t k) const;  // s, of its loads; they end at t_k + h/2
  void kick(std::int64_t k);
  // coupled_jumps.cc
  void split(double begin, double end, std::span<const Eigen::Vector2d> u);
  void take_part(std::span<const Eigen::Vector2d> u, double begin, double end);
  // coupled_impacts.cc
  void collide(std::int64_t k);
  std::size_t next_touch(std::span<bool> closed, double& theta);
  void knock_open(std::size_t contact, double theta);
  std::span<const Eigen::Vector2d> ring_forces(double t, std::span<Eigen::Vector2d> forces) const;
  double loads(double t, Columns& f) const;
  void apply_jump(double t, double theta);

  bool first_ = true, was_first_ = true;
  Columns late_;  // m/s, rad/s: what the last step left over
  // Of an impact: velocities of the step's middle and accelerations; velocities and coordinates of
  // its instant; its load or jump; loads before and after.
  Columns velocity_, acceleration_, at_, there_, jump_, before_, missed_;
  std::array<CommandJump, kMaxContacts> commands_{};  // of the step that comes
  // The contacts before the step, and what its mean and its first part make of them.
  std::vector<Contact> was_, mean_, part_;
  Columns mean_after_, part_after_;
  std::array<Eigen::Vector2d, kMaxContacts> d_;  // m, of each contact at that instant
};

}  // namespace rotorub
