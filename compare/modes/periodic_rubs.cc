#include "compare/modes/periodic_rubs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "native_model/periodic/forcing.h"
#include "native_model/prepare/periodic_start.h"
#include "native_model/prepare/prepare.h"
#include "native_model/prepare/repeating_model.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

bool are_alike(const PeriodicRub& a, const PeriodicRub& b) {
  // The largest values are those at instants of the runs, which differ.
  constexpr double kAlike = 1e-6, kSampled = 1e-2;
  const auto near = [](double x, double y, double share) {
    return std::abs(x - y) <= share * std::max(std::abs(x), std::abs(y));
  };
  const auto &f = a.figures[a.contact], &g = b.figures[b.contact];
  return a.kind == b.kind && a.contact == b.contact &&
         near(a.settled.motion.period, b.settled.motion.period, kAlike) &&
         near(f.mean_force, g.mean_force, kAlike) && near(f.amplitude, g.amplitude, kSampled) &&
         near(f.largest_force, g.largest_force, kSampled);
}

// In words, what a run does at its end without a period, from its figures there; empty if it rests.
std::string ending_of(const Model& m, const periodic::SettledMotion& settled) {
  constexpr int kPeriods = 16;
  if (!settled.last) return "";
  periodic::SettledMotion end;
  end.motion.start = *settled.last;
  const double loads = periodic::forcing_of(m).period;
  const double turn = 2.0 * std::numbers::pi / std::max(std::abs(m.speed), 1.0);
  end.motion.period = kPeriods * (loads > 0.0 ? loads : turn);
  end.order = kPeriods;
  const PeriodicRub rub = periodic_rub(m, std::move(end));
  const periodic::ContactFigures& f = rub.figures[rub.contact];
  const std::string force =
      f.mean_force > 0.0 ? fmt::format(", mean force {:.4g} N", f.mean_force) : "";
  return fmt::format("; at the end: {}, whirl {:.4g} rad/s{}", rub.kind, f.whirl, force);
}

// The free orbit, which runs may miss because they rub; empty if it touches a ring or there is
// none.
std::optional<State> free_orbit(const scene::Scene& scene) {
  scene::Scene free = scene;
  const double angle = scene.initial.spin_angle;
  free.initial = {};
  free.initial.spin_angle = angle;
  free.initial.steady = true;
  for (scene::AuxiliaryBearing& at : free.auxiliary) {
    if (!at.stator) continue;
    at.stator->position.setZero();
    at.stator->velocity.setZero();
  }
  try {
    return initial_state(prepare(free));
  } catch (const scene::SceneError&) {
    return std::nullopt;
  }
}

// Each sample ends a stretch, which is then shorter and cheaper than others.
constexpr int kMoreForSamples = 4;

bool has_sensor_errors(const scene::AuxiliaryBearing& at) {
  if (!at.controller || at.controller->sample_time <= 0.0) return false;
  const scene::Sensors& s = at.controller->sensors;
  const double errors[] = {s.position_noise,      s.velocity_noise,      s.current_noise,
                           s.position_resolution, s.velocity_resolution, s.current_resolution};
  return std::ranges::any_of(errors, [](double error) { return error > 0.0; });
}

// Names the sample times that were changed, and what the search leaves out.
std::string sampling_of(const scene::Scene& scene, const Model& given, const Model& searched) {
  const std::vector<double> own = periodic::sample_times(given),
                            changed = periodic::sample_times(searched);
  std::string changes;
  for (std::size_t k = 0; k < own.size(); ++k) {
    const double from = own[k], to = changed[k];
    if (std::abs(to - from) < 1e-12 * from) continue;
    const std::string change = fmt::format("{:.7g} instead of {:.7g} us", 1e6 * to, 1e6 * from);
    if (changes.find(change) != std::string::npos) continue;
    changes += (changes.empty() ? "" : ", ") + change;
  }
  std::string text;
  if (!changes.empty()) {
    const bool several = changes.find(',') != std::string::npos;
    text = several ? "The sample times of the controls are " + changes +
                         ", so that they divide the period of the loads."
                   : "The sample time of the control is " + changes +
                         ", so that it divides the period of the loads.";
  }
  if (std::ranges::any_of(scene.auxiliary, has_sensor_errors)) {
    text += text.empty() ? "" : " ";
    text += "The search ignores the noise and the resolution of the sensors.";
  }
  return text;
}

}  // namespace

PeriodicRubs lasting_rubs_by_shooting(const scene::Scene& scene, const ShootingOptions& options) {
  return with_place(scene, [&] {
    const Model given = prepare(scene), m = repeating_model(scene, given, prepare);
    PeriodicRubs all;
    const bool several = scene.auxiliary.size() > 1;
    for (std::size_t k = 0; k < scene.auxiliary.size(); ++k)
      all.contacts.push_back(several ? scene.name_of(k) : "");
    periodic::SettlingParameters parameters;
    parameters.duration = scene.run.end;
    parameters.most_checks = options.most_checks;
    parameters.most_periods = options.most_periods;
    parameters.interrupt = options.interrupt;
    all.refused = periodic::forcing_of(m).refusal;
    if (!all.refused.empty()) return all;
    all.sampling = sampling_of(scene, given, m);
    std::vector<rub::NamedStart> starts = rub::starts_near_rubs(scene, m);
    parameters.most_stretches = options.most_stretches / static_cast<std::int64_t>(starts.size());
    if (periodic::forcing_of(m).period > 0.0) {
      if (auto orbit = free_orbit(scene)) starts.push_back({"the free orbit", std::move(*orbit)});
    }
    if (!periodic::sample_times(m).empty()) parameters.most_stretches *= kMoreForSamples;
    for (const rub::NamedStart& start : starts) {
      if (parameters.is_interrupted()) break;
      periodic::SettledMotion settled = periodic::settled_motion(m, start.state, parameters);
      if (!settled.found()) {
        all.without.push_back({start.name, settled.refusal + ending_of(m, settled)});
        continue;
      }
      PeriodicRub rub = periodic_rub(m, std::move(settled));
      const auto same = std::ranges::find_if(
          all.rubs, [&](const PeriodicRub& other) { return are_alike(rub, other); });
      if (same == all.rubs.end()) {
        rub.starts = {start.name};
        all.rubs.push_back(std::move(rub));
      } else {
        same->starts.push_back(start.name);
      }
    }
    return all;
  });
}

}  // namespace rotorub
