// The derivative of a motion's end with respect to its start, along a recorded motion
// (motion_record.h). With w the change of the state y = (q, v) by a small change of the start:
//
//   smooth stretch   w' = (df/dy) w,  f the field of the contacts' states (event/smooth_system.h),
//   by
//                    central differences of fourth order of DOP853 steps along w: a step has a
//                    rounding error of 1e-16, the differences one of 1e-12
//   event            at the surface h(y) = 0, where y jumps to R(y):
//                    dt = -(h_y w) / (h_y f-),  u = w + f- dt,  w+ = R_y u - f+ dt
//
// The last line is the saltation matrix R_y + (f+ - R_y f-) h_y / (h_y f-) (Leine and Nijmeijer,
// Dynamics and Bifurcations of Non-Smooth Mechanical Systems, 2004, section 7; di Bernardo et al.,
// Piecewise-smooth Dynamical Systems, 2008, section 2.5). The events are
//
//   impact       h = g_N, R: Poisson's and Coulomb's impact of all closed contacts
//   touch        compliant contact: h = g_N, R = 1, except for a of the touch (compliance.h), which
//                depends on its speed and is an entry of w
//   slip ends    h = gdot_T, R = 1: sticking, or slip the other way
//   sample       of a control: w+ = S_y w, with the sample y+ = S(y) (model/sampled_feedback.h,
//                model/control_states.h), by the same differences; a motion that begins or ends at
//                a sample is not supported
//   other ends   of lasting contact (lambda_N = 0), of sticking (|lambda_T| = mu lambda_N) and of a
//                compliant force: f- = f+, so w does not jump
//
// Where a contact lasts, w stays tangent to its constraints, g_N = gdot_N = 0 (and gdot_T = 0). The
// impacts of an accumulation that are slower than kCaptured of the speeds count as one impact
// without rebound: the remaining flights change the derivative by about that share, whereas each of
// them magnifies the rounding error by the inverse of its speed.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/event/smooth_system.h"
#include "native_model/numerics/dop853.h"
#include "native_model/periodic/motion_record.h"

namespace rotorub::periodic {

class FlowDerivative {
 public:
  // sizes: of the 2 nq entries of y (EssentialState::sizes). The model must outlive this object.
  FlowDerivative(const Model& model, const Eigen::VectorXd& sizes,
                 const EventParameters& parameters = {});

  static constexpr double kCaptured = 1e-6;

  // The changes of the motion's end by the changes `directions` of its start, 2 nq x k each, in the
  // units of y. The directions must be tangent to the constraints of contacts closed at the start.
  Eigen::MatrixXd along(const MotionRecord& motion, const Eigen::MatrixXd& directions);
  // y' at t (s) for contacts in these states, 2 nq values.
  Eigen::VectorXd slope(double t, const std::vector<double>& y, const ContactStates& states);
  // True if an event of the last motion grazes: the motion reaches its surface without speed, so
  // the derivative does not exist there.
  bool grazes() const { return grazes_; }

 private:
  enum class Kind { kSmooth, kImpact, kTouch, kSlipEnds };
  Kind kind_of(const Jump& jump, const ContactStates& before) const;
  void set_states(const ContactStates& states);
  void pass(const Stretch& stretch, const ContactStates& states, Eigen::MatrixXd& w);
  void cross(const Stretch& stretch, const ContactStates& after, bool captured, Eigen::MatrixXd& w);
  void sample(double t, const std::vector<double>& before, Eigen::MatrixXd& w);
  Eigen::VectorXd varied(const Stretch& stretch, const ContactStates& states,
                         const Eigen::VectorXd& w, int parts);
  double share_of(const Eigen::VectorXd& w) const;
  double deepest(const MotionRecord& motion) const;
  std::size_t capture(const MotionRecord& motion, std::size_t from) const;
  double approach(const Jump& jump) const;

  const Model* model_;
  EventParameters parameters_;
  Eigen::VectorXd sizes_;
  int n_;  // 2 nq
  SmoothSystem system_;
  Dop853 step_;
  std::vector<double> y_, slope_, tolerance_;
  double speed_ = 0.0;          // m/s, size of the speeds
  double share_ = 0.0;          // of the sizes, for the differences
  double longest_ = kInfinity;  // s, longest step that is accurate for the variations
  bool grazes_ = false;
};

}  // namespace rotorub::periodic
