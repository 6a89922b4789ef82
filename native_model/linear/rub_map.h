// The lasting rubs that exist at a spin speed and a friction coefficient, which of them are stable,
// and which attractors may coexist.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "native_model/linear/rub_stability.h"
#include "native_model/linear/rub_system.h"
#include "native_model/linear/steady_rub.h"

namespace rotorub::rub {

// Attractors of the motion, as bits of a set.
enum Attractor : unsigned { kFreeOrbit = 1, kForcedRub = 2, kBackwardWhip = 4, kRollingRub = 8 };

struct StandingRub {
  SteadyRub rub;
  Stability stability;
};

struct RubPoint {
  double speed = 0.0;  // rad/s, Omega
  FrictionLaw friction{};
  double clearance = 0.0;  // m, delta_0
  // m, radius of the free orbit at the contact; empty with loads of several frequencies.
  std::optional<double> orbit;
  Stability free;                 // of the rotor without contact
  std::vector<StandingRub> rubs;  // forced by falling force, whips by rising |whirl|, rolling
  std::vector<std::pair<double, double>> rolling_ranges;  // rad/s, |whirl| (steady_rub.h)

  // The stable attractors: the free orbit if it lies within the clearance, and each kind of rub
  // with a stable solution.
  unsigned attractors() const;
  // The first stable rub of this kind, else the first of this kind, else null.
  const StandingRub* leading(RubKind kind) const;
};

// A rotor at one spin speed. Everything that does not depend on friction is computed once.
class RubStudy {
 public:
  // Throws RotorNotSolvable (rotor/refusal.h).
  explicit RubStudy(const RubSystem& system);

  RubPoint at(const FrictionLaw& friction) const;

 private:
  RubSystem system_;
  std::vector<RotatingLoad> loads_;
  std::optional<double> orbit_;
  Stability free_;
  BackwardCompliance backward_;
};

struct RubMap {
  std::vector<double> speeds, frictions;  // rad/s; 1
  std::vector<RubPoint> points;           // friction varies fastest
  const RubPoint& at(std::size_t speed, std::size_t friction) const {
    return points[speed * frictions.size() + friction];
  }
};

// Studies the system at each speed (at_speed). progress is called with the fraction done before
// each speed and may throw.
RubMap rub_map(const RubSystem& system, const std::vector<double>& speeds,
               const std::vector<double>& frictions,
               const std::function<void(double share)>& progress = {});

// Effect of cross-coupled feedback (control/ring_feedback.h) on the forced rub, and a rule for
// k(Omega). At each spin speed and k, the forced rub at the scene's friction is computed with the
// ring's closed loop, together with its least stable pair. The rule takes the k at which that pair
// decays fastest; without a stable forced rub there is no rule.
struct FeedbackPoint {
  double speed = 0.0;                  // rad/s, Omega
  double feedback = 0.0;               // N s/m, k
  std::optional<Stability> forced;     // of the forced rub; empty if there is none
  std::optional<double> normal_force;  // N, of the forced rub
  bool whip = false;                   // whether a stable backward whip or rolling exists beside it
};

// The rule at one speed.
struct FeedbackChoice {
  const FeedbackPoint* point;  // the k on the grid at which the forced rub decays fastest
  double from, to;             // N s/m, the range of the grid around it that is stable throughout
};

struct FeedbackMap {
  std::vector<double> speeds, feedbacks;  // both ascending
  std::vector<FeedbackPoint> points;      // feedback varies fastest
  const FeedbackPoint& at(std::size_t speed, std::size_t feedback) const {
    return points[speed * feedbacks.size() + feedback];
  }
  // The rule at each speed; empty where no forced rub is stable. Points into the map.
  std::vector<std::optional<FeedbackChoice>> rule() const;
};

// system must have a ring (asserted); its coupling is replaced. progress is called with the
// fraction done before each speed and may throw. Throws RotorNotSolvable.
FeedbackMap feedback_map(const RubSystem& system, const std::vector<double>& speeds,
                         const std::vector<double>& feedbacks,
                         const std::function<void(double share)>& progress = {});

}  // namespace rotorub::rub
