#include "compare/modes/periodic_rubs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "native_model/model/dynamics.h"
#include "native_model/model/linear_parts.h"
#include "native_model/periodic/forcing.h"
#include "native_model/prepare/prepare.h"
#include "native_model/rotor/refusal.h"

namespace rotorub {
namespace {

struct Start {
  std::string name;
  State state;
};

// The state of the scene on a rub of its closed forms, without its weight; empty if there is none.
std::optional<State> state_on_rub(scene::Scene scene, scene::StartingRub rub) {
  scene.gravity.reset();
  scene.initial = {};
  scene.initial.rub = rub;
  for (scene::AuxiliaryBearing& at : scene.auxiliary) {
    if (!at.stator) continue;
    at.stator->position.setZero();
    at.stator->velocity.setZero();
  }
  try {
    return with_place(scene, [&] { return initial_state(prepare(scene)); });
  } catch (const scene::SceneError&) {
    return {};
  }
}

// A backward whirl of the first bending mode, faster than the free whirl, together with the ring of
// the first contact, so that they press on each other. Empty if the machine has no such state.
std::optional<State> backward_whirl(const Model& m) {
  constexpr double kOfClearance = 0.98, kOfRing = 0.35;  // of the clearance: rotor in ring, ring
  constexpr double kOfFrequency = 1.4, kLeastShape = 1e-6;
  const Layout& l = m.layout;
  const AuxiliaryBearing& at = m.first();
  const bool drags = at.contact && at.contact->friction.sticking() > 0.0;
  if (m.speed == 0.0 || l.modes == 0 || !drags) return {};
  const double shape_x = at.shape.x[0], shape_y = at.shape.y[0];
  if (std::min(std::abs(shape_x), std::abs(shape_y)) < kLeastShape) return {};
  const LinearParts parts = linear_parts(m, m.speed);
  const double pace = kOfFrequency * std::sqrt(parts.stiffness(0, 0) / parts.mass[0]);
  if (!(pace > 0.0)) return {};
  const double backward = m.speed > 0.0 ? -pace : pace, clearance = at.contact->clearance;
  State state = initial_state(m);
  const Eigen::Index bending = 2 * l.modes;
  state.q.head(bending).setZero();
  state.v.head(bending).setZero();
  double ring = 0.0;  // m, from its place at rest
  if (at.moves()) {
    ring = kOfRing * clearance;
    state.q.segment<2>(at.ring) = Eigen::Vector2d(ring, 0.0);
    state.v.segment<2>(at.ring) = Eigen::Vector2d(0.0, backward * ring);
  }
  const double reach = kOfClearance * clearance;
  const Eigen::Vector2d away = Eigen::Vector2d(reach, 0.0) - separation(m, state.q.data());
  state.q[l.x()] = away.x() / shape_x;
  state.q[l.y()] = away.y() / shape_y;
  state.v[l.y()] = backward * (ring + reach) / shape_y;
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const auto& contact = m.auxiliary[k].contact;
    if (contact && separation(m, state.q.data(), k).norm() > contact->clearance) return {};
  }
  return state;
}

std::vector<Start> starts_of(const scene::Scene& scene, const Model& m) {
  std::vector<Start> starts{{"the scene's start", initial_state(m)}};
  const auto add = [&](const char* name, std::optional<State> state) {
    if (state) starts.push_back({name, std::move(*state)});
    return state.has_value();
  };
  const bool single = scene.auxiliary.size() == 1 && scene.first().contact;
  if (single) add("synchronous rub", state_on_rub(scene, scene::StartingRub::kSynchronous));
  if (!single || !add("whip", state_on_rub(scene, scene::StartingRub::kWhip))) {
    add("backward whirl", backward_whirl(m));
  }
  return starts;
}

std::string kind_of(const PeriodicRub& rub) {
  constexpr double kWhole = 1e-6;
  const periodic::ContactFigures& f = rub.figures[rub.contact];
  const periodic::PeriodicMotion& motion = rub.settled.motion;
  const bool touches = std::ranges::any_of(
      rub.figures, [](const auto& of) { return of.impacts > 0 || of.contact_share > 0.0; });
  if (!touches) return "no contact";
  if (f.impacts > 0) return "bouncing";
  const double turns = f.whirl * motion.period / (2.0 * std::numbers::pi);
  const bool goes_around = std::abs(turns) > 0.5;
  if (f.stuck_share > 1.0 - kWhole) return goes_around ? "rolling" : "sticking";
  if (f.stuck_share > kWhole) return "stick-slip";
  if (!goes_around) return "rub on one side";
  if (turns * rub.spin < 0.0) return "backward whip";
  return std::lround(std::abs(turns)) == rub.settled.order ? "synchronous rub" : "forward whirl";
}

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

}  // namespace

PeriodicRub periodic_rub(const Model& m, periodic::SettledMotion settled) {
  PeriodicRub rub;
  rub.figures = periodic::period_figures(m, settled.motion).contacts;
  rub.spin = spin_speed(m, settled.motion.start.v.data());
  rub.settled = std::move(settled);
  rub.contact = static_cast<std::size_t>(
      std::ranges::max_element(rub.figures, {}, &periodic::ContactFigures::mean_force) -
      rub.figures.begin());
  rub.kind = kind_of(rub);
  return rub;
}

double PeriodicRub::largest_multiplier() const {
  const auto& all = settled.motion.multipliers;
  return all.empty() ? 0.0 : std::abs(all.front());
}

PeriodicRubs lasting_rubs_by_shooting(const scene::Scene& scene, const ShootingOptions& options) {
  return with_place(scene, [&] {
    const Model m = prepare(scene);
    PeriodicRubs all;
    const bool several = scene.auxiliary.size() > 1;
    for (std::size_t k = 0; k < scene.auxiliary.size(); ++k)
      all.contacts.push_back(several ? scene.name_of(k) : "");
    periodic::SettlingParameters parameters;
    parameters.duration = scene.run.end;
    parameters.most_checks = options.most_checks;
    parameters.most_periods = options.most_periods;
    all.refused = periodic::forcing_of(m).refusal;
    if (!all.refused.empty()) return all;
    const std::vector<Start> starts = starts_of(scene, m);
    parameters.most_stretches = options.most_stretches / static_cast<std::int64_t>(starts.size());
    for (const Start& start : starts) {
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
