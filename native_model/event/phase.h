// The smooth system between events: free flight, sliding with a given sign, or sticking, as an
// ordinary differential equation in y = (q, qdot, integrals). In contact the multipliers follow
// from the constraints on acceleration level,
//
//   gddot_N = -e_r . d'' - v_t^2 / delta = 0,   gddot_T = e_t . d'' + r Omega_c' - R Omega_r' = 0
//                                                 (sticking; Omega_r of a ring that turns),
//   lambda_T = -mu sign lambda_N (sliding),
//
// v_t = e_t . d' the whirl speed; gdot_N = 0 has been used in gddot_T. Several contacts that are
// closed have their multipliers from one linear system, through Delassus's matrix of all of them.
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <span>
#include <vector>

#include "native_model/contact/kinematics.h"
#include "native_model/dynamics/closed_contacts.h"
#include "native_model/event/contact_state.h"
#include "native_model/event/motion.h"
#include "native_model/system/model.h"

namespace rotorub {

// Of an instant that never comes, a bound that binds nothing.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Multipliers {
  double normal = 0.0, friction = 0.0;  // N, lambda_N, lambda_T
};

class Phase {
 public:
  explicit Phase(const Model& model);

  // What holds now at each contact.
  void set(std::size_t contact, const ContactState& state) { at_[contact].state = state; }
  const ContactState& state(std::size_t contact) const { return at_[contact].state; }
  bool in_contact(std::size_t contact) const { return state(contact).mode != Mode::kFree; }
  bool in_contact() const;  // at one of them
  std::size_t contacts() const { return at_.size(); }

  // Sampled controllers and recorded commands: the command is held; otherwise it follows the state.
  void hold(std::size_t contact, const Eigen::Vector2d& command) { at_[contact].held = command; }
  Eigen::Vector2d command(std::size_t contact, double t, const double* y) const;
  // Of a sampled law, at its last sample (ActuatorState::outputs).
  using Outputs = std::array<double, kMostOutputs>;
  void show(std::size_t contact, const Outputs& outputs) { at_[contact].outputs = outputs; }
  const Outputs& outputs(std::size_t contact) const { return at_[contact].outputs; }
  // The rates of the gap are summed up from here on, s.
  void first_touch(std::size_t contact, double t) { at_[contact].first_touch = t; }
  double first_touch(std::size_t contact) const { return at_[contact].first_touch; }

  // y' = f(t, y). Multipliers and margins (infinite in free flight) are those of the last call. No
  // allocation.
  void derivative(double t, const double* y, double* dy);
  const Multipliers& multipliers(std::size_t contact) const { return at_[contact].multipliers; }
  const Margins& margins(std::size_t contact) const { return at_[contact].margins; }

  struct Contact {
    ContactPoint point;
    ContactAccelerations b;
  };
  Contact contact(std::size_t contact, double t, const double* y);
  // Of all `closed`, whose points are filled in: gddot of each without contact forces is in b.
  struct Accelerations {
    ContactMatrix g;
    ContactVector b, scale;  // (normal, tangential) of each in turn; one scale a contact
  };
  Accelerations accelerations(double t, const double* y, std::span<ClosedContact> closed);

 private:
  struct AtContact {
    ContactState state{};
    Multipliers multipliers{};
    Margins margins{kInfinity, kInfinity};
    double first_touch = kInfinity;
    Eigen::Vector2d held{0.0, 0.0};
    Outputs outputs{};
  };
  void accelerate(double t, const double* y);
  Contact contact_of(std::size_t contact, double t, const double* q, const double* v) const;
  double scale_of(const Contact& contact, const double* q, const double* v) const;
  std::size_t find_closed();
  void find_multiplier(std::size_t contact, double t, const double* y, ContactPoint& point);
  void find_multipliers(double t, const double* y, std::span<ClosedContact> closed);
  void set_margins(std::size_t contact, double normal, double friction, double slip);

  const Model* model_;
  std::vector<AtContact> at_;  // of each auxiliary bearing
  std::vector<Eigen::Vector2d> commands_;
  std::array<ClosedContact, kMaxContacts> closed_;
  Eigen::VectorXd f_, a_;  // loads and accelerations
};

}  // namespace rotorub
