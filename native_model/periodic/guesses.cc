#include "native_model/periodic/guesses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "native_model/event/driver.h"
#include "native_model/model/dynamics.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::periodic {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// The whirl is measured over this many turns at its speed at the start.
constexpr double kTurnsWatched = 3.0;

struct Arrival {
  Status status = Status::kOk;
  std::string message;
  State state;
  HeldContacts held;
};

// The state at `end` (s), with the rigid contacts that last there.
Arrival advance(const Model& m, const State& start, double end, const EventParameters& parameters) {
  Recorder recorder(m, {});
  EventIntegrator run(m, parameters);
  run.begin(start, end, recorder);
  while (run.look_ahead()) run.pass();
  const Snapshot now = run.here();
  Arrival at{run.result().status, run.result().message, {}, run.phase().rigid_contacts()};
  at.state.t = run.now();
  at.state.q = Eigen::Map<const Eigen::VectorXd>(now.q, m.nq());
  at.state.v = Eigen::Map<const Eigen::VectorXd>(now.v, m.nq());
  return at;
}

// rad/s, the largest whirl speed of the relative centres at a state.
double whirl_speed(const Model& m, const State& at) {
  double largest = 0.0;
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const ContactPoint p = contact_point(m, at.q.data(), at.v.data(), k);
    if (p.has_normal) largest = std::max(largest, std::abs(p.whirl_speed()) / p.delta);
  }
  return largest;
}

// s, of `periods` whirls of the first contact after `at`, by the angle that its centre goes in the
// time of some turns.
double whirl_period(const Model& m, const State& at, int periods,
                    const EventParameters& parameters) {
  const double pace = whirl_speed(m, at);
  if (!(pace > 0.0)) return 0.0;
  const MotionRecord motion = record_motion(m, at, at.t + kTurnsWatched * kTurn / pace, parameters);
  double turned = 0.0;
  Eigen::Vector2d last = separation(m, motion.start.data());
  const auto meet = [&](const std::vector<double>& y) {
    const Eigen::Vector2d d = separation(m, y.data());
    turned += std::atan2(last.x() * d.y() - last.y() * d.x(), last.dot(d));
    last = d;
  };
  for (const Stretch& s : motion.stretches) meet(s.y);
  meet(motion.end);
  if (turned == 0.0) return 0.0;
  return periods * kTurn * (motion.end_time - motion.begin_time) / std::abs(turned);
}

int closed_contacts(const ContactStates& states) {
  return static_cast<int>(
      std::ranges::count_if(states, [](const auto& s) { return s.mode != Mode::kFree; }));
}

// s, the middle of the longest part of the motion without events, among those with the fewest
// closed contacts.
double best_instant(const MotionRecord& motion) {
  double best = motion.begin_time, longest = -1.0, begin = motion.begin_time;
  int fewest = kMaxContacts + 1;
  const auto meet = [&](double end, const ContactStates& states) {
    const int closed = closed_contacts(states);
    if (closed < fewest || (closed == fewest && end - begin > longest)) {
      fewest = closed;
      longest = end - begin;
      best = 0.5 * (begin + end);
    }
    begin = end;
  };
  for (const Stretch& s : motion.stretches) {
    if (s.jump) meet(s.end(), s.states);
  }
  meet(motion.end_time, motion.last);
  return best;
}

// Fills in the period, from a state that a motion has at its time.
void find_period(const Model& m, int periods, const EventParameters& parameters, Guess& guess) {
  const Forcing forcing = forcing_of(m);
  if (forcing.period > 0.0) {
    guess.period = periods * forcing.period;
  } else if (forcing.turns) {
    guess.turns = spin_speed(m, guess.start.v.data()) < 0.0 ? -periods : periods;
    guess.period = guess.turns * kTurn / spin_speed(m, guess.start.v.data());
  } else {
    guess.period = whirl_period(m, guess.start, periods, parameters);
  }
}

FoundGuess failed(Status status, const std::string& message) { return {status, message, {}}; }

}  // namespace

FoundGuess guess_at_start(const Model& m, int periods, const EventParameters& parameters) {
  FoundGuess found;
  const MotionRecord begun =
      record_motion(m, initial_state(m), initial_state(m).t + 1e-9, parameters);
  if (begun.status != Status::kOk) return failed(begun.status, begun.message);
  found.guess.start = initial_state(m);
  for (std::size_t k = 0; k < begun.first.size(); ++k) {
    if (begun.first[k].mode == Mode::kFree || m.auxiliary[k].gives()) continue;
    found.guess.held.push_back({k, velocity_of(begun.first[k].mode)});
  }
  find_period(m, periods, parameters, found.guess);
  const double pace = whirl_speed(m, found.guess.start);
  const bool whirls = forcing_of(m).period == 0.0 && found.guess.turns == 0;
  if (whirls && !found.guess.held.empty() && pace > 0.0)
    found.guess.period = periods * kTurn / pace;
  if (!(found.guess.period > 0.0) || !std::isfinite(found.guess.period)) {
    return failed(Status::kNoSolution, "the start does not whirl, so its period is unknown");
  }
  return found;
}

FoundGuess guess_from_run(const Model& m, double duration, int periods,
                          const EventParameters& parameters) {
  const Forcing forcing = forcing_of(m);
  double end = forcing.settled + duration;
  if (forcing.period > 0.0) end = std::ceil(end / forcing.period) * forcing.period;
  Arrival at = advance(m, initial_state(m), end, parameters);
  if (at.status != Status::kOk) return failed(at.status, at.message);
  FoundGuess found;
  found.guess.start = at.state;
  find_period(m, periods, parameters, found.guess);
  if (!(found.guess.period > 0.0) || !std::isfinite(found.guess.period)) {
    return failed(Status::kNoSolution, "the run comes to rest, so its period is unknown");
  }
  const MotionRecord motion = record_motion(m, at.state, end + found.guess.period, parameters);
  if (motion.status != Status::kOk) return failed(motion.status, motion.message);
  at = advance(m, at.state, best_instant(motion), parameters);
  if (at.status != Status::kOk) return failed(at.status, at.message);
  found.guess.start = at.state;
  found.guess.held = at.held;
  return found;
}

}  // namespace rotorub::periodic
