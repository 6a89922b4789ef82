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

bool stable(const FeedbackPoint& p) { return p.forced && p.forced->stable; }

std::optional<FeedbackChoice> choice_of(const FeedbackMap& map, std::size_t speed) {
  std::optional<std::size_t> best;
  for (std::size_t j = 0; j < map.feedbacks.size(); ++j) {
    const FeedbackPoint& p = map.at(speed, j);
    if (stable(p) && (!best || p.forced->growth < map.at(speed, *best).forced->growth)) best = j;
  }
  if (!best) return std::nullopt;
  std::size_t from = *best, to = *best;
  while (from > 0 && stable(map.at(speed, from - 1))) --from;
  while (to + 1 < map.feedbacks.size() && stable(map.at(speed, to + 1))) ++to;
  return FeedbackChoice{&map.at(speed, *best), map.feedbacks[from], map.feedbacks[to]};
}

}  // namespace

std::vector<std::optional<FeedbackChoice>> FeedbackMap::rule() const {
  std::vector<std::optional<FeedbackChoice>> all;
  for (std::size_t i = 0; i < speeds.size(); ++i) all.push_back(choice_of(*this, i));
  return all;
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
