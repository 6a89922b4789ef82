#include "native_model/rub/feedback_map.h"

#include <cassert>
#include <cmath>

#include "native_model/rub/rub_map.h"

namespace rotorub::rub {
namespace {

FeedbackPoint point_of(RubSystem system, double feedback) {
  system.ring->coupling = std::copysign(feedback, system.speed);
  const RubPoint found = RubStudy(system).at(system.friction);
  FeedbackPoint point{system.speed, feedback, std::nullopt, std::nullopt, false};
  if (const StandingRub* forced = found.leading(RubKind::kForced)) {
    point.forced = forced->stability;
    point.normal_force = forced->rub.normal_force;
  }
  point.whip = (found.attractors() & (kBackwardWhip | kRollingRub)) != 0;
  return point;
}

}  // namespace

std::vector<std::optional<double>> FeedbackMap::rule() const {
  std::vector<std::optional<double>> best;
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    std::optional<double> k;
    double growth = 0.0;
    for (std::size_t j = 0; j < feedbacks.size(); ++j) {
      const FeedbackPoint& p = at(i, j);
      if (!p.forced || !p.forced->stable || p.forced->growth >= growth) continue;
      growth = p.forced->growth;
      k = p.feedback;
    }
    best.push_back(k);
  }
  return best;
}

FeedbackMap feedback_map(const RubSystem& system, const std::vector<double>& speeds,
                         const std::vector<double>& feedbacks,
                         const std::function<void(double share)>& progress) {
  assert(system.ring);
  FeedbackMap map{speeds, feedbacks, {}};
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (progress) progress(static_cast<double>(i) / static_cast<double>(speeds.size()));
    for (const double k : feedbacks) map.points.push_back(point_of(at_speed(system, speeds[i]), k));
  }
  return map;
}

}  // namespace rotorub::rub
