#include "renders/contact_marks.h"

#include <algorithm>
#include <cmath>

namespace rotorub::renders {

namespace {
constexpr int kTrailPoints = 72;
constexpr double kFaintest = 0.15;  // weaker impacts are not drawn
}  // namespace

Instant instant_at(const Playback& playback, double t, const Scales& scales,
                   const InstantOptions& options) {
  Instant instant;
  instant.pose = playback.at(t);
  const double oldest = std::max(playback.start(), t - options.trail_time);
  for (int i = 0; i <= kTrailPoints; ++i) {
    instant.trail.push_back(playback.at(oldest + (t - oldest) * i / kTrailPoints).rotor);
  }

  const auto arrow = [](const ValueScale& scale, double force) {
    return scale.high > 0.0 ? ArrowShare{scale.share(force), scale.clips(force)} : ArrowShare{};
  };
  instant.normal = arrow(scales.force, instant.pose.normal_force);
  instant.friction = arrow(scales.force, std::abs(instant.pose.friction_force));
  instant.control = arrow(scales.control, instant.pose.control.norm());

  for (int k = 0; k < 2 && scales.current.high > 0.0; ++k) {
    const double ampere = instant.pose.current[k];
    instant.current[k] = std::copysign(scales.current.share(std::abs(ampere)), ampere);
  }

  const auto& strikes = playback.strikes();
  auto strike = std::upper_bound(strikes.begin(), strikes.end(), t,
                                 [](double time, const Strike& s) { return time < s.t; });
  while (strike != strikes.begin()) {
    --strike;
    const double age = (t - strike->t) / options.spark_time;
    if (age >= 1.0) break;
    const double strength = std::sqrt(scales.impulse.share(strike->impulse));
    if (strength > kFaintest) instant.sparks.push_back({strike->e_r, strength, 1.0 - age});
  }
  return instant;
}

DrawnSection drawn_section(const Machine& machine, const Pose& pose) {
  DrawnSection section;
  section.ring = pose.stator * machine.displaced(1.0);
  section.rotor = pose.rotor * machine.displaced(1.0);
  section.e_r = pose.e_r();
  section.e_t = {-section.e_r[1], section.e_r[0]};
  section.touch = section.ring;
  if (machine.contact) section.touch += machine.contact->ring_bore() * section.e_r;
  section.in_contact = pose.normal_force > 0.0;
  return section;
}

}  // namespace rotorub::renders
