#include "native_model/periodic/forcing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "native_model/periodic/essential_state.h"

namespace rotorub::periodic {
namespace {

constexpr int kMostTurns = 64;           // of the slowest load in the common period
constexpr double kSameFrequency = 1e-9;  // relative; closer frequencies count as equal

double latest_switch(const Model& m) {
  double latest = 0.0;
  const auto meet = [&latest](double t) {
    if (std::isfinite(t) && t < scene::kNever) latest = std::max(latest, t);
  };
  for (const AppliedForce& f : m.forces) {
    if (f.amplitude == 0.0 && f.vector.isZero()) continue;
    meet(f.on + f.ramp);
    meet(f.off);
  }
  for (const DiscUnbalance& u : m.unbalances) meet(u.on);
  for (const StationFeedback& f : m.feedbacks) {
    for (const double t : f.works.all()) meet(t);
  }
  for (const SampledFeedback& s : m.samplers) latest += s.sample_time;  // its first sample differs
  if (m.base) std::ranges::for_each(m.base->breaks(), meet);
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (!at.controller) continue;
    meet(at.control_on);
    for (const double t : at.controller->breaks(at.control_on)) meet(t);
  }
  return latest;
}

// The frequencies of the loads that act for ever, rad/s, > 0.
std::vector<double> frequencies(const Model& m) {
  std::vector<double> all;
  const auto add = [&all](double frequency) {
    if (frequency != 0.0) all.push_back(std::abs(frequency));
  };
  if (!m.layout.spin && !m.unbalances.empty()) add(m.speed);
  for (const AppliedForce& f : m.forces) {
    const bool acts = f.off >= scene::kNever && f.amplitude != 0.0;
    if (acts && f.kind == scene::ForceKind::kRotating) add(f.frequency);
  }
  return all;
}

// The longest period in which all of them turn by whole turns, s; empty if there is none.
std::optional<double> common_period(const std::vector<double>& all) {
  const double slowest = *std::ranges::min_element(all);
  for (int turns = 1; turns <= kMostTurns; ++turns) {
    const auto is_whole = [&](double frequency) {
      const double of_it = frequency / slowest * turns;
      return std::abs(of_it - std::round(of_it)) <= kSameFrequency * of_it;
    };
    if (std::ranges::all_of(all, is_whole)) return 2.0 * std::numbers::pi * turns / slowest;
  }
  return {};
}

// The number of samples in a period (s); it need not be whole.
double samples_in(double period, const SampledFeedback& s) { return period / s.sample_time; }

std::string refusal_of(const Model& m, const std::vector<double>& of_loads) {
  const auto lasts = [](const AppliedForce& f) {
    const bool passes = f.kind == scene::ForceKind::kChirp || f.kind == scene::ForceKind::kPulse;
    return passes && f.off >= scene::kNever;
  };
  if (std::ranges::any_of(m.forces, lasts)) {
    return "a chirp or a pulse without an end does not repeat";
  }
  if (m.base && (m.base->breaks().empty() || m.base->breaks().back() >= scene::kNever)) {
    return "a motion of the base without an end is not supported";
  }
  if (m.drive_follows()) return "a speed-controlled drive is not supported";
  if (!m.samplers.empty() && of_loads.empty()) {
    return "a sampled control of a magnetic bearing has no period in common with a motion without "
           "loads; add an unbalance or a rotating force, or use kind = \"pid\" without sample_time";
  }
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (at.loop || at.recorded)
      return "sampled controllers and recorded commands are not supported";
    if (at.contact && at.contact->impact_time() > 0.0) {
      return "impacts that take time are not supported";
    }
  }
  if (!of_loads.empty() && spin_angle_acts(m)) {
    return "loads with their own frequency beside loads that turn with a free spin do not repeat";
  }
  if (!of_loads.empty() && !common_period(of_loads)) {
    return "the frequencies of the loads have no common period";
  }
  const auto is_split = [&](const SampledFeedback& s) {
    const double samples = samples_in(*common_period(of_loads), s);
    return std::abs(samples - std::round(samples)) > kSameFrequency * samples;
  };
  if (std::ranges::any_of(m.samplers, is_split)) {
    return "a sample time of a magnetic bearing does not divide the period of the loads";
  }
  return "";
}

}  // namespace

Model with_whole_samples(Model m) {
  const std::vector<double> of_loads = frequencies(m);
  const std::optional<double> period = of_loads.empty() ? std::nullopt : common_period(of_loads);
  if (!period) return m;
  for (SampledFeedback& s : m.samplers) {
    s.sample_time = *period / std::max(1.0, std::round(samples_in(*period, s)));
  }
  return m;
}

Forcing forcing_of(const Model& m) {
  const std::vector<double> of_loads = frequencies(m);
  Forcing forcing;
  forcing.refusal = refusal_of(m, of_loads);
  forcing.settled = latest_switch(m);
  if (!forcing.refusal.empty()) return forcing;
  forcing.turns = spin_angle_acts(m);
  if (of_loads.empty()) return forcing;
  forcing.period = *common_period(of_loads);
  forcing.settled = std::ceil(forcing.settled / forcing.period - 1e-9) * forcing.period;
  return forcing;
}

}  // namespace rotorub::periodic
