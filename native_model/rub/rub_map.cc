#include "native_model/rub/rub_map.h"

#include <utility>

namespace rotorub::rub {
namespace {

// Without load the free rotor stands in the middle; of loads of several frequencies it draws no
// circle.
std::optional<double> orbit_of(const RubSystem& system, const std::vector<RotatingLoad>& loads) {
  if (loads.empty()) return 0.0;
  if (loads.size() > 1) return {};
  return free_orbit(system, loads.front());
}

unsigned bit_of(RubKind kind) {
  switch (kind) {
    case RubKind::kForced:
      return kForcedRub;
    case RubKind::kWhip:
      return kBackwardWhip;
    case RubKind::kRolling:
      break;
  }
  return kRollingRub;
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

RubPoint RubStudy::at(double friction) const {
  RubSystem system = system_;
  system.friction = friction;
  RubPoint point{system.speed,
                 friction,
                 system.clearance,
                 orbit_,
                 free_,
                 {},
                 backward_.rolling_ranges(friction)};
  const auto add = [&](SteadyRub rub) {
    const Stability stability = stability_of(rub_eigenvalues(system, rub));
    point.rubs.push_back({std::move(rub), stability});
  };
  if (loads_.size() == 1) {
    for (SteadyRub& rub : forced_rubs(system, loads_.front())) add(std::move(rub));
  }
  for (SteadyRub& whip : backward_.whips(friction)) add(std::move(whip));
  if (auto rolling = backward_.rolling(friction)) add(std::move(*rolling));
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

}  // namespace rotorub::rub
