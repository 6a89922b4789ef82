#include "native_model/periodic/forcing.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "native_model/control/magnetic_library.h"
#include "native_model/model/control_states.h"
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
  if (m.base) std::ranges::for_each(m.base->breaks(), meet);
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (!at.controller) continue;
    meet(at.control_on);
    for (const double t : at.controller->breaks(at.control_on)) meet(t);
  }
  // The first sample of a control differs from the others.
  for (const double sample_time : sample_times(m)) latest += sample_time;
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
  const std::vector<double> samples = sample_times(m);
  if (!samples.empty() && of_loads.empty() && spin_angle_acts(m)) {
    return "a sampled control has no period in common with a motion whose period follows from the "
           "free spin; hold the spin, or use a control without sample_time";
  }
  if (!samples.empty() && of_loads.empty()) {
    return "a sampled control has no period in common with a motion without loads; add an "
           "unbalance or a rotating force, or use a control without sample_time";
  }
  constexpr const char* kLeftOut =
      "this command does not run the user's control law, so the motion is unknown";
  for (const SampledFeedback& s : m.samplers) {
    if (s.library && s.library->is_left_out()) return kLeftOut;
  }
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (at.recorded) return "recorded commands are not supported";
    if (at.loop && !has_control_states(at)) {
      return "the coordinates and the memories of the sampled controllers are more than " +
             std::to_string(kMaxCoordinates) + " numbers; shorten the delays";
    }
    if (at.controller && at.controller->is_left_out()) return kLeftOut;
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
  const auto is_split = [&](double sample_time) {
    const double count = *common_period(of_loads) / sample_time;
    return std::abs(count - std::round(count)) > kSameFrequency * count;
  };
  if (std::ranges::any_of(samples, is_split)) {
    return "a sample time of a control does not divide the period of the loads, and would have to "
           "change by more than 10 %";
  }
  return "";
}

}  // namespace

std::vector<double> sample_times(const Model& m) {
  std::vector<double> all;
  for (const SampledFeedback& s : m.samplers) all.push_back(s.sample_time);
  for (const AuxiliaryBearing& at : m.auxiliary) {
    if (at.loop) all.push_back(at.sample_time);
  }
  return all;
}

double period_of_loads(const Model& m) {
  const std::vector<double> of_loads = frequencies(m);
  return of_loads.empty() ? 0.0 : common_period(of_loads).value_or(0.0);
}

double whole_sample_time(double sample_time, double period) {
  constexpr double kMostChange = 0.1;
  const double whole = period / std::max(1.0, std::round(period / sample_time));
  return std::abs(whole - sample_time) <= kMostChange * sample_time ? whole : sample_time;
}

double between_samples(const Model& m, double t) {
  const std::vector<double> all = sample_times(m);
  if (all.empty()) return t;
  const double longest = std::ranges::max(all);
  std::vector<double> samples;
  for (const double sample_time : all) {
    for (double k = std::floor(t / sample_time); k * sample_time < t + 2.0 * longest; ++k)
      samples.push_back(k * sample_time);
  }
  std::ranges::sort(samples);
  double best = t, gap = 0.0;
  for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
    const double middle = 0.5 * (samples[k] + samples[k + 1]);
    if (middle < t || samples[k + 1] - samples[k] <= (1.0 + kSameFrequency) * gap) continue;
    best = middle;
    gap = samples[k + 1] - samples[k];
  }
  return best;
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
