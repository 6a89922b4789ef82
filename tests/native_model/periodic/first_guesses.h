// Starts for the search of periodic motions of a whole model: its own start (on an orbit or a rub,
// where `prepare` made it so), or where a run settles.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native_model/event/driver.h"
#include "native_model/model/dynamics.h"
#include "native_model/periodic/forcing.h"
#include "native_model/periodic/guesses.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::periodic {

// s, one turn of the fastest whirl of the relative centres at a state; 0 if nothing whirls.
inline double whirl_period(const Model& m, const State& at) {
  double fastest = 0.0;  // rad/s
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const ContactPoint p = contact_point(m, at.q.data(), at.v.data(), k);
    if (p.has_normal) fastest = std::max(fastest, std::abs(p.whirl_speed()) / p.delta);
  }
  return fastest > 0.0 ? 2.0 * std::numbers::pi / fastest : 0.0;
}

// From the model's start. In an autonomous system the period is one turn of the whirl if contacts
// last at the start; otherwise it is the time after which the motion returns.
inline FoundGuess guess_at_start(const Model& m) {
  constexpr double kTurnsWatched = 3.0;
  const State start = initial_state(m);
  FoundGuess found;
  const MotionRecord begun = record_motion(m, start, start.t + 1e-9);
  found.status = begun.status;
  found.message = begun.message;
  found.guess.start = start;
  for (std::size_t k = 0; k < begun.first.size(); ++k) {
    if (begun.first[k].mode == ContactMode::kFree || m.auxiliary[k].is_compliant()) continue;
    found.guess.held.push_back({k, velocity_of(begun.first[k].mode)});
  }
  const Forcing forcing = forcing_of(m);
  if (forcing.period == 0.0 && !forcing.turns && !found.guess.held.empty()) {
    found.guess.period = whirl_period(m, start);
    return found;
  }
  const FoundGuess returned = guess_from_state(m, start, kTurnsWatched * whirl_period(m, start));
  found.guess.period = returned.guess.period;
  found.guess.turns = returned.guess.turns;
  if (found.status == Status::kOk) found.status = returned.status;
  return found;
}

// From a run that lasts `duration` (s) after the last load is switched. In an autonomous system the
// run then continues for the same time, and the period is the time after which it returns.
inline FoundGuess guess_from_run(const Model& m, double duration) {
  const Forcing forcing = forcing_of(m);
  double end = forcing.settled + duration;
  if (forcing.period > 0.0) end = std::ceil(end / forcing.period) * forcing.period;
  Recorder recorder(m, {});
  EventIntegrator run(m, {});
  run.begin(initial_state(m), end, recorder);
  while (run.compute_stretch()) run.pass();
  FoundGuess failed;
  failed.status = run.result().status;
  failed.message = run.result().message;
  if (failed.status != Status::kOk) return failed;
  const Snapshot now = run.here();
  const State settled{run.now(), Eigen::Map<const Eigen::VectorXd>(now.q, m.nq()),
                      Eigen::Map<const Eigen::VectorXd>(now.v, m.nq())};
  return guess_from_state(m, settled, duration);
}

}  // namespace rotorub::periodic
