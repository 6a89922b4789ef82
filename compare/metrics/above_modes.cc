#include "compare/metrics/above_modes.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "compare/metrics/relative_motion.h"
#include "native_model/linear/whirl_system.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

// psi' at time t, linear between rows; `points` must not be empty.
double rate_at(const std::vector<RelativePoint>& points, double t) {
  const auto after = std::lower_bound(points.begin(), points.end(), t,
                                      [](const RelativePoint& p, double at) { return p.t < at; });
  if (after == points.begin()) return points.front().angle_rate;
  if (after == points.end()) return points.back().angle_rate;
  const RelativePoint &a = *(after - 1), &b = *after;
  return a.angle_rate + (b.angle_rate - a.angle_rate) * (t - a.t) / (b.t - a.t);
}

// The part of a total above the band.
struct Share {
  double above = 0.0, all = 0.0;
  void add(double part, bool is_above) {
    all += part;
    if (is_above) above += part;
  }
  double value() const { return all > 0.0 ? above / all : 0.0; }
};

}  // namespace

std::optional<ModeBand> mode_band(const scene::Scene& scene) {
  if (!scene.has_contact() || !scene.rotor.geometry) return {};
  return mode_band(
      with_place(scene, [&] { return whirl_spectrum(whirl_system(scene), scene.rotor.speed); }));
}

ModeBand mode_band(const WhirlSpectrum& spectrum) {
  ModeBand band;
  for (const WhirlMode& mode : spectrum.modes) {
    band.forward = std::max(band.forward, mode.frequency);
    band.backward = std::max(band.backward, -mode.frequency);
  }
  return band;
}

bool is_above(const ModeBand& band, double rate) {
  return rate > band.forward || rate < -band.backward;
}

AboveModes above_modes(const Trajectory& trajectory, const ModeBand& band) {
  AboveModes result;
  result.band = band;
  const std::vector<RelativePoint> points = relative_motion(trajectory);
  if (points.empty()) return result;
  const auto& normal = trajectory.column("normal_force");
  const auto& friction = trajectory.column("friction_force");
  const auto& slip = trajectory.column("slip");
  const auto meet = [&](double rate) {
    if (std::abs(rate) > std::abs(result.fastest)) result.fastest = rate;
    return is_above(band, rate);
  };

  Share contact, work;
  const std::size_t n = points.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (!(normal[i] > 0.0)) continue;
    const double from = i > 0 ? points[i - 1].t : points[i].t;
    const double to = i + 1 < n ? points[i + 1].t : points[i].t;
    const double time = 0.5 * (to - from);
    const bool is_above = meet(points[i].angle_rate);
    contact.add(time, is_above);
    work.add(std::abs(friction[i] * slip[i]) * time, is_above);
  }
  for (const Impact& impact : trajectory.impacts) {
    const double rubbed = 0.5 * impact.friction_impulse * (impact.slip_before + impact.slip_after);
    work.add(std::abs(rubbed), meet(rate_at(points, impact.t)));
  }
  result.contact_share = contact.value();
  result.friction_share = work.value();
  return result;
}

std::optional<AboveModes> above_modes(const scene::Scene& scene, const Trajectory& trajectory) {
  const auto band = mode_band(scene);
  if (!band) return {};
  return above_modes(trajectory, *band);
}

}  // namespace rotorub
