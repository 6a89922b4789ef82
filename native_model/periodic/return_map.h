// The return map P of a scene: the state after one period as a function of the state at its start,
// with its derivative. Both are expressed in the essential entries of the state, divided by their
// sizes (essential_state.h). If contacts are closed at the start, the state lies on the surface of
// their constraints, and the map acts on its tangent space:
//
//   x = sizes . (x_0 + B c),   B: orthonormal, G B = 0,   G: gradients of g_N, gdot_N (, gdot_T)
#pragma once

#include <Eigen/Core>
#include <string>

#include "native_model/model/constraint.h"
#include "native_model/periodic/essential_state.h"
#include "native_model/periodic/flow_derivative.h"
#include "native_model/periodic/forcing.h"
#include "native_model/periodic/motion_record.h"
#include "native_model/periodic/turning_frame.h"

namespace rotorub::periodic {

using HeldContacts = ContactList<Constraint::Closed>;  // rigid contacts that last at the start

// A state after a period, and where the map leads from it.
struct Return {
  Status status = Status::kOk;
  std::string message;
  MotionRecord motion;
  Eigen::VectorXd sizes;   // of all 2 nq entries
  Eigen::VectorXd change;  // P(x) - x, scaled; the spin angle without its whole turns
  double residual = 0.0;   // its largest entry; infinite if the motion failed
};

// The derivative of a Return.
struct ReturnDerivative {
  Eigen::MatrixXd basis;                   // B, n x k
  Eigen::MatrixXd image;                   // P' B, n x k
  Eigen::VectorXd start_slope, end_slope;  // x' at the start and at the end, 1/s, n values
  bool grazes = false;                     // an event grazes, so the derivative does not exist
};

class ReturnMap {
 public:
  // The model must outlive this object. turning: the return is seen in the frame that turns with
  // the loads.
  explicit ReturnMap(const Model& model, const EventParameters& parameters = {},
                     bool turning = false);

  const Model& model() const { return *model_; }
  const Forcing& forcing() const { return forcing_; }
  const EssentialState& essential() const { return essential_; }
  const TurningFrame& frame() const { return frame_; }
  // True if the period is unknown.
  bool is_autonomous() const { return forcing_.period == 0.0 || frame_.turns(); }

  // The state `start` after `period` (s). turns: whole turns of the spin angle in the period, if it
  // is essential.
  Return at(const State& start, double period, int turns) const;
  ReturnDerivative derivative(const Return& point, const HeldContacts& held) const;

  // Moves the state by c (k values) within the tangent space `basis`, expressed in these sizes, and
  // back onto the constraints of the held contacts.
  State moved(const State& from, const Eigen::VectorXd& sizes, const Eigen::MatrixXd& basis,
              const Eigen::VectorXd& c, const HeldContacts& held) const;
  // Moves the state onto the constraints of the held contacts.
  void project(State& state, const HeldContacts& held) const;

 private:
  void zero_rows_of_settings(ReturnDerivative& d) const;
  Eigen::VectorXd scaled(const Eigen::VectorXd& y, const Eigen::VectorXd& sizes) const;

  const Model* model_;
  EventParameters parameters_;
  Forcing forcing_;
  EssentialState essential_;
  TurningFrame frame_;
};

}  // namespace rotorub::periodic
