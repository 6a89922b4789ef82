// The smooth system between events: free flight, sliding with a given sign, or sticking, as an
// ordinary differential equation in y = (q, qdot, integrals). In contact the multipliers follow
// from the constraints on acceleration level,
//
//   gddot_N = -e_r . d'' - v_t^2 / delta = 0,   gddot_T = e_t . d'' + r Omega_c' = 0 (sticking),
//   lambda_T = -mu sign lambda_N (sliding),
//
// v_t = e_t . d' the whirl speed; gdot_N = 0 has been used in gddot_T.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "native_model/contact/coulomb.h"
#include "native_model/system/actuation.h"
#include "native_model/dynamics/dynamics.h"
#include "native_model/system/model.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// Integrals carried along with the state, for statistics and the energy balance.
enum Integral { kNormalImpulse, kFrictionImpulse, kFrictionWork, kContactWork, kExternalWork,
                kGapRateSquare, kIntegrals };

struct Multipliers {
  double normal = 0.0, friction = 0.0;  // N, lambda_N, lambda_T
};

class Phase {
 public:
  explicit Phase(const Model& model);

  int size() const { return 2 * model_->nq() + kIntegrals; }

  // What holds now. sign: of the slip, sliding only.
  void set(Mode mode, double sign) { mode_ = mode; sign_ = sign; }
  Mode mode() const { return mode_; }
  double sign() const { return sign_; }

  // Sampled controllers: the command is held; otherwise it follows the state.
  void hold(const Eigen::Vector2d& command) { held_ = command; }
  void first_touch(double t) { first_touch_ = t; }
  double first_touch() const { return first_touch_; }
  Eigen::Vector2d command(double t, const double* y) const;

  // y' = f(t, y); remembers the multipliers. No allocation.
  void derivative(double t, const double* y, double* dy);
  const Multipliers& multipliers() const { return multipliers_; }

  // How far the phase is from its end: positive while it lasts. Free: +infinity (the gap is the
  // driver's); sliding: min of lambda_N and of the slip along its sign; sticking: lambda_N and
  // mu lambda_N - |lambda_T|. Each scaled to its own size. Of the last derivative().
  struct Margins {
    double force;  // N
    double cone;   // sliding: m/s of slip; sticking: N
  };
  Margins margins() const { return margins_; }

  // Accelerations in contact space without contact force: (d'', Omega_c'), and the right-hand
  // sides of gddot_N and gddot_T there.
  struct Contact {
    Delassus g;
    double gap_acceleration;   // gddot_N without contact force
    double slip_acceleration;  // gddot_T without contact force
    ContactPoint point;
    double acceleration_scale = 0.0;  // of what adds up to gddot_N; by contact() alone
  };
  Contact contact(double t, const double* y);

 private:
  void accelerate(double t, const double* q, const double* v, const Eigen::Vector2d& u);
  Contact contact_of(double t, const double* q, const double* v) const;

  const Model* model_;
  Mode mode_ = Mode::kFree;
  double sign_ = 1.0;
  Eigen::Vector2d held_{0.0, 0.0};
  double first_touch_;
  Multipliers multipliers_;
  Margins margins_{};
  Eigen::VectorXd f_, a_;  // loads and accelerations
};

}  // namespace rotorub
