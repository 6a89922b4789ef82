#include "compare/commands/tuning.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "compare/base/format.h"
#include "compare/bench/engines.h"
#include "compare/commands/interrupt.h"

namespace rotorub {
namespace {

std::vector<double> tune_steps(const std::string& given, const scene::Scene& scene) {
  std::vector<double> steps =
      given.empty() ? bench::default_ladder().steps : bench::parse_steps(given);
  // A slow machine may take more than the bench's steps. The scene's own step is one that its user
  // has a reason for.
  if (given.empty()) steps.insert(steps.end(), {1e-3, 5e-4, scene.run.step});
  std::sort(steps.begin(), steps.end(), std::greater<>());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

}  // namespace

tune::TuneResult tuned(const std::string& file, const scene::Scene& scene,
                       const CommonOptions& options, double tolerance, int twins,
                       const std::string& steps,
                       const std::function<void(double, const std::string&)>& progress) {
  tune::TuneParameters parameters;
  parameters.tolerance = tolerance;
  parameters.twins = twins;
  parameters.steps = tune_steps(steps, scene);
  parameters.interrupt = &interrupted();
  parameters.progress = progress;
  const auto reader = [&](const std::vector<std::string>& further) {
    CommonOptions with = options;
    with.overrides.insert(with.overrides.end(), further.begin(), further.end());
    return read_scene(file, with);
  };
  tune::TuneResult result = tune::tune_scene(reader, parameters);
  if (result.interrupted) throw Interrupted();
  return result;
}

std::string setting_sentence(const tune::TuneResult& result) {
  if (!result.choice.trusted) {
    return fmt::format("none of {} can be trusted within {}", result.settings.size(),
                       percent_text(result.tolerance));
  }
  const tune::JudgedSetting& s = result.settings[*result.choice.trusted];
  return fmt::format("{}: {} us a step, the fastest of {} that can be trusted within {}",
                     tune::text(s.setting), short_number(s.us_per_step), result.settings.size(),
                     percent_text(result.tolerance));
}

}  // namespace rotorub
