#include "compare/tune/tune.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

#include "compare/engine/engine.h"
#include "compare/figures/figure_sample.h"
#include "compare/metrics/extrapolation.h"
#include "compare/metrics/rows.h"
#include "compare/study/trust.h"
#include "compare/study/twins.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"

namespace rotorub::tune {
namespace {

// The native side of every comparison at a step. `event` chooses its own steps, but forces are
// averaged over the step of the comparison.
struct Reference {
  Metrics metrics;
  std::vector<FigureSample> samples;  // of the run and its twins, in the order of figures()
};

// Runs each reference once. Throws std::runtime_error if `event` cannot run the scene to its end.
class References {
 public:
  References(const scene::Scene& scene, int twins, const std::atomic<bool>* interrupt)
      : scene_(scene), twins_(twins), interrupt_(interrupt) {}
  // window_step: see Runner. After an interrupt, the result so far.
  const Reference& at(double step, double window_step);

 private:
  const scene::Scene& scene_;
  int twins_;
  const std::atomic<bool>* interrupt_;
  std::map<std::pair<double, double>, Reference> known_;  // keyed by step and window_step
};

// Costs within this factor of the best are measured again, because single runs are less accurate.
constexpr double kNear = 2.0;

JudgedSetting judged_run(const Setting& setting, const Runner& run, const Judge& judge) {
  JudgedSetting judged;
  judged.setting = setting;
  const Outcome outcome = run(setting, setting.step);
  judged.us_per_step = outcome.metrics.us_per_step;
  judged.failure = outcome.failure;
  if (!judged.failure.empty()) return judged;
  judged.figures = judge(outcome.metrics, setting.step);
  judged.trust = trust(judged.figures);
  return judged;
}

std::string luck_of(const JudgedSetting& setting, const Runner& run, const Judge& judge,
                    double tolerance) {
  Setting finer = setting.setting;
  finer.step *= 0.5;
  const JudgedSetting half = judged_run(finer, run, judge);
  if (half.is_trusted()) return "";
  return "at half the step: " +
         (half.failure.empty() ? why(half.figures, tolerance) : half.failure);
}

// s; of the cheapest trusted setting.
double best_cost(const std::vector<JudgedSetting>& settings) {
  const Choice choice = choose(settings);
  return choice.trusted ? *settings[*choice.trusted].cost()
                        : std::numeric_limits<double>::infinity();
}

const Reference& References::at(double step, double window_step) {
  const std::pair key(step, window_step);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  scene::Scene scene = scene_;
  scene.run.step = window_step;
  const auto engine = native_engine(scene::Integrator::kEvent);
  RunRequest request;
  request.step = step;
  request.output_times = dense_times(scene.run, kRows);
  request.interrupt = interrupt_;
  const Trajectory original = engine->run(scene, request);
  if (original.status != Status::kOk && original.status != Status::kInterrupted) {
    throw std::runtime_error(
        fmt::format("{}: the native model, which settings are judged against, ended early ({}): {}",
                    scene_.name, rotorub::to_string(original.status), original.message));
  }
  TwinParameters parameters;
  parameters.count = twins_;
  parameters.step = step;
  parameters.output_times = *request.output_times;
  parameters.interrupt = interrupt_;
  const double threshold = kDivergenceShare * smallest_clearance(scene_).value();
  const Twins twins = run_twins(*engine, scene, original, threshold, parameters);
  Reference reference;
  reference.metrics = metrics(original, {});
  reference.samples = figure_samples(reference.metrics, twins.metrics);
  return known_.emplace(key, std::move(reference)).first->second;
}

// Runs settings in MuJoCo without output. reader: reads the scene with further overrides.
Runner mujoco_runner(const bench::SceneReader& reader, const std::atomic<bool>* interrupt) {
  // A variant is read once for all its steps.
  struct Variant {
    scene::Scene scene;
    std::unique_ptr<Engine> engine;
  };
  auto known = std::make_shared<std::map<std::vector<std::string>, std::shared_ptr<Variant>>>();
  return [=](const Setting& setting, double window_step) {
    Outcome outcome;
    try {
      auto& variant = (*known)[overrides(setting)];
      if (!variant) {
        variant = std::make_shared<Variant>(
            Variant{reader(overrides(setting)), mujoco_engine(setting.contact)});
      }
      variant->scene.run.step = window_step;
      RunRequest request;
      request.step = setting.step;
      request.output_times = dense_times(variant->scene.run, kRows);
      request.interrupt = interrupt;
      const Trajectory t = variant->engine->run(variant->scene, request);
      outcome.metrics = metrics(t, {});
      if (t.status != Status::kOk) {
        outcome.failure = std::string(rotorub::to_string(t.status)) + ": " + t.message;
      }
    } catch (const std::exception& error) {
      outcome.failure = error.what();
    }
    return outcome;
  };
}

// Judges settings by the references.
Judge judge_by(References& references, double tolerance) {
  return [&references, tolerance](const Metrics& m, double step) {
    const Reference& native = references.at(step, step);
    std::vector<JudgedFigure> all;
    for (std::size_t k = 0; k < figures().size(); ++k) {
      const Figure& f = figures()[k];
      if (!f.is_judged()) continue;
      const JudgedFigure one = judged(f, native.samples[k], figure_sample(f, m, {}), tolerance);
      if (!one.is_absent()) all.push_back(one);
    }
    return all;
  };
}

// Measures again, in turns, the settings that the choice depends on: those with costs near the
// cheapest trusted one.
void time_again(std::vector<JudgedSetting>& settings, const Runner& run,
                const bench::TimingParameters& parameters, const std::atomic<bool>* interrupt) {
  const double best = best_cost(settings);
  std::vector<bench::TimedJob> jobs;
  for (JudgedSetting& s : settings) {
    const auto cost = s.cost();
    if (!cost || !s.failure.empty() || *cost > kNear * best || *cost < best / kNear) continue;
    jobs.push_back(
        {[&run, setting = s.setting] { return run(setting, setting.step).metrics.us_per_step; },
         *cost,
         [&s](const bench::WallTime& time) {
           if (time.repeats > 0) s.us_per_step = time.median;
         }});
  }
  bench::interleaved(
      std::move(jobs), parameters, [](double, const std::string&) {}, interrupt);
}

// From runs at the step, a half and a quarter of it (compare/metrics/extrapolation.h).
void split_errors(const Setting& setting, const Runner& run, References& references,
                  ErrorParts& parts) {
  std::array<Metrics, 3> own, native;
  for (std::size_t k = 0; k < own.size(); ++k) {
    Setting finer = setting;
    finer.step /= std::pow(2.0, static_cast<double>(k));
    const Outcome outcome = run(finer, setting.step);
    if (!outcome.failure.empty()) {
      parts.reason = fmt::format("{} did not end well: {}", text(finer), outcome.failure);
      return;
    }
    own[k] = outcome.metrics;
    native[k] = references.at(finer.step, setting.step).metrics;
  }
  for (const Figure& f : figures()) {
    if (!f.is_judged()) continue;
    const auto limit = [&](const std::array<Metrics, 3>& m) {
      return extrapolate({f.value(m[0]), f.value(m[1]), f.value(m[2])});
    };
    const Split s = split(limit(native), limit(own));
    parts.figures.emplace_back(&f, split_shares(f, f.value(native[0]), s));
  }
}

}  // namespace

std::vector<JudgedSetting> search(const SearchParameters& parameters, const Runner& run,
                                  const Judge& judge, double tolerance) {
  std::vector<JudgedSetting> all;
  // us per step of each variant in its last run; 0: no run yet.
  std::vector<double> last(parameters.variants.size(), 0.0);
  for (const double step : parameters.steps) {
    bool ran = false;
    for (std::size_t k = 0; k < parameters.variants.size(); ++k) {
      if (1e-6 * last[k] / step > parameters.margin * best_cost(all)) continue;
      Setting setting = parameters.variants[k];
      setting.step = step;
      if (parameters.before) parameters.before(setting);
      JudgedSetting judged = judged_run(setting, run, judge);
      if (judged.is_trusted()) judged.luck = luck_of(judged, run, judge, tolerance);
      if (bench::stopped(parameters.interrupt)) return all;
      if (judged.us_per_step > 0.0) last[k] = judged.us_per_step;
      all.push_back(std::move(judged));
      ran = true;
    }
    if (!ran) break;
  }
  return all;
}

TuneResult tune_scene(const bench::SceneReader& reader, const TuneParameters& parameters) {
  TuneResult result;
  result.scene = reader({});
  result.tolerance = parameters.tolerance;
  result.modes = prepare(result.scene).layout.modes;
  const auto stopped = [&] { return result.interrupted = bench::stopped(parameters.interrupt); };
  const auto say = [&](double share, const std::string& what) {
    if (parameters.progress) parameters.progress(share, what);
  };

  // 1. Every variant, beginning with the coarsest step.
  References references(result.scene, parameters.twins, parameters.interrupt);
  // Without a native run, every setting would only seem to be wrong.
  references.at(result.scene.run.step, result.scene.run.step);
  const Runner run = mujoco_runner(reader, parameters.interrupt);
  SearchParameters how;
  how.steps = parameters.steps;
  how.variants = variants(result.scene.mujoco);
  // The number of rungs is unknown, so each one counts as half of the remaining work.
  how.before = [&](const Setting& setting) {
    const auto rung = std::find(how.steps.begin(), how.steps.end(), setting.step);
    say(0.8 * (1.0 - std::pow(0.5, static_cast<double>(rung - how.steps.begin()))), text(setting));
  };
  how.interrupt = parameters.interrupt;
  result.settings =
      search(how, run, judge_by(references, parameters.tolerance), parameters.tolerance);
  if (stopped()) return result;

  // 2. Accurate times of the settings near the choice.
  say(0.8, "times");
  time_again(result.settings, run, parameters.timing, parameters.interrupt);
  if (stopped()) return result;
  result.choice = choose(result.settings);

  // 3. The causes of the remaining error.
  say(0.9, "errors by their causes");
  if (result.choice.trusted) {
    split_errors(result.settings[*result.choice.trusted].setting, run, references, result.errors);
  } else {
    result.errors.reason = "no setting can be trusted";
  }
  ModelErrorParameters ladder;
  ladder.tolerance = parameters.tolerance;
  ladder.step = result.choice.trusted ? result.settings[*result.choice.trusted].setting.step
                                      : result.scene.run.step;
  ladder.interrupt = parameters.interrupt;
  if (result.scene.rotor.geometry)
    ladder.spread = single_run_intervals(references.at(ladder.step, ladder.step).samples);
  if (stopped()) return result;
  result.model_error = model_error(result.scene, ladder);
  stopped();
  return result;
}

}  // namespace rotorub::tune
