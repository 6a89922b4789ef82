// An impact with compression and expansion times, (15)-(19). The loads of the instant of touch keep
// acting. In each phase of duration tau the velocities change linearly from v_0 to
//
//   v_1 = v_0 + tau a + M^-1 W p,     p: (normal, friction) impulses, a: acceleration by the loads,
//
// and the coordinates move with v_1: q = q_t + tau_C qdot_C + tau_E qdot_E. The work of a phase has
// three parts: the work of the loads between v_0 and v_0 + tau a; the work of the impulse between
// v_0 + tau a and v_1; and the growth of the stored energy along the path, because the path follows
// v_1 while the spring forces are held constant. `event` and `verlet` use this class.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <vector>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"
#include "native_model/model/constraint.h"
#include "native_model/numerics/status.h"

namespace rotorub {

class FiniteImpact {
 public:
  // The model must have a contact and must outlive this object.
  explicit FiniteImpact(const Model& model);

  // Begins the impact at the touch at t (s), with the command that holds there. follows: a
  // continuous controller sets a new command at the end. If the status is not kOk, no impact
  // begins.
  Status begin(double t, const double* q, const double* v, const Eigen::Vector2d& command,
               bool follows);
  void cancel() { active_ = end_ = 0.0; }
  bool active() const { return active_ > 0.0; }  // begun and not finished

  double end() const { return end_; }  // s
  // The motion at t in [touch, end], nq values each.
  void coordinates(double t, double* q) const;
  void velocities(double t, double* v) const;
  Eigen::Vector2d force(double t) const;  // N, normal and friction; 0 outside the impact

  const Impact& record() const { return record_; }
  // J, over the whole impact, of all forces except the springs and the contact.
  double external_work() const { return external_work_; }
  double power_at_touch() const { return power_at_touch_; }  // W
  double power_at_end() const { return power_at_end_; }

  // Phase 0 is the compression, 1 the expansion.
  static constexpr std::size_t kPhases = 2;
  double begin_of(std::size_t phase) const { return phase == 0 ? touch_ : middle_; }  // s
  double duration(std::size_t phase) const;
  // N, mean contact force of the phase: its impulses divided by its duration.
  Eigen::Vector2d phase_force(std::size_t phase) const;
  // Velocities at the start and at the end of a phase, nq values each.
  const double* from(std::size_t phase) const {
    return (phase == 0 ? v_ : after_compression_).data();
  }
  const double* to(std::size_t phase) const {
    return (phase == 0 ? after_compression_ : after_).data();
  }
  // Impulses and work of the first `dt` (s) of a phase.
  struct Part {
    double normal, friction;  // N s
    // m/s, (gdot_N, gdot_T) before and after the impulse, along the normal at the touch.
    Eigen::Vector2d before, after;
    double external_work;  // J, of all forces except the springs and the contact
  };
  Part part(std::size_t phase, double dt) const;
  // m/s, (gdot_N, gdot_T) of the velocities v, along the normal at the touch.
  Eigen::Vector2d rates(const double* v) const;

  // The end of the impact: coordinates, velocities and accelerations by the loads, nq values each,
  // valid until the next impact begins; and whether contact lasts from there on.
  struct End {
    const double *q, *v, *a;
    bool lasts;
  };
  // Ends the impact.
  End finish();
  // J, of the projection back onto the circle, which the straight path has left; not work of the
  // contact.
  double landing_work() const { return landing_work_; }
  bool is_inside() const { return inside_; }  // at the end: the gap is open

  // Calls action for every number that must be saved between steps.
  template <class Action>
  void visit_saved(Action action) {
    for (double* x : {&active_, &touch_, &middle_, &end_, &closes_, &power_at_end_}) action(*x);
    for (double& x : impulse_) action(x);
    for (auto* values : {&q_, &v_, &after_compression_, &after_, &end_q_, &end_v_, &end_a_}) {
      for (double& x : *values) action(x);
    }
  }

 private:
  // The only contact of the model.
  const ContactParameters& contact() const { return *model_->auxiliary[0].contact; }
  double power(double t, const double* q, const double* v, const Eigen::Vector2d& command) const;
  void land();

  const Model* model_;
  mutable Constraint constraint_;
  double active_ = 0.0, touch_ = 0.0, middle_ = 0.0, end_ = 0.0, closes_ = 0.0;
  // N s: (normal, friction) impulses of the compression, then of the expansion.
  std::array<double, 4> impulse_{};
  Eigen::Vector2d e_r_{1.0, 0.0};
  // State at the touch, and the velocities at the ends of the two phases.
  std::vector<double> q_, v_, after_compression_, after_;
  std::vector<double> end_q_, end_v_, end_a_;  // at the end
  std::vector<double> force_, acceleration_;   // by the loads at the touch
  mutable std::vector<double> scratch_q_, scratch_v_;
  Impact record_{};
  bool inside_ = false;
  double external_work_ = 0.0, landing_work_ = 0.0, power_at_touch_ = 0.0, power_at_end_ = 0.0;
};

}  // namespace rotorub
