#include "native_model/periodic/guesses.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "native_model/event/driver.h"
#include "native_model/model/dynamics.h"
#include "native_model/periodic/flow_derivative.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::periodic {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
// Distances of returns to the state, relative to its sizes.
constexpr double kAboutAsClose = 3.0, kClose = 2e-3;
constexpr int kHalvings = 40;

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
  while (run.compute_stretch()) run.pass();
  const Snapshot now = run.here();
  Arrival at{run.result().status, run.result().message, {}, run.system().rigid_contacts()};
  at.state.t = run.now();
  at.state.q = Eigen::Map<const Eigen::VectorXd>(now.q, m.nq());
  at.state.v = Eigen::Map<const Eigen::VectorXd>(now.v, m.nq());
  return at;
}

// s, the time after which a motion returns closest to its state at `at`, within `longest` (s). A
// return is a pass, in the same sense, through the plane that contains the state and is normal to
// its velocity. The first pass that is about as close as the closest one counts. 0 if there is
// none.
double return_time(const Model& m, const State& at, double longest,
                   const EventParameters& parameters, const TurningFrame& frame) {
  const MotionRecord motion = record_motion(m, at, at.t + longest, parameters);
  if (motion.status != Status::kOk) return 0.0;
  const EssentialState essential(m);
  const Eigen::VectorXd sizes = sizes_along(m, motion);
  const auto scaled = [&](const Eigen::VectorXd& y) {
    return essential.take(y.cwiseQuotient(sizes).eval().data());
  };
  const auto seen = [&](double t, const Eigen::VectorXd& y) {
    return frame.seen(y, t - motion.begin_time);
  };
  const auto away = [&](double t, const std::vector<double>& y) {
    return scaled(seen(t, as_vector(y)) - as_vector(motion.start));
  };
  FlowDerivative flow(m, sizes, parameters);
  const auto rate = [&](double t, const std::vector<double>& y, const ContactStates& contacts) {
    return scaled(frame.slope_seen(seen(t, as_vector(y)), seen(t, flow.slope(t, y, contacts))));
  };
  const Eigen::VectorXd slope = rate(motion.begin_time, motion.start, motion.first);
  std::vector<std::pair<double, double>> passes;  // time, distance
  double closest = kInfinity;
  for (std::size_t i = 0; i < motion.stretches.size(); ++i) {
    const Stretch& s = motion.stretches[i];
    const bool is_last = i + 1 == motion.stretches.size();
    const std::vector<double>& y_end = s.jump    ? s.jump->before
                                       : is_last ? motion.end
                                                 : motion.stretches[i + 1].y;
    const Eigen::VectorXd begin = away(s.t, s.y), end = away(s.end(), y_end);
    if (!(slope.dot(begin) < 0.0 && slope.dot(end) >= 0.0)) continue;
    // Hermite's cubic within the stretch.
    const Eigen::VectorXd rate_begin = s.length * rate(s.t, s.y, s.states),
                          rate_end = s.length * rate(s.end(), y_end, s.states);
    const auto within = [&](double x) -> Eigen::VectorXd {
      const double z = 1.0 - x;
      return z * z * (1.0 + 2.0 * x) * begin + x * x * (1.0 + 2.0 * z) * end +
             x * z * (z * rate_begin - x * rate_end);
    };
    double low = 0.0, high = 1.0;
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (low + high);
      (slope.dot(within(middle)) < 0.0 ? low : high) = middle;
    }
    const double distance = within(high).norm();
    passes.emplace_back(s.t + high * s.length - motion.begin_time, distance);
    closest = std::min(closest, distance);
  }
  for (const auto& [time, distance] : passes) {
    if (distance <= kAboutAsClose * closest + kClose) return time;
  }
  return 0.0;
}

int closed_contacts(const ContactStates& states) {
  return static_cast<int>(
      std::ranges::count_if(states, [](const auto& s) { return s.mode != ContactMode::kFree; }));
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

// Fills in the period, from a state that a motion has at its time. longest: s, see return_time.
void find_period(const Model& m, int periods, double longest, const EventParameters& parameters,
                 Guess& guess) {
  const Forcing forcing = forcing_of(m);
  if (guess.turning) {
    guess.period = return_time(m, guess.start, longest, parameters, TurningFrame(m));
  } else if (forcing.period > 0.0) {
    guess.period = periods * forcing.period;
  } else if (forcing.turns) {
    guess.turns = spin_speed(m, guess.start.v.data()) < 0.0 ? -periods : periods;
    guess.period = guess.turns * kTurn / spin_speed(m, guess.start.v.data());
  } else {
    guess.period = periods * return_time(m, guess.start, longest, parameters, {});
  }
}

FoundGuess failed(Status status, const std::string& message) { return {status, message, {}}; }

FoundGuess guess_of(const Model& m, Guess guess, double longest, int periods,
                    const EventParameters& parameters) {
  find_period(m, periods, longest, parameters, guess);
  if (!(guess.period > 0.0) || !std::isfinite(guess.period)) {
    return failed(Status::kNoSolution,
                  "the run does not come back to a state it had, so its period is unknown");
  }
  return at_best_instant(m, guess, parameters);
}

}  // namespace

FoundGuess guess_from_state(const Model& m, const State& state, double longest, int periods,
                            const EventParameters& parameters) {
  return guess_of(m, Guess{.start = state, .held = {}}, longest, periods, parameters);
}

FoundGuess guess_in_turning_frame(const Model& m, const State& state, double longest,
                                  const EventParameters& parameters) {
  return guess_of(m, Guess{.start = state, .held = {}, .turning = true}, longest, 1, parameters);
}

FoundGuess at_best_instant(const Model& m, const Guess& guess, const EventParameters& parameters) {
  const State& start = guess.start;
  const MotionRecord motion = record_motion(m, start, start.t + guess.period, parameters);
  if (motion.status != Status::kOk) return failed(motion.status, motion.message);
  const double instant = between_samples(m, best_instant(motion));
  const Arrival at = advance(m, start, instant, parameters);
  if (at.status != Status::kOk) return failed(at.status, at.message);
  FoundGuess found;
  found.guess = guess;
  found.guess.start = at.state;
  found.guess.held = at.held;
  return found;
}

}  // namespace rotorub::periodic
