// An impact that takes compression and expansion times, (15)-(19). The loads of the touch act on;
// in each phase of the time tau the velocities go straight from v_0 to
//
//   v_1 = v_0 + tau a + M^-1 W p,     p = (normal, friction) impulses, a of the loads of the touch,
//
// the coordinates with v_1, q = q_t + tau_C qdot_C + tau_E qdot_E. The work of a phase has three
// parts: of the loads between v_0 and v_0 + tau a; of the impulse between v_0 + tau a and v_1; and,
// since the path goes with v_1 and the springs are held, what the stored energy grows by along the
// path at v_1. Steps of any kind read it off.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "native_model/contact/impact.h"
#include "native_model/contact/kinematics.h"
#include "native_model/model/constraint.h"
#include "native_model/numerics/status.h"

namespace rotorub {

class FiniteImpact {
 public:
  // The model, with a contact, must outlive it.
  explicit FiniteImpact(const Model& model);

  // From the touch at t (s), under the command that holds there; `follows`: a continuous controller
  // has another one at the end. With a status there is none.
  Status begin(double t, const double* q, const double* v, const Eigen::Vector2d& command,
               bool follows);
  void cancel() { active_ = end_ = 0.0; }
  bool active() const { return active_ > 0.0; }  // begun, and not finished

  double end() const { return end_; }  // s
  // In [touch, end], nq values each.
  void coordinates(double t, double* q) const;
  void velocities(double t, double* v) const;
  Eigen::Vector2d force(double t) const;  // N, normal and friction; 0 outside

  const Impact& record() const { return record_; }
  // J, over the whole of it, of all forces but springs and contact.
  double external_work() const { return external_work_; }
  double power_at_touch() const { return power_at_touch_; }  // W
  double power_at_end() const { return power_at_end_; }

  // Phase 0 is the compression, 1 the expansion.
  static constexpr std::size_t kPhases = 2;
  double begin_of(std::size_t phase) const { return phase == 0 ? touch_ : middle_; }  // s
  double duration(std::size_t phase) const;
  // N, of its impulses over its duration.
  Eigen::Vector2d phase_force(std::size_t phase) const;
  // Velocities at its begin and its end, nq values each.
  const double* from(std::size_t phase) const {
    return (phase == 0 ? v_ : after_compression_).data();
  }
  const double* to(std::size_t phase) const {
    return (phase == 0 ? after_compression_ : after_).data();
  }
  // What its first `dt` (s) do.
  struct Part {
    double normal, friction;  // N s
    // m/s, (gdot_N, gdot_T) that the contact changes, by the touch's normal.
    Eigen::Vector2d before, after;
    double external_work;  // J, of all other forces but springs
  };
  Part part(std::size_t phase, double dt) const;
  // m/s, gdot_N and gdot_T by the touch's normal.
  Eigen::Vector2d rates(const double* v) const;

  // Leaves it: the state at its end, and the accelerations of the loads there, nq values each.
  // True: contact lasts.
  bool finish(const double*& q, const double*& v, const double*& a);
  // J, of the way back to the circle where the straight path has left it: no work of the contact.
  double landing_work() const { return landing_work_; }
  bool is_inside() const { return inside_; }  // at its end: not on the circle

  // All that outlives a step.
  template <class Action>
  void for_each_kept(Action action) {
    for (double* x : {&active_, &touch_, &middle_, &end_, &closes_, &power_at_end_}) action(*x);
    for (double& x : impulse_) action(x);
    for (auto* values : {&q_, &v_, &after_compression_, &after_, &end_q_, &end_v_, &end_a_}) {
      for (double& x : *values) action(x);
    }
  }

 private:
  double power(double t, const double* q, const double* v, const Eigen::Vector2d& command) const;
  void land();

  const Model* model_;
  mutable Constraint constraint_;
  double active_ = 0.0, touch_ = 0.0, middle_ = 0.0, end_ = 0.0, closes_ = 0.0;
  std::array<double, 4> impulse_{};  // N s: normal, friction of compression and of expansion
  Eigen::Vector2d e_r_{1.0, 0.0};
  // At the touch; velocities at the ends of the two phases.
  std::vector<double> q_, v_, after_compression_, after_;
  std::vector<double> end_q_, end_v_, end_a_;  // on leaving
  std::vector<double> force_, acceleration_;   // of the touch's loads
  mutable std::vector<double> room_, room_v_;
  Impact record_{};
  bool inside_ = false;
  double external_work_ = 0.0, landing_work_ = 0.0, power_at_touch_ = 0.0, power_at_end_ = 0.0;
};

}  // namespace rotorub
