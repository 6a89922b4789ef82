#include "compare/study/scene_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <numeric>

#include "compare/base/in_parallel.h"
#include "compare/engine/mujoco_engine.h"
#include "compare/own/own_machine.h"
#include "compare/study/comparison_runs.h"
#include "compare/study/twins.h"
#include "compare/study/verdict.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/trajectory/recorder.h"

namespace rotorub {
namespace {

// A share of the smallest clearance, or without a contact of the rotor's largest deflection, m.
double divergence_threshold(const scene::Scene& scene, const Trajectory& native) {
  if (const auto clearance = smallest_clearance(scene)) return kDivergenceShare * *clearance;
  double largest = 0.0;
  const auto &x = native.column("rotor_x"), &y = native.column("rotor_y");
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, std::hypot(x[i], y[i]));
  return std::max(kDivergenceShare * largest, 1e-12);
}

// Without a controller. In magnetic bearings the bias currents balance the pull of the magnets.
scene::Scene without_control(scene::Scene scene) {
  const double on = scene.first().controller->on;
  scene.first().controller = scene::Controller{};
  scene.first().controller->on = on;
  return scene;
}

double total_work(const std::vector<Contestant>& all, const CompareOptions& options) {
  const bool ladder = options.mode != CompareMode::kResync;
  double total = 1.0 + (ladder ? options.twins : 0);
  for (const Contestant& c : all) total += c.work * (1.0 + options.timing_repeats);
  for (const Contestant& c : all) total += ladder ? c.work * (2.0 + 4.0) : 1.0;
  // In replay each MuJoCo side has its own native run.
  if (options.mode == CompareMode::kReplay) total += 3.0 + 2.0 * (1.0 + 2.0 + 4.0);
  if (options.modes_ladder && ladder) total += kLadderWork;
  return total;
}

// One MuJoCo side compared with the native one and judged, without the reasons. threshold: m; two
// runs have parted when they are further apart.
SideDifference side_difference(const Side& native, const Side& other, const Repeatability& natives,
                               const Repeatability& others, const CompareOptions& options,
                               double threshold) {
  SideDifference d;
  d.decides = other.label == to_string(options.contact);
  for (std::size_t k = 0; k < figures().size(); ++k) {
    const Figure& f = figures()[k];
    d.figures.push_back({judged(f, natives.samples[k], others.samples[k], options.tolerance,
                                natives.replay_floor[k]),
                         natives.floor[k], natives.replay_floor[k],
                         split(native.limits[k], other.limits[k])});
  }
  const bool ended_well =
      native.trajectory.status == Status::kOk && other.trajectory.status == Status::kOk;
  d.trust = ended_well ? trust(d.judged()) : Trust::kNo;
  d.divergence = divergence(native.trajectory, other.trajectory, threshold);
  d.impacts = pair_impacts(native.trajectory, other.trajectory, options.impacts);
  return d;
}

void leave_undecided(SideDifference& d) {
  for (FigureDifference& f : d.figures) {
    if (f.verdict != FigureVerdict::kNotJudged) f.verdict = FigureVerdict::kUndecidable;
  }
  d.trust = Trust::kUndecidable;
}

// Builds up a comparison.
class Comparison {
 public:
  Comparison(const scene::Scene& scene, const CompareOptions& options)
      : options_(options),
        all_(contestants(scene, options)),
        runner_(scene, options, total_work(all_, options)),
        times_(dense_times(scene.run, options.rows)),
        model_(prepare(scene)),
        tapes_(all_.size()) {
    result_.scene = scene;
    result_.mode = options.mode;
    if (options.own) {
      result_.own = true;
      result_.twin_limits = options.own->limits();
    }
    result_.commands = has_commands(scene);
    result_.tolerance = options.tolerance;
    for (std::size_t k = 0; k < all_.size(); ++k) onsets_.emplace_back(model_);
  }

  SceneComparison run() {
    show();
    if (!runner_.interrupted()) measure_omissions();
    if (!runner_.interrupted()) look_closer();
    if (options_.modes_ladder && !resyncs() && !runner_.interrupted()) {
      result_.model_error = runner_.model_error(repeats(result_.sides[0]));
    }
    if (runner_.interrupted()) {
      result_.interrupted = true;
    } else {
      judge();
    }
    return std::move(result_);
  }

 private:
  // Whether each MuJoCo side has its own native run.
  bool replays() const { return options_.mode == CompareMode::kReplay && result_.commands; }
  bool resyncs() const { return options_.mode == CompareMode::kResync; }
  std::shared_ptr<const CommandRecord> commands(std::size_t side, std::size_t rung = 0) const {
    return result_.commands ? tapes_[side][rung].record() : nullptr;
  }
  std::shared_ptr<const CommandRecord> replayed_commands(std::size_t side) const {
    return replays() ? commands(side) : nullptr;
  }

  // Runs every engine with the rows that plots and residuals need, on all processors; the runs for
  // timing come later, one at a time. A MuJoCo run must precede the native run that its commands
  // drive.
  void show() {
    result_.sides.resize(all_.size());
    if (replays()) result_.natives.resize(all_.size() - 2);
    in_parallel(all_.size(), options_.jobs, nullptr, {}, [&](std::size_t k) {
      if (k == 0) return replays() ? void() : show_native(1);
      if (runner_.interrupted()) return;
      RunRequest request;
      request.watch = [this, k](const WatchedStep& step) {
        if (result_.commands) tapes_[k][0].add(step);
        if (resyncs()) onsets_[k].step(step);
      };
      result_.sides[k] = runner_.shown(all_[k], std::move(request));
      if (replays()) show_native(k);
    });
    if (runner_.interrupted()) {
      const auto not_run = [](const Side& side) { return side.label.empty(); };
      std::erase_if(result_.sides, not_run);
      std::erase_if(result_.natives, not_run);
      return;
    }
    result_.shadow = shadow_column(runner_, result_.sides[0], commands(1), options_);
    if (result_.commands && !result_.own) run_without_control();
    lay_measured_in();
  }

  // Done before the longer part of the work, because it may fail.
  void lay_measured_in() {
    if (!options_.measured || runner_.interrupted()) return;
    std::vector<RunToHold> runs;
    for (const Side& side : result_.sides) runs.push_back({side.label, &side.trajectory});
    try {
      result_.measured = lay_in(*options_.measured, options_.alignment, result_.scene, runs);
    } catch (const MeasuredError&) {
      // If the run did not reach its end, its own status is reported instead.
      if (result_.sides.front().trajectory.status == Status::kOk) throw;
    }
  }

  // Measures what the twin of a user's own machine leaves out, relative to the contact force.
  void measure_omissions() {
    constexpr double kSaid = 1e-4;  // smallest share that is reported
    const Side &native = result_.sides[0], &decider = result_.sides[1];
    if (!options_.own || decider.trajectory.status != Status::kOk) return;
    const double touching = decider.metrics.mean_force;
    const double force = touching > 0.0 ? touching : native.metrics.mean_force;
    if (!(force > 0.0)) return;
    double largest = options_.tolerance;
    for (const Omission& o : options_.own->omissions(options_.contact, options_.interrupt)) {
      if (o.share(force) > kSaid) result_.twin_limits.push_back(o.sentence(force));
      if (o.share(force) <= largest) continue;
      largest = o.share(force);
      result_.omission = o.sentence(force);
    }
  }

  // For the plots, by `verlet`, the fastest integrator.
  void run_without_control() {
    RunRequest request;
    request.output_times = times_;
    try {
      request.interrupt = options_.interrupt;
      Trajectory t =
          native_engine(scene::Integrator::kVerlet)->run(without_control(result_.scene), request);
      if (t.status == Status::kOk) result_.uncontrolled = std::move(t);
    } catch (const scene::SceneError&) {  // no curve for scenes that `verlet` does not accept
    }
  }

  void show_native(std::size_t driven_by) {
    RunRequest request;
    request.commands = replayed_commands(driven_by);
    native_side(driven_by) = runner_.shown(all_[0], std::move(request));
  }
  Side& native_side(std::size_t driven_by) {
    return driven_by == 1 ? result_.sides[0] : result_.natives[driven_by - 2];
  }

  // Runs twins, smaller steps or single contacts, and the timing.
  void look_closer() {
    result_.twin.threshold = divergence_threshold(result_.scene, result_.sides[0].trajectory);
    if (resyncs()) {
      for (Side& side : result_.sides) {
        leave_limits("resync makes no runs at smaller steps", side);
      }
      predict_onsets();
    } else {
      run_twins_of_both();
      climb();
    }
    if (replays() && !runner_.interrupted()) replay_floor_ = replay_floor(runner_, result_.scene);
    time_runs(runner_, all_, options_.timing_repeats, replayed_commands(1), result_.sides);
  }

  // Runs as many twins as the verdicts need: native ones for all sides, and twins of the run that
  // decides.
  void run_twins_of_both() {
    TwinParameters parameters;
    parameters.output_times = times_;
    parameters.commands = replayed_commands(1);
    parameters.enough = [this](const Twins& natives) {
      if (natives.metrics.empty()) return false;
      for (std::size_t k = 1; k < result_.sides.size(); ++k) {
        if (!is_settled(k, natives, {})) return false;
      }
      return true;
    };
    twins_ =
        runner_.twins(all_[0], result_.sides[0].trajectory, result_.twin.threshold, parameters);
    result_.twins = static_cast<int>(twins_.metrics.size());
    result_.twin = first_to_part(twins_, result_.twin);
    if (runner_.interrupted() || !decider_may_have_twins()) return;
    parameters.commands = nullptr;
    parameters.enough = [this](const Twins& others) { return is_settled(1, twins_, others); };
    decider_twins_ =
        runner_.twins(all_[1], result_.sides[1].trajectory, result_.twin.threshold, parameters);
    result_.decider_twins = static_cast<int>(decider_twins_.metrics.size());
  }

  // Whether further twins would not change any verdict of a side.
  bool is_settled(std::size_t side, const Twins& natives, const Twins& others) const {
    const Side &native = result_.reference(side), &other = result_.sides[side];
    if (native.trajectory.status != Status::kOk || other.trajectory.status != Status::kOk)
      return true;
    return std::ranges::all_of(figures(), [&](const Figure& f) {
      return rotorub::is_settled(
          judged(f, figure_sample(f, native.metrics, natives.metrics),
                 figure_sample(f, other.metrics, others.metrics), options_.tolerance),
          options_.tolerance);
    });
  }

  std::vector<std::size_t> dearest_first() const {
    std::vector<std::size_t> order(all_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::sort(order, std::greater{},
                      [this](std::size_t k) { return result_.sides[k].trajectory.wall_s; });
    return order;
  }

  // Runs all sides at half the step, then those at a quarter where it matters.
  void climb() {
    std::vector<Ladder> ladders(all_.size()), native_ladders(all_.size());
    const auto test = [this](std::size_t side) {
      const Side& native = result_.reference(side);
      return StepTest{native.metrics, options_.tolerance,
                      single_run_intervals(repeats(native).samples)};
    };
    const auto is_needed = [&](std::size_t k, std::size_t rung) {
      if (!all_[k].climbs || (replays() && k == 0)) return false;
      if (result_.sides[k].trajectory.status != Status::kOk) return false;
      if (rung == 1) return true;
      return needs_quarter(result_.sides[k], ladders[k][1], test(k)) ||
             (replays() && needs_quarter(native_side(k), native_ladders[k][1], test(k)));
    };
    const std::vector<std::size_t> order = dearest_first();
    for (std::size_t rung = 1; rung < kRungs; ++rung) {
      in_parallel(all_.size(), options_.jobs, options_.interrupt, {}, [&](std::size_t job) {
        const std::size_t k = order[job];
        if (!is_needed(k, rung)) return;
        RunRequest request;
        request.output_times = times_;
        if (replays()) request.watch = tapes_[k][rung].watch();
        ladders[k][rung] = run_rung(runner_, all_[k], rung, request);
        if (!replays() || native_side(k).trajectory.status != Status::kOk) return;
        // Driven by the commands of its own MuJoCo run at that step.
        request.watch = {};
        request.commands = commands(k, rung);
        native_ladders[k][rung] = run_rung(runner_, all_[0], rung, request);
      });
    }
    if (runner_.interrupted()) return;
    const auto climbed = [&](std::size_t k, const Ladder& ladder, Side& side) {
      if (!all_[k].climbs) return leave_limits("it is shown at the scene's step alone", side);
      if (result_.sides[k].trajectory.status != Status::kOk)
        return leave_limits("the run did not end well", side);
      set_limits(ladder, test(k), side);
    };
    for (std::size_t k = replays() ? 1 : 0; k < all_.size(); ++k) {
      climbed(k, ladders[k], result_.sides[k]);
      if (replays()) climbed(k, native_ladders[k], native_side(k));
    }
  }

  void predict_onsets() {
    for (std::size_t k = 1; k < all_.size() && !runner_.interrupted(); ++k) {
      const Trajectory& mujoco = result_.sides[k].trajectory;
      const int left_out = onsets_[k].left_out();
      auto predicted =
          predict(result_.scene, onsets_[k].finish(mujoco.end), commands(k), result_.scene.run.step,
                  runner_.part(all_[0].work, "onsets of " + all_[k].label), options_.interrupt);
      resyncs_.push_back(judge_resync(std::move(predicted), mujoco.statistics.impulse_total > 0.0,
                                      options_.tolerance));
      resyncs_.back().left_out = left_out;
    }
  }

  Repeatability repeats(const Side& native) const {
    Repeatability found = repeatability(native.metrics, twins_);
    for (std::size_t k = 0; k < replay_floor_.size(); ++k) found.replay_floor[k] = replay_floor_[k];
    return found;
  }

  // If a native figure scatters by more than a tenth of the tolerance, the scatter of the run that
  // decides matters as well.
  bool decider_may_have_twins() const {
    constexpr double kMatters = 0.1;
    if (resyncs() || replays() || result_.own) return false;
    const Repeatability native = repeats(result_.sides[0]);
    for (std::size_t k = 0; k < figures().size(); ++k) {
      const FigureSample& s = native.samples[k];
      if (!figures()[k].is_judged() || std::isnan(s.mean)) continue;
      if (share_of(figures()[k], s.mean, s.deviation) > kMatters * options_.tolerance) return true;
    }
    return false;
  }

  // Computes the differences and their reasons.
  void judge() {
    for (std::size_t k = 1; k < result_.sides.size(); ++k) {
      const Side &native = result_.reference(k), &other = result_.sides[k];
      const Repeatability others = repeatability(other.metrics, k == 1 ? decider_twins_ : Twins{});
      SideDifference d =
          side_difference(native, other, repeats(native), others, options_, result_.twin.threshold);
      if (resyncs()) {
        d.resync = std::move(resyncs_[k - 1]);
        if (result_.sides[k].trajectory.status == Status::kOk) d.trust = d.resync->trust;
      }
      const bool ended_well =
          native.trajectory.status == Status::kOk && other.trajectory.status == Status::kOk;
      if (ended_well && !result_.omission.empty()) leave_undecided(d);
      d.reasons = reasons(result_, k, d);
      result_.differences.push_back(std::move(d));
    }
  }

  const CompareOptions& options_;
  SceneComparison result_;
  std::vector<Contestant> all_;
  Runner runner_;
  std::vector<double> times_;
  Model model_;
  std::vector<std::array<CommandTape, kRungs>> tapes_;  // per contestant and rung
  std::vector<OnsetWatch> onsets_;                      // per contestant
  std::vector<Resync> resyncs_;                         // of sides[1], sides[2], ...
  Twins twins_, decider_twins_;                         // of sides[0] and sides[1]
  std::vector<double> replay_floor_;                    // empty except in replay
  MujocoInPlace mujoco_;                                // for runs in several threads
};

constexpr const char* kModes[] = {"lockstep", "replay", "resync"};  // in the order of CompareMode

}  // namespace

const char* to_string(CompareMode mode) { return kModes[static_cast<int>(mode)]; }

CompareMode compare_mode_of(const std::string& name) {
  const auto found = std::find(std::begin(kModes), std::end(kModes), name);
  assert(found != std::end(kModes));
  return static_cast<CompareMode>(found - std::begin(kModes));
}

std::string Side::early_end() const {
  if (trajectory.status == Status::kOk) return "";
  return fmt::format("the {} run ended early ({}): {}", label, to_string(trajectory.status),
                     trajectory.message);
}

Status SceneComparison::status() const {
  for (std::size_t k = 0; k < std::min<std::size_t>(2, sides.size()); ++k) {
    if (sides[k].trajectory.status != Status::kOk) return sides[k].trajectory.status;
  }
  return interrupted ? Status::kInterrupted : Status::kOk;
}

bool SceneComparison::within() const {
  const auto decides = std::find_if(differences.begin(), differences.end(),
                                    [](const SideDifference& d) { return d.decides; });
  return decides != differences.end() && decides->within();
}

SceneComparison compare_scene(const scene::Scene& scene, const CompareOptions& options) {
  return Comparison(scene, options).run();
}

bool is_absent(const SceneComparison& comparison, const Figure& figure) {
  return std::all_of(comparison.sides.begin(), comparison.sides.end(),
                     [&figure](const Side& s) { return std::isnan(figure.value(s.metrics)); });
}

}  // namespace rotorub
