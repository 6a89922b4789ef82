#include "native_model/periodic/settled_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "native_model/event/driver.h"
#include "native_model/periodic/guesses.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub::periodic {
namespace {

// Relative to the sizes of the state.
constexpr double kNear = 0.05;         // a run that comes back this closely may have settled
constexpr double kCertain = 1e-3;      // more periods need not be tried
constexpr double kAsClose = 3.0;       // times the least distance: returns that count as close
constexpr double kFarthest = 0.2;      // largest distance between the run and the motion
constexpr double kReturnError = 1e-7;  // largest error of a run over kPeriodsRun periods
constexpr int kPeriodsRun = 3;
// A derivative takes about as long as this number of stretches for each stretch and direction.
constexpr int kStretchesOfDirection = 4;
// Newton's method begins if at least these are affordable, for a run that repeats within kRepeats
// also beyond the limit of the effort.
constexpr std::int64_t kLeastDerivatives = 3;
constexpr double kRepeats = 1e-6;
constexpr int kBeyondLimit = 4;

// One instant of a run at which it is checked.
class Check {
 public:
  Check(const ReturnMap& map, const SettlingParameters& parameters)
      : map_(&map),
        turning_(map.model(), parameters.search.event, true),
        parameters_(&parameters) {}

  // True if it found the motion.
  bool at(const State& state, double longest) {
    const bool autonomous = map_->forcing().period == 0.0 && !map_->forcing().turns;
    const int most = autonomous ? 1 : parameters_->most_periods;
    std::vector<Candidate> candidates;
    double closest = kInfinity;
    for (int n = 1; n <= most && closest > kCertain && stretches_ < most_stretches(); ++n) {
      if (parameters_->is_interrupted()) return false;
      const FoundGuess begun =
          guess_from_state(map_->model(), state, longest, n, parameters_->search.event);
      if (begun.status != Status::kOk) {
        why_ = begun.message;
        continue;
      }
      Return back = map_->at(begun.guess.start, begun.guess.period, begun.guess.turns);
      if (back.status != Status::kOk) why_ = back.message;
      // Finding the guess took about twice as many.
      stretches_ += 3 * static_cast<std::int64_t>(back.motion.stretches.size());
      closest = std::min(closest, back.residual);
      candidates.push_back({n, begun.guess, back.residual, back.motion.stretches.size()});
    }
    nearest_ = std::min(nearest_, closest);
    const auto first = std::ranges::find_if(candidates, [&](const Candidate& c) {
      return c.residual <= std::min(kNear, kAsClose * closest + kCertain);
    });
    if (first != candidates.end() && try_from(*first, autonomous)) return true;
    return turning_.frame().turns() && !is_exhausted() && try_in_turning_frame(state, longest);
  }

  void count() { ++stretches_; }
  bool is_exhausted() const { return stretches_ >= most_stretches(); }
  double nearest() const { return nearest_; }
  const std::string& why() const { return why_; }
  SettledMotion take() { return std::move(found_); }

 private:
  struct Candidate {
    int periods;
    Guess guess;
    double residual;
    std::size_t stretches;  // of its motion
  };

  std::int64_t most_stretches() const { return parameters_->most_stretches; }

  bool try_in_turning_frame(const State& state, double longest) {
    const FoundGuess begun =
        guess_in_turning_frame(turning_.model(), state, longest, parameters_->search.event);
    if (begun.status != Status::kOk) return false;
    const Return back = turning_.at(begun.guess.start, begun.guess.period, 0);
    const std::size_t stretches = back.motion.stretches.size();
    stretches_ += 3 * static_cast<std::int64_t>(stretches);
    nearest_ = std::min(nearest_, back.residual);
    return back.residual <= kNear && try_from({0, begun.guess, back.residual, stretches}, true);
  }

  bool try_from(const Candidate& c, bool autonomous) {
    const std::int64_t of_derivative =
        kStretchesOfDirection * static_cast<std::int64_t>(c.stretches) * map_->essential().size();
    SearchParameters search = parameters_->search;
    std::int64_t left = (most_stretches() - stretches_) / of_derivative;
    const bool is_affordable = kLeastDerivatives * of_derivative <= kBeyondLimit * most_stretches();
    if (c.residual <= kRepeats && is_affordable) left = std::max(left, kLeastDerivatives);
    if (left < kLeastDerivatives) {
      stretches_ = most_stretches();
      return false;
    }
    search.most_iterations =
        static_cast<int>(std::min<std::int64_t>(search.most_iterations, left - 1));
    PeriodicMotion motion = find_periodic_motion(map_->model(), c.guess, search);
    stretches_ += of_derivative * (motion.iterations + 1);
    if (!motion.found() || !motion.stable) return false;
    const int order = autonomous ? 0 : reduce(motion, c.periods);
    const ReturnMap& map = c.guess.turning ? turning_ : *map_;
    const Return there =
        map.at(motion.start, kPeriodsRun * motion.period, kPeriodsRun * motion.turns);
    if (!(there.residual <= kReturnError) || !(distance(c, motion, there) <= kFarthest)) {
      return false;
    }
    if (c.guess.turning && is_at_rest_in(map.frame(), there)) return false;
    found_.order = order;
    found_.run_time = c.guess.start.t;
    found_.return_error = there.residual;
    found_.motion = std::move(motion);
    return true;
  }

  // Takes the shortest period of a motion that was found with several; returns how many it has.
  int reduce(PeriodicMotion& motion, int periods) const {
    for (int n = 1; n < periods; ++n) {
      if (periods % n != 0) continue;
      const Guess guess{motion.start, motion.period * n / periods, motion.turns * n / periods,
                        motion.held, false};
      if (!(map_->at(guess.start, guess.period, guess.turns).residual <= kCertain)) continue;
      PeriodicMotion shorter = find_periodic_motion(map_->model(), guess, parameters_->search);
      if (!shorter.found() || !shorter.stable) continue;
      motion = std::move(shorter);
      return n;
    }
    return periods;
  }

  // True if nothing moves in the frame, so that every period is one of the motion.
  bool is_at_rest_in(const TurningFrame& frame, const Return& there) const {
    constexpr double kRests = 1e-6;  // relative to the sizes of the state
    const Eigen::VectorXd start = as_vector(there.motion.start);
    return std::ranges::all_of(there.motion.stretches, [&](const Stretch& s) {
      const Eigen::VectorXd moved =
          (frame.seen(as_vector(s.y), s.t - there.motion.begin_time) - start)
              .cwiseQuotient(there.sizes);
      return map_->essential().take(moved.data()).cwiseAbs().maxCoeff() <= kRests;
    });
  }

  // Between the run and the motion, relative to the sizes of the state.
  double distance(const Candidate& c, const PeriodicMotion& motion, const Return& there) const {
    Eigen::VectorXd apart(there.sizes.size());
    apart << motion.start.q - c.guess.start.q, motion.start.v - c.guess.start.v;
    const Eigen::VectorXd scaled = apart.cwiseQuotient(there.sizes);
    return map_->essential().take(scaled.data()).cwiseAbs().maxCoeff();
  }

  const ReturnMap* map_;
  ReturnMap turning_;  // the same in the frame that turns with the loads
  const SettlingParameters* parameters_;
  SettledMotion found_;
  double nearest_ = kInfinity;
  std::string why_;  // reason if there is no guess
  std::int64_t stretches_ = 0;
};

State state_of(const Model& m, EventIntegrator& run) {
  const Snapshot now = run.here();
  return {run.now(), Eigen::Map<const Eigen::VectorXd>(now.q, m.nq()),
          Eigen::Map<const Eigen::VectorXd>(now.v, m.nq())};
}

// True if nothing moves but what turns: rotor and rings would go less than kRestingPath of their
// sizes in `duration` (s).
bool is_at_rest(const Model& m, const State& at, double duration) {
  constexpr double kRestingPath = 1e-6;
  Eigen::VectorXd y(2 * m.nq());
  y << at.q, at.v;
  const Eigen::VectorXd sizes = EssentialState::sizes(m, {y.data()});
  for (int i = 0; i < m.layout.mechanical(); ++i) {
    if (m.layout.turns(i)) continue;
    if (std::abs(at.v[i]) * duration > kRestingPath * sizes[i]) return false;
  }
  return true;
}

// The start with empty memories of the sampled controllers if it has none.
State with_memories(const Model& m, State start) {
  const Eigen::Index given = start.q.size(), added = m.nq() - given;
  for (Eigen::VectorXd* entries : {&start.q, &start.v}) {
    entries->conservativeResize(m.nq());
    entries->tail(added).setZero();
  }
  return start;
}

SettledMotion refused(std::string why) {
  SettledMotion none;
  none.refusal = std::move(why);
  return none;
}

std::string in_seconds(double t) {
  std::string text = std::to_string(t);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " s";
}

}  // namespace

SettledMotion settled_motion(const Model& m, const State& start, const SettlingParameters& p) {
  const ReturnMap map(m, p.search.event);
  if (!map.forcing().refusal.empty()) return refused(map.forcing().refusal);
  Recorder recorder(m, {});
  EventIntegrator run(m, p.search.event);
  const double begin = std::max(start.t, map.forcing().settled);
  Check check(map, p);
  for (int k = 0; k < p.most_checks && !check.is_exhausted(); ++k) {
    const double end = between_samples(m, begin + p.duration * std::exp2(k));
    if (k == 0) {
      run.begin(with_memories(m, start), end, recorder);
    } else {
      run.extend_end(end);
    }
    while (!check.is_exhausted() && !p.is_interrupted() && run.compute_stretch()) {
      run.pass();
      check.count();
    }
    if (p.is_interrupted()) return refused("interrupted");
    if (run.result().status != Status::kOk) {
      return refused("the run ends at " + in_seconds(run.now()) + ": " + run.result().message);
    }
    if (check.is_exhausted() && run.now() < end) break;
    const State now = state_of(m, run);
    if (map.forcing().period == 0.0 && is_at_rest(m, now, p.duration)) {
      return refused("the run comes to rest");
    }
    if (check.at(now, p.duration)) return check.take();
  }
  std::string why = "no periodic motion after " + in_seconds(run.now());
  if (std::isfinite(check.nearest())) {
    char nearest[40];
    std::snprintf(nearest, sizeof nearest, "%.2g", 100.0 * check.nearest());
    why += std::string(" (the run repeats to within ") + nearest + " % over at most " +
           std::to_string(p.most_periods) + (p.most_periods == 1 ? " period)" : " periods)");
  } else if (!check.why().empty()) {
    why += " (" + check.why() + ")";
  }
  if (check.is_exhausted()) why += ", when the search reached its limit of effort";
  SettledMotion none = refused(why);
  none.last = state_of(m, run);
  return none;
}

}  // namespace rotorub::periodic
