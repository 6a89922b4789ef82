// What cross-coupled feedback (control/ring_feedback.h) does to the rub that lasts: a rule for
// k(Omega). At each spin speed and k the forced rub of the scene's friction is found with the
// ring's closed loop in it, and its least stable pair. The k under which that pair decays fastest
// is the rule; where no rub lasts there is no rule.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "native_model/rub/rub_stability.h"
#include "native_model/rub/rub_system.h"

namespace rotorub::rub {

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
