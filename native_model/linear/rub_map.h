// Which lasting rubs there are at a spin speed and a friction, which of them are stable, and what
// may coexist.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "native_model/linear/rub_stability.h"
#include "native_model/linear/rub_system.h"
#include "native_model/linear/steady_rub.h"

namespace rotorub::rub {

// What the motion can end in, as bits of a set.
enum Attractor : unsigned { kFreeOrbit = 1, kForcedRub = 2, kBackwardWhip = 4, kRollingRub = 8 };

struct StandingRub {
  SteadyRub rub;
  Stability stability;
};

struct RubPoint {
  double speed = 0.0;  // rad/s, Omega
  FrictionLaw friction{};
  double clearance = 0.0;       // m, delta_0
  std::optional<double> orbit;  // m, free rotor at the contact; none: loads of several frequencies
  Stability free;               // of the rotor without contact
  std::vector<StandingRub> rubs;  // forced by falling force, whips by rising |whirl|, rolling
  std::vector<std::pair<double, double>> rolling_ranges;  // rad/s, |whirl| (steady_rub.h)

  // Stable ones: the free orbit within the clearance, and each kind of rub of which one is stable.
  unsigned attractors() const;
  // Of the kind: the first stable one, else the first; null where there is none.
  const StandingRub* leading(RubKind kind) const;
};

// A rotor at one spin speed: what does not depend on friction is computed once.
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
  std::vector<RubPoint> points;           // the friction runs fastest
  const RubPoint& at(std::size_t speed, std::size_t friction) const {
    return points[speed * frictions.size() + friction];
  }
};

// The system at each of the speeds (at_speed); progress: the share done, once a speed, may throw.
RubMap rub_map(const RubSystem& system, const std::vector<double>& speeds,
               const std::vector<double>& frictions,
               const std::function<void(double share)>& progress = {});

// What cross-coupled feedback (control/ring_feedback.h) does to the rub that lasts: a rule for
// k(Omega). At each spin speed and k the forced rub of the scene's friction is found with the
// ring's closed loop in it, and its least stable pair. The k under which that pair decays fastest
// is the rule; where no rub lasts there is no rule.
struct FeedbackPoint {
  double speed = 0.0;                  // rad/s, Omega
  double feedback = 0.0;               // N s/m, k
  std::optional<Stability> forced;     // of the forced rub; nothing: none lasts
  std::optional<double> normal_force;  // N, of it
  bool whip = false;                   // a stable backward whip or rolling exists beside it
};

// What the rule says at a speed.
struct FeedbackChoice {
  const FeedbackPoint* point;  // of the k of the grid whose forced rub decays fastest
  double from, to;             // N s/m, the stretch of the grid about it that is stable throughout
};

struct FeedbackMap {
  std::vector<double> speeds, feedbacks;  // both ascending
  std::vector<FeedbackPoint> points;      // the feedback runs fastest
  const FeedbackPoint& at(std::size_t speed, std::size_t feedback) const {
    return points[speed * feedbacks.size() + feedback];
  }
  // Of the speeds; nothing where no forced rub is stable. Lives as long as the map.
  std::vector<std::optional<FeedbackChoice>> rule() const;
};

// Asserts a ring. Its coupling is replaced. progress: the share done, once a speed, may throw.
// Throws RotorNotSolvable.
FeedbackMap feedback_map(const RubSystem& system, const std::vector<double>& speeds,
                         const std::vector<double>& feedbacks,
                         const std::function<void(double share)>& progress = {});

}  // namespace rotorub::rub
