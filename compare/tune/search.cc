#include "compare/tune/search.h"

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

#include "compare/engine/engine.h"
#include "compare/metrics/rows.h"

namespace rotorub::tune {
namespace {

// Costs within this factor of the best are measured again: single runs are no closer.
constexpr double kNear = 2.0;

bool stopped(const std::atomic<bool>* interrupt) {
  return interrupt && interrupt->load(std::memory_order_relaxed);
}

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

// Seconds; of the cheapest that is trusted.
double best_cost(const std::vector<JudgedSetting>& settings) {
  const Choice choice = choose(settings);
  return choice.trusted ? *settings[*choice.trusted].cost()
                        : std::numeric_limits<double>::infinity();
}

}  // namespace

std::vector<JudgedSetting> search(const SearchParameters& parameters, const Runner& run,
                                  const Judge& judge, double tolerance) {
  std::vector<JudgedSetting> all;
  // us of a step of each variant, as last met; 0: none yet.
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
      if (stopped(parameters.interrupt)) return all;
      if (judged.us_per_step > 0.0) last[k] = judged.us_per_step;
      all.push_back(std::move(judged));
      ran = true;
    }
    if (!ran) break;
  }
  return all;
}

Runner mujoco_runner(const bench::SceneReader& reader, const std::atomic<bool>* interrupt) {
  // A variant is read once for all of its steps.
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
      outcome.metrics = metrics(t, std::nullopt);
      if (t.status != Status::kOk) {
        outcome.failure = std::string(rotorub::to_string(t.status)) + ": " + t.message;
      }
    } catch (const std::exception& error) {
      outcome.failure = error.what();
    }
    return outcome;
  };
}

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

void time_again(std::vector<JudgedSetting>& settings, const Runner& run,
                const bench::TimingParameters& parameters, const std::atomic<bool>* interrupt) {
  const double best = best_cost(settings);
  std::vector<std::function<double()>> jobs;
  std::vector<double> estimates;
  std::vector<JudgedSetting*> timed;
  for (JudgedSetting& s : settings) {
    const auto cost = s.cost();
    if (!cost || !s.failure.empty() || *cost > kNear * best || *cost < best / kNear) continue;
    jobs.push_back(
        [&run, setting = s.setting] { return run(setting, setting.step).metrics.us_per_step; });
    estimates.push_back(*cost);
    timed.push_back(&s);
  }
  const auto times = bench::interleaved(
      jobs, estimates, parameters, [](double, const std::string&) {}, interrupt);
  for (std::size_t k = 0; k < timed.size(); ++k) {
    if (times[k].repeats > 0) timed[k]->us_per_step = times[k].median;
  }
}

}  // namespace rotorub::tune
