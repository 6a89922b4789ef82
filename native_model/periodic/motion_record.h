// A motion of the event-driven integrator as a list of smooth stretches with what happens at their
// ends, for everything that is computed along a motion (flow_derivative.h). The integrator is
// driven from outside through its stretches (event/driver.h), so its own loop stays as it is.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "native_model/contact/contact_list.h"
#include "native_model/event/contact_state.h"
#include "native_model/event/parameters.h"
#include "native_model/model/model.h"

namespace rotorub::periodic {

// The state of each contact of the model, in their order.
using ContactStates = ContactList<ContactState>;

// An event at the end of a stretch.
struct Jump {
  std::size_t contact;                // whose event it is
  std::vector<double> before, after;  // y = (q, v), 2 nq values
  ContactStates states;               // after it
};

// A part of the motion in which all contacts keep their states; at most one step of the integrator.
struct Stretch {
  double t, length;       // s
  std::vector<double> y;  // (q, v) at its start, 2 nq values
  ContactStates states;   // within it
  std::optional<Jump> jump{};
  double end() const { return t + length; }  // s
};

struct MotionRecord {
  Status status = Status::kOk;
  std::string message;             // for a status other than kOk
  std::vector<Stretch> stretches;  // in their order
  // y = (q, v), after the decisions about contacts closed there.
  std::vector<double> start, end;
  ContactStates first, last;                // states of the contacts there
  double begin_time = 0.0, end_time = 0.0;  // s
};

// The motion from `start` to `end` (s).
MotionRecord record_motion(const Model& model, const State& start, double end,
                           const EventParameters& parameters = {});

// Sizes of the entries of y (EssentialState::sizes) over the motion.
Eigen::VectorXd sizes_along(const Model& model, const MotionRecord& motion);

inline Eigen::VectorXd as_vector(const std::vector<double>& y) {
  return Eigen::Map<const Eigen::VectorXd>(y.data(), static_cast<Eigen::Index>(y.size()));
}

}  // namespace rotorub::periodic
