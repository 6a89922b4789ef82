// The smooth system between events: free flight, sliding with a given sign, or sticking, as an
// ordinary differential equation in y = (q, qdot, integrals). In contact the multipliers follow
// from the constraints on the accelerations,
//
//   gddot_N = -e_r . d'' - v_t^2 / delta = 0,   gddot_T = e_t . d'' + r Omega_c' - R Omega_r' = 0
//                                                 (sticking; Omega_r of a ring that turns),
//   lambda_T = -mu sign lambda_N (sliding),
//
// where v_t = e_t . d' is the whirl speed. For a compliant contact lambda_N is known instead
// (contact/compliance.h). The multipliers of several closed contacts follow from one linear system
// with their common Delassus matrix; one contact has a closed form.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "native_model/event/contact_state.h"
#include "native_model/model/constraint.h"
#include "native_model/model/inverse_mass.h"
#include "native_model/model/model.h"

namespace rotorub {

// Integrals that are computed along with the state, for statistics and the energy balance. Each
// contact has the first kOfContact of them.
enum Integral {
  kNormalImpulse,
  kFrictionImpulse,
  kFrictionWork,
  kContactWork,  // on the coordinates
  kExternalWork,
  kGapRateSquare,
  kIntegrals
};
inline constexpr int kOfContact = 4;
inline int integral_count(const Model& model) {
  return kIntegrals + kOfContact * static_cast<int>(model.auxiliary.size() - 1);
}

// The position among the integrals.
inline int integral_index(Integral k, std::size_t contact) {
  return contact == 0 ? k : kIntegrals + kOfContact * static_cast<int>(contact - 1) + k;
}

// The motion: time, and y of the integrator.
struct Motion {
  explicit Motion(const Model& model)
      : nq(model.nq()), y(static_cast<std::size_t>(2 * nq + integral_count(model))) {}
  // Starts from `start` with all integrals 0.
  void begin(const State& start) {
    t = start.t;
    std::fill(y.begin(), y.end(), 0.0);
    std::copy_n(start.q.data(), nq, q());
    std::copy_n(start.v.data(), nq, v());
  }
  double* q() { return y.data(); }
  double* v() { return y.data() + nq; }
  const double* q() const { return y.data(); }
  const double* v() const { return y.data() + nq; }
  int index(Integral k, std::size_t contact = 0) const {
    return 2 * nq + integral_index(k, contact);
  }
  double& integral(Integral k) { return y[static_cast<std::size_t>(index(k))]; }
  double integral(Integral k, std::size_t contact = 0) const {
    return y[static_cast<std::size_t>(index(k, contact))];
  }

  double t = 0.0;  // s
  int nq;
  std::vector<double> y;
};

// An instant that never comes, or a bound that never applies.
inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Multipliers {
  double normal = 0.0, friction = 0.0;  // N, lambda_N, lambda_T
};

// The condition on the velocities of a rigid contact that slides or sticks.
inline Constraint::Velocity velocity_of(ContactMode mode) {
  return mode == ContactMode::kStick ? Constraint::Velocity::kZero
                                     : Constraint::Velocity::kTangential;
}

class SmoothSystem {
 public:
  explicit SmoothSystem(const Model& model);

  // The present state of each contact.
  void set(std::size_t contact, const ContactState& state) { at_[contact].state = state; }
  const ContactState& state(std::size_t contact) const { return at_[contact].state; }
  bool in_contact(std::size_t contact) const { return state(contact).mode != ContactMode::kFree; }
  // True if the phase ends by a margin: in contact, or in the wall of a compliant contact.
  bool has_margins(std::size_t contact) const {
    return in_contact(contact) || state(contact).in_wall;
  }
  // The rigid contacts in lasting contact, which are held on their circles.
  ContactList<Constraint::Closed> rigid_contacts() const;
  // N, lambda_N of a compliant contact; empty for a rigid one.
  std::optional<double> compliant_force(const ClosedContact& at) const;
  std::size_t contacts() const { return at_.size(); }

  // Sets the command of a sampled controller or of a record, which is held until the next call.
  // Other commands follow the state.
  void hold_command(std::size_t contact, const Eigen::Vector2d& command) {
    at_[contact].held_command = command;
  }
  Eigen::Vector2d command(std::size_t contact, double t, const double* y) const;
  // The outputs of a sampled law at its last sample (ActuatorState::outputs).
  using Outputs = std::array<double, kMostOutputs>;
  void set_outputs(std::size_t contact, const Outputs& outputs) { at_[contact].outputs = outputs; }
  const Outputs& outputs(std::size_t contact) const { return at_[contact].outputs; }
  // s, first touch of the contact; infinite: none yet. After the first touch of any contact, the
  // squares of all gap rates are integrated outside rigid lasting contact (kGapRateSquare).
  void first_touch(std::size_t contact, double t) {
    at_[contact].first_touch = t;
    touched_ =
        std::ranges::any_of(at_, [](const auto& at) { return std::isfinite(at.first_touch); });
  }
  double first_touch(std::size_t contact) const { return at_[contact].first_touch; }

  // y' = f(t, y). It also sets multipliers and margins (infinite in free flight). Does not
  // allocate.
  void derivative(double t, const double* y, double* dy);
  const Multipliers& multipliers(std::size_t contact) const { return at_[contact].multipliers; }
  const Margins& margins(std::size_t contact) const { return at_[contact].margins; }

  // The accelerations of the contacts `closed`, whose points are filled in: b has gddot of each one
  // without contact forces.
  struct Accelerations {
    ContactMatrix g;
    ContactVector b, scale;  // (normal, tangential) of each in turn; one scale per contact
  };
  Accelerations accelerations(double t, const double* y, std::span<ClosedContact> closed);

 private:
  struct AtContact {
    ContactState state{};
    Eigen::Matrix3d admittance = Eigen::Matrix3d::Zero();  // of itself, without coupling
    Multipliers multipliers{};
    Margins margins{kInfinity, kInfinity};
    double first_touch = kInfinity;
    Eigen::Vector2d held_command{0.0, 0.0};
    Outputs outputs{};
  };
  void accelerate(double t, const double* y);
  Eigen::Vector2d free_acceleration(const ClosedContact& at) const;
  double mu_sign(const ClosedContact& at) const;
  double scale_of(const ContactPoint& point, double normal, const double* q, const double* v) const;
  void find_closed(const double* q, const double* v);
  PlanarImpulse force_of_one(const ClosedContact& c, const Eigen::Vector3d& coupling) const;
  void forces_of_several(double t, const double* q, PlanarImpulse* forces) const;
  void add_contact_forces(double t, const double* q, double* a);
  void integrate(const ClosedContact& at, double* integrals) const;
  void set_margins(const ClosedContact& at, double normal, double friction);
  void set_margins_in_wall(std::size_t contact, const double* q, const double* v);

  const Model* model_;
  std::vector<AtContact> at_;  // one per auxiliary bearing
  bool touched_ = false;       // at least one of them was touched
  bool is_actuated_ = false;   // at least one ring is
  std::vector<Eigen::Vector2d> commands_;
  ContactList<ClosedContact> closed_;  // at present
  equations::DiscAngles angles_;
  InverseMass inverse_mass_;
  Eigen::VectorXd f_, a_;  // loads and accelerations, without contact
};

}  // namespace rotorub
