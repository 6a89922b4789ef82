// An impact that takes compression and expansion times, (15)-(19), beside fixed steps: the loads of
// the touch act on, velocities go straight from phase to phase, coordinates with the velocity at
// the end of each phase, q = q_t + tau_C qdot_C + tau_E qdot_E, as in event/impact.h. Steps read it
// off.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/contact/impact.h"
#include "native_model/dynamics/constraint.h"
#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

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

  // Leaves it: the state at its end, and the accelerations of the loads there, nq values each.
  // True: contact lasts.
  bool finish(const double*& q, const double*& v, const double*& a);

  // All that outlives a step.
  template <class Action>
  void for_each_kept(Action action) {
    for (double* x : {&active_, &touch_, &middle_, &end_, &closes_, &power_at_end_}) action(*x);
    for (double& x : phase_force_) action(x);
    for (auto* values : {&q_, &v_, &after_compression_, &after_, &end_q_, &end_v_, &end_a_}) {
      for (double& x : *values) action(x);
    }
  }

 private:
  void add_phase(double t, const double* q, double tau, double normal, double friction,
                 const Eigen::Vector2d& e_r, const std::vector<double>& from,
                 std::vector<double>& to);
  double power(double t, const double* q, const double* v, const Eigen::Vector2d& command) const;
  Eigen::Vector2d rates(const double* v, const Eigen::Vector2d& e_r) const;

  const Model* model_;
  Constraint constraint_;
  double active_ = 0.0, touch_ = 0.0, middle_ = 0.0, end_ = 0.0, closes_ = 0.0;
  double phase_force_[4] = {};  // N: normal, friction of compression and of expansion
  // At the touch; velocities at the ends of the two phases.
  std::vector<double> q_, v_, after_compression_, after_;
  std::vector<double> end_q_, end_v_, end_a_;  // on leaving
  std::vector<double> force_, acceleration_, room_;
  Impact record_{};
  double external_work_ = 0.0, power_at_touch_ = 0.0, power_at_end_ = 0.0;
};

}  // namespace rotorub
