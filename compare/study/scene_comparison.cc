#include "compare/study/scene_comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>
#include <span>

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

double total_work(const std::vector<ComparedEngine>& all, const CompareOptions& options) {
  const bool ladder = options.mode != CompareMode::kResync;
  double total = 1.0 + (ladder ? options.twins : 0);
  for (const ComparedEngine& c : all) total += c.work * (1.0 + options.timing_repeats);
  for (const ComparedEngine& c : all) total += ladder ? c.work * (2.0 + 4.0) : 1.0;
  // In replay each MuJoCo side has its own native run.
  if (options.mode == CompareMode::kReplay) total += 3.0 + 2.0 * (1.0 + 2.0 + 4.0);
  if (options.modes_ladder && ladder) total += kLadderWork;
  return total;
}

void leave_undecided(ComparedModel& m) {
  for (FigureDifference& f : m.figures) {
    if (f.verdict != FigureVerdict::kNotJudged) f.verdict = FigureVerdict::kUndecidable;
  }
  m.trust = Trust::kUndecidable;
}

// Builds up a comparison.
class Comparison {
 public:
  Comparison(const scene::Scene& scene, const CompareOptions& options)
      : options_(options),
        all_(compared_engines(scene, options)),
        runner_(scene, options, total_work(all_, options)),
        times_(dense_times(scene.run, options.rows)),
        model_(prepare(scene)) {
    result_.scene = scene;
    result_.mode = options.mode;
    if (options.own) {
      result_.own = true;
      result_.twin_limits = options.own->limits();
    }
    result_.commands = has_commands(scene);
    result_.tolerance = options.tolerance;
    result_.models.resize(all_.size() - 1);
    for (std::size_t k = 0; k < all_.size(); ++k) {
      ComparedEngine& who = all_[k];
      if (k > 0) who.model = &result_.models[k - 1];
      who.side = who.model ? &who.model->run : &result_.native;
      for (auto& commands : who.commands) commands = std::make_shared<CommandRecord>();
      if (resyncs()) who.onsets.emplace(model_);
      if (k > 1 && replays()) who.model->native.emplace();
    }
  }

  SceneComparison run() {
    show();
    if (!runner_.interrupted()) measure_omissions();
    if (!runner_.interrupted()) look_closer();
    if (options_.modes_ladder && !resyncs() && !runner_.interrupted()) {
      result_.model_error = runner_.model_error(repeats(result_.native));
    }
    if (runner_.interrupted()) {
      result_.interrupted = true;
    } else {
      for (ComparedModel& m : result_.models) judge(m);
    }
    return std::move(result_);
  }

 private:
  // True if each MuJoCo run has its own native run.
  bool replays() const { return options_.mode == CompareMode::kReplay && result_.commands; }
  bool resyncs() const { return options_.mode == CompareMode::kResync; }
  const ComparedEngine& native() const { return all_[0]; }
  const ComparedEngine& decider() const { return all_[1]; }
  // The native run that a contestant is compared with.
  Side& native_of(const ComparedEngine& who) {
    return who.model && who.model->native ? *who.model->native : result_.native;
  }
  std::shared_ptr<const CommandRecord> commands(const ComparedEngine& who,
                                                std::size_t level = 0) const {
    return result_.commands ? who.commands[level] : nullptr;
  }
  // The commands of the deciding model, which drive the native run that is shown; null if nothing
  // is replayed.
  std::shared_ptr<const CommandRecord> replayed_commands() const {
    return replays() ? commands(decider()) : nullptr;
  }

  // Runs every engine with the rows that plots and residuals need, on all processors; the runs for
  // timing come later, one at a time. A MuJoCo run must precede the native run that its commands
  // drive.
  void show() {
    in_parallel(all_.size(), options_.jobs, nullptr, {}, [&](std::size_t k) {
      ComparedEngine& who = all_[k];
      if (!who.model) {
        if (!replays()) *who.side = runner_.shown(who, {});
        return;
      }
      if (runner_.interrupted()) return;
      RunRequest request;
      request.watch = [this, &who, record = recording(who.commands[0])](const WatchedStep& step) {
        if (result_.commands) record(step);
        if (who.onsets) who.onsets->step(step);
      };
      *who.side = runner_.shown(who, std::move(request));
      if (!replays()) return;
      RunRequest replay;
      replay.commands = commands(who);
      native_of(who) = runner_.shown(native(), std::move(replay));
    });
    if (runner_.interrupted()) {
      std::erase_if(result_.models, [](const ComparedModel& m) { return m.run.label.empty(); });
      return;
    }
    result_.shadow = shadow_column(runner_, result_.native, commands(decider()), options_);
    if (result_.commands && !result_.own) run_without_control();
    align_measured();
  }

  // Done before the longer part of the work, because it may fail.
  void align_measured() {
    if (!options_.measured || runner_.interrupted()) return;
    std::vector<RunToHold> runs;
    for (const Side* side : result_.sides()) runs.push_back({side->label, &side->trajectory});
    try {
      result_.measured = align_record(*options_.measured, options_.alignment, result_.scene, runs);
    } catch (const MeasuredError&) {
      // If the run did not reach its end, its own status is reported instead.
      if (result_.native.trajectory.status == Status::kOk) throw;
    }
  }

  // Measures what the twin of a user's own machine leaves out, relative to the contact force.
  void measure_omissions() {
    constexpr double kSaid = 1e-4;  // smallest share that is reported
    const Side& decides = *decider().side;
    if (!options_.own || decides.trajectory.status != Status::kOk) return;
    const double touching = decides.metrics.mean_force;
    const double force = touching > 0.0 ? touching : result_.native.metrics.mean_force;
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

  // Runs twins, smaller steps or single contacts, and the timing.
  void look_closer() {
    result_.twin.threshold = divergence_threshold(result_.scene, result_.native.trajectory);
    if (resyncs()) {
      for (ComparedEngine& who : all_)
        leave_limits("resync makes no runs at smaller steps", *who.side);
      predict_onsets();
    } else {
      run_twins_of_both();
      run_smaller_steps();
    }
    if (replays() && !runner_.interrupted()) replay_floor_ = replay_floor(runner_, result_.scene);
    time_runs(runner_, all_, options_.timing_repeats, replayed_commands());
  }

  // Runs as many twins as the verdicts need: native ones for all models, and twins of the run that
  // decides.
  void run_twins_of_both() {
    TwinParameters parameters;
    parameters.output_times = times_;
    parameters.commands = replayed_commands();
    parameters.enough = [this](const Twins& natives) {
      return !natives.metrics.empty() &&
             std::ranges::all_of(result_.models, [&](const ComparedModel& m) {
               return is_settled(m, natives, {});
             });
    };
    twins_ = runner_.twins(native(), result_.twin.threshold, parameters);
    result_.twins = static_cast<int>(twins_.metrics.size());
    result_.twin = first_to_part(twins_, result_.twin);
    if (runner_.interrupted() || !decider_may_have_twins()) return;
    parameters.commands = nullptr;
    parameters.enough = [this](const Twins& others) {
      return is_settled(result_.models.front(), twins_, others);
    };
    decider_twins_ = runner_.twins(decider(), result_.twin.threshold, parameters);
    result_.decider_twins = static_cast<int>(decider_twins_.metrics.size());
  }

  // True if further twins would not change any verdict on a model.
  bool is_settled(const ComparedModel& m, const Twins& natives, const Twins& others) const {
    const Side& native = result_.reference(m);
    if (native.trajectory.status != Status::kOk || m.run.trajectory.status != Status::kOk)
      return true;
    return std::ranges::all_of(figures(), [&](const Figure& f) {
      return rotorub::is_settled(
          judged(f, figure_sample(f, native.metrics, natives.metrics),
                 figure_sample(f, m.run.metrics, others.metrics), options_.tolerance),
          options_.tolerance);
    });
  }

  std::vector<ComparedEngine*> slowest_first() {
    std::vector<ComparedEngine*> order;
    for (ComparedEngine& who : all_) order.push_back(&who);
    std::ranges::sort(order, std::greater{},
                      [](const ComparedEngine* who) { return who->side->trajectory.wall_s; });
    return order;
  }

  // Runs all sides at half the step, then those at a quarter where it matters.
  void run_smaller_steps() {
    const auto test = [this](const ComparedEngine& who) {
      const Side& native = native_of(who);
      return StepTest{native.metrics, options_.tolerance, single_run_intervals(repeats(native))};
    };
    const auto is_needed = [&](const ComparedEngine& who, std::size_t level) {
      if (!who.climbs || (replays() && !who.model)) return false;
      if (who.side->trajectory.status != Status::kOk) return false;
      if (level == 1) return true;
      return needs_quarter(*who.side, who.ladder[1], test(who)) ||
             (replays() && needs_quarter(native_of(who), who.native_ladder[1], test(who)));
    };
    const std::vector<ComparedEngine*> order = slowest_first();
    for (std::size_t level = 1; level < kStepLevels; ++level) {
      in_parallel(order.size(), options_.jobs, options_.interrupt, {}, [&](std::size_t job) {
        ComparedEngine& who = *order[job];
        if (!is_needed(who, level)) return;
        RunRequest request;
        request.output_times = times_;
        if (replays()) request.watch = recording(who.commands[level]);
        who.ladder[level] = run_level(runner_, who, level, request);
        if (!replays() || native_of(who).trajectory.status != Status::kOk) return;
        // Driven by the commands of its own MuJoCo run at that step.
        request.watch = {};
        request.commands = commands(who, level);
        who.native_ladder[level] = run_level(runner_, native(), level, request);
      });
    }
    if (runner_.interrupted()) return;
    const auto climbed = [&](const ComparedEngine& who, const Ladder& ladder, Side& side) {
      if (!who.climbs) return leave_limits("it was run only at the scene's step", side);
      if (who.side->trajectory.status != Status::kOk)
        return leave_limits("the run did not end well", side);
      set_limits(ladder, test(who), side);
    };
    for (const ComparedEngine& who : all_) {
      if (replays() && !who.model) continue;
      climbed(who, who.ladder, *who.side);
      if (replays()) climbed(who, who.native_ladder, native_of(who));
    }
  }

  void predict_onsets() {
    for (ComparedEngine& who : all_) {
      if (!who.model || runner_.interrupted()) continue;
      const Trajectory& mujoco = who.side->trajectory;
      auto predicted = predict(
          result_.scene, who.onsets->finish(mujoco.end), commands(who), result_.scene.run.step,
          runner_.part(native().work, "onsets of " + who.label), options_.interrupt);
      who.model->resync = judge_resync(std::move(predicted), mujoco.statistics.impulse_total > 0.0,
                                       options_.tolerance);
      who.model->resync->left_out = who.onsets->left_out();
    }
  }

  std::vector<FigureSample> repeats(const Side& native) const {
    std::vector<FigureSample> samples = figure_samples(native.metrics, twins_.metrics);
    for (std::size_t k = 0; k < replay_floor_.size(); ++k)
      samples[k].replay_floor = replay_floor_[k];
    return samples;
  }

  // If a native figure scatters by more than a tenth of the tolerance, the scatter of the run that
  // decides matters as well.
  bool decider_may_have_twins() const {
    constexpr double kMatters = 0.1;
    if (resyncs() || replays() || result_.own) return false;
    return std::ranges::any_of(figures(), [&](const Figure& f) {
      const FigureSample s = figure_sample(f, result_.native.metrics, twins_.metrics);
      return f.is_judged() && share_of(f, s.mean, s.deviation) > kMatters * options_.tolerance;
    });
  }

  // Computes a model's differences and their reasons.
  void judge(ComparedModel& m) {
    const Side &native = result_.reference(m), &other = m.run;
    const std::vector<FigureSample> natives = repeats(native);
    std::span<const Metrics> twins;
    if (result_.decides(m)) twins = decider_twins_.metrics;
    const std::vector<FigureSample> others = figure_samples(other.metrics, twins);
    for (std::size_t k = 0; k < natives.size(); ++k) {
      m.figures.push_back({judged(figures()[k], natives[k], others[k], options_.tolerance),
                           natives[k].floor, natives[k].replay_floor,
                           split(native.limits[k], other.limits[k])});
    }
    m.divergence = divergence(native.trajectory, other.trajectory, result_.twin.threshold);
    m.impacts = pair_impacts(native.trajectory, other.trajectory, options_.impacts);
    const bool ended = other.trajectory.status == Status::kOk;
    const bool both_ended = ended && native.trajectory.status == Status::kOk;
    if (both_ended) m.trust = trust(m.judged());
    if (ended && m.resync) m.trust = m.resync->trust;
    if (both_ended && !result_.omission.empty()) leave_undecided(m);
    m.reasons = reasons(result_, m);
  }

  const CompareOptions& options_;
  SceneComparison result_;
  std::vector<ComparedEngine> all_;
  Runner runner_;
  std::vector<double> times_;
  Model model_;
  Twins twins_, decider_twins_;
  std::vector<double> replay_floor_;  // empty except in replay
  MujocoInPlace mujoco_;              // for runs in several threads
};

constexpr const char* kModes[] = {"lockstep", "replay", "resync"};  // in the order of CompareMode

}  // namespace

const char* to_string(CompareMode mode) { return kModes[static_cast<int>(mode)]; }

CompareMode compare_mode_of(const std::string& name) {
  const auto found = std::find(std::begin(kModes), std::end(kModes), name);
  assert(found != std::end(kModes));
  return static_cast<CompareMode>(found - std::begin(kModes));
}

std::string Side::early_end(bool cause) const {
  if (trajectory.status == Status::kOk) return "";
  return fmt::format("the {} run ended early ({}){}", label, to_string(trajectory.status),
                     cause ? ": " + trajectory.message : std::string());
}

std::vector<const Side*> SceneComparison::sides() const {
  std::vector<const Side*> all;
  if (!native.label.empty()) all.push_back(&native);
  for (const ComparedModel& m : models) all.push_back(&m.run);
  return all;
}

Status SceneComparison::status() const {
  if (native.trajectory.status != Status::kOk) return native.trajectory.status;
  const Status decider = models.empty() ? Status::kOk : models.front().run.trajectory.status;
  return decider == Status::kOk && interrupted ? Status::kInterrupted : decider;
}

SceneComparison compare_scene(const scene::Scene& scene, const CompareOptions& options) {
  return Comparison(scene, options).run();
}

bool SceneComparison::is_untouched() const {
  return std::ranges::none_of(sides(), [](const Side* side) {
    return side->trajectory.status != Status::kOk || side->metrics.first_touch;
  });
}

bool is_absent(const SceneComparison& comparison, const Figure& figure) {
  return std::ranges::all_of(comparison.sides(), [&figure](const Side* side) {
    return std::isnan(figure.value(side->metrics));
  });
}

bool is_shown(const SceneComparison& comparison, const Figure& figure) {
  if (!comparison.is_untouched()) return !is_absent(comparison, figure);
  return std::ranges::any_of(comparison.sides(), [&figure](const Side* side) {
    const double value = figure.value(side->metrics);
    return !std::isnan(value) && value != 0.0;
  });
}

}  // namespace rotorub
