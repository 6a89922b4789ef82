#include "native_model/prepare/periodic_start.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>

#include "native_model/linear/rub_system.h"
#include "native_model/periodic/forcing.h"
#include "native_model/periodic/motion_record.h"
#include "native_model/periodic/periodic_rub.h"
#include "native_model/prepare/repeating_model.h"
#include "native_model/prepare/rub_start.h"
#include "native_model/rotor/refusal.h"

namespace rotorub::rub {
namespace {

using periodic::PeriodicRub;

// The state of the scene on a rub of its closed forms, without its weight; empty if there is none.
std::optional<State> state_on_closed_form(scene::Scene scene, scene::StartingRub rub) {
  scene.gravity.reset();
  scene.initial = {};
  scene.initial.rub = rub;
  for (scene::AuxiliaryBearing& at : scene.auxiliary) {
    if (!at.stator) continue;
    at.stator->position.setZero();
    at.stator->velocity.setZero();
  }
  try {
    return initial_state(make_model(scene, [&](Model& m) { put_on_closed_form(scene, m); }));
  } catch (const scene::SceneError&) {
    return {};
  } catch (const RotorNotSolvable&) {
    return {};
  }
}

const char* kind_asked(scene::StartingRub rub) {
  if (rub == scene::StartingRub::kSynchronous) return "synchronous rub";
  return rub == scene::StartingRub::kWhip ? "backward whip" : "rolling";
}

// The state of a motion at a time at which the loads have the phase of t = 0.
State at_phase_of_start(const Model& m, const periodic::PeriodicMotion& motion) {
  State state = motion.start;
  const double loads = periodic::forcing_of(m).period;
  if (loads > 0.0) {
    const double t = std::ceil(state.t / loads - 1e-9) * loads;
    const periodic::MotionRecord record = periodic::record_motion(m, state, t);
    state.q = Eigen::Map<const Eigen::VectorXd>(record.end.data(), m.nq());
    state.v = Eigen::Map<const Eigen::VectorXd>(record.end.data() + m.nq(), m.nq());
  }
  state.t = 0.0;
  const Layout& l = m.layout;
  // The controllers of the scene begin with an empty memory.
  state.q.conservativeResize(l.control_state());
  state.v.conservativeResize(l.control_state());
  state.q.tail(l.control_state() - l.ring_angle()).setZero();  // these coordinates do not act
  if (l.spin) state.q[l.phi()] = std::remainder(state.q[l.phi()], 2.0 * std::numbers::pi);
  return state;
}

[[noreturn]] void refuse_with(const scene::SceneError& no_form, const std::string& why) {
  std::vector<scene::Diagnostic> all = no_form.diagnostics();
  all.front().reason += "; a search for a periodic rub found none either: " + why;
  throw scene::SceneError(all);
}

}  // namespace

std::vector<NamedStart> starts_near_rubs(const scene::Scene& scene, const Model& m) {
  std::vector<NamedStart> starts{{"the scene's start", initial_state(m)}};
  const auto add = [&](const char* name, std::optional<State> state) {
    if (state) starts.push_back({name, std::move(*state)});
    return state.has_value();
  };
  const bool single = scene.auxiliary.size() == 1 && scene.has_contact();
  if (single) add("synchronous rub", state_on_closed_form(scene, scene::StartingRub::kSynchronous));
  if (!single || !add("whip", state_on_closed_form(scene, scene::StartingRub::kWhip))) {
    add("backward whirl", periodic::backward_whirl(m));
  }
  return starts;
}

State state_on_periodic_rub(const scene::Scene& scene, const scene::SceneError& no_form) {
  constexpr std::int64_t kMostStretches = 500'000;  // of all starts together
  constexpr int kMoreForSamples = 4;  // each ends a stretch, which is then cheaper than others
  const Model m = repeating_model(scene, model_without_start(scene), model_without_start);
  if (!m.has_contact()) throw no_form;
  const std::string refusal = periodic::forcing_of(m).refusal;
  if (!refusal.empty()) refuse_with(no_form, refusal);
  const std::vector<NamedStart> starts = starts_near_rubs(scene, m);
  periodic::SettlingParameters parameters;
  parameters.duration = scene.run.end;
  parameters.most_stretches = kMostStretches / static_cast<std::int64_t>(starts.size());
  if (!periodic::sample_times(m).empty()) parameters.most_stretches *= kMoreForSamples;
  std::string found;
  for (const NamedStart& start : starts) {
    periodic::SettledMotion settled = periodic::settled_motion(m, start.state, parameters);
    const auto kind_of = [&m](const periodic::SettledMotion& motion) {
      return motion.found() ? periodic::periodic_rub(m, motion).kind : "no periodic motion";
    };
    std::string kind = kind_of(settled), name = start.name;
    if (kind == kind_asked(scene.initial.rub)) {
      const State begin = at_phase_of_start(m, settled.motion);
      if (m.layout.control_states == 0) return begin;
      // The controllers begin with empty memories, which may end the rub.
      kind = kind_of(periodic::settled_motion(m, begin, parameters));
      if (kind == kind_asked(scene.initial.rub)) return begin;
      name = "this rub with controllers that begin at t = 0";
    }
    found += (found.empty() ? "the run from " : ", from ") + name + " settles to " + kind;
  }
  refuse_with(no_form, found);
}

}  // namespace rotorub::rub
