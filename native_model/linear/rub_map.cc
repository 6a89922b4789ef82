#include "native_model/linear/rub_map.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "native_model/linear/driven_rub.h"

namespace rotorub::rub {
namespace {

// Radius of the free orbit: 0 without load; empty with several frequencies, as the orbit is not a
// circle.
std::optional<double> orbit_of(const RubSystem& system, const std::vector<RotatingLoad>& loads) {
  if (loads.empty()) return 0.0;
  if (loads.size() > 1) return {};
  return free_orbit(system, loads.front());
}

unsigned bit_of(RubKind kind) {
  constexpr std::array<unsigned, 3> kBits{kForcedRub, kBackwardWhip, kRollingRub};
  return kBits[static_cast<std::size_t>(kind)];
}

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

unsigned RubPoint::attractors() const {
  unsigned all = free.stable && orbit && *orbit < clearance ? kFreeOrbit : 0U;
  for (const StandingRub& r : rubs) all |= r.stability.stable ? bit_of(r.rub.kind) : 0U;
  return all;
}

const StandingRub* RubPoint::leading(RubKind kind) const {
  const StandingRub* first = nullptr;
  for (const StandingRub& r : rubs) {
    if (r.rub.kind != kind) continue;
    if (r.stability.stable) return &r;
    if (!first) first = &r;
  }
  return first;
}

RubStudy::RubStudy(const RubSystem& system)
    : system_(system),
      loads_(rotating_loads(system)),
      orbit_(orbit_of(system, loads_)),
      free_(stability_of(free_eigenvalues(system))),
      backward_(system) {}

RubPoint RubStudy::at(const FrictionLaw& friction) const {
  RubSystem system = system_;
  system.friction = friction;
  RubPoint point{system.speed,
                 friction,
                 system.clearance,
                 orbit_,
                 free_,
                 {},
                 backward_.rolling_ranges(friction.sticking())};
  const auto add = [&](SteadyRub rub) {
    const Stability stability = stability_of(
        system.ring_turns() ? driven_eigenvalues(system, {}, rub) : rub_eigenvalues(system, rub));
    point.rubs.push_back({std::move(rub), stability});
  };
  if (loads_.size() == 1) {
    for (SteadyRub& rub : forced_rubs(system, loads_.front())) add(std::move(rub));
  }
  for (SteadyRub& whip : backward_.whips(friction)) add(std::move(whip));
  if (!system.ring_turns()) {
    if (auto rolling = backward_.rolling(friction.sticking())) add(std::move(*rolling));
  }
  for (SteadyRub& rolling : backward_.rolling_on_ring(friction.sticking())) add(std::move(rolling));
  return point;
}

RubMap rub_map(const RubSystem& system, const std::vector<double>& speeds,
               const std::vector<double>& frictions, const std::function<void(double)>& progress) {
  RubMap map{speeds, frictions, {}};
  for (std::size_t k = 0; k < speeds.size(); ++k) {
    if (progress) progress(static_cast<double>(k) / static_cast<double>(speeds.size()));
    const RubStudy study(at_speed(system, speeds[k]));
    for (const double friction : frictions) map.points.push_back(study.at(friction));
  }
  return map;
}

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
