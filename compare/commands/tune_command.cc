// rotorub tune: finds the fastest setting of MuJoCo whose contact forces can be trusted.

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "compare/base/format.h"
#include "compare/bench/engines.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/commands/tune_command.h"
#include "compare/result/result.h"
#include "compare/study/scene_comparison.h"
#include "compare/tune/output.h"
#include "compare/tune/setting.h"
#include "compare/tune/tune.h"
#include "native_model/control/library_file.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

std::vector<double> tune_steps(const std::string& given, const scene::Scene& scene) {
  std::vector<double> steps =
      given.empty() ? bench::default_ladder().steps : bench::parse_steps(given);
  // Slow machines permit larger steps than the bench's. The scene's own step is included, because
  // its user chose it for a reason.
  if (given.empty()) steps.insert(steps.end(), {1e-3, 5e-4, scene.run.step});
  std::sort(steps.begin(), steps.end(), std::greater<>());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

struct TuneArguments : CommonOptions {
  std::string scene, tolerance = "1%", steps, file;
  int twins = kDefaultTwins;
};

// Whether options change values of the scene, whose text then has no comments.
bool is_changed(const TuneArguments& options) {
  return !options.end.empty() || !overrides_of(options).empty();
}

// Writes the scene with the trusted setting and prints the result, or why nothing was written.
void write_tuned(const TuneArguments& options, const tune::TuneResult& result) {
  if (!result.choice.trusted) {
    print_message(printable_path(options.file) +
                  " was not written, because no setting can be trusted");
    return;
  }
  const auto& setting = result.settings[*result.choice.trusted].setting;
  const auto tuned = tune::tuned_text(result.scene.text, options.scene, setting,
                                      libraries_from(result.scene, options.file));
  write_whole(options.file, tuned.text);
  say(options,
      fmt::format(
          "\nwritten to {}{}; to compare it, run\n  rotorub compare {} --contact {}{}\n",
          printable_path(options.file),
          tuned.comments_kept && !is_changed(options) ? "" : " (without the comments of the scene)",
          typed(options.file), to_string(setting.contact),
          libraries_of(result.scene).empty() ? "" : " --allow-library"));
}

int run_tune(const TuneArguments& options) {
  const double tolerance = tolerance_of(options.tolerance);
  check_twins(options.twins);
  const scene::Scene scene = read_scene(options.scene, options);
  if (!scene.has_contact()) {
    throw UsageError(
        "{}: this scene has no [contact], so there is nothing to tune; give a scene with one",
        options.scene);
  }
  check_ending(options.file, ".toml");
  check_output_file(options.file);
  ProgressBar bar(options.quiet);
  const tune::TuneResult result =
      tuned(options.scene, scene, options, tolerance, options.twins, options.steps,
            [&](double share, const std::string& what) { bar.show(share, what); });
  bar.clear();

  const int code = result.choice.trusted ? kDone : kOutside;
  finish(tune::result_of(result), options, code);
  if (!options.file.empty()) write_tuned(options, result);
  return code;
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
  tune::TuneResult result = tune::tune_scene(scene_reader(file, options), parameters);
  if (result.interrupted) throw Interrupted();
  return result;
}

std::string setting_sentence(const tune::TuneResult& result) {
  if (!result.choice.trusted) {
    return fmt::format("none of {} settings can be trusted within {}", result.settings.size(),
                       percent_text(result.tolerance));
  }
  const tune::JudgedSetting& s = result.settings[*result.choice.trusted];
  return fmt::format("{}: {} µs a step, the fastest of {} settings that can be trusted within {}",
                     tune::text(s.setting), short_number(s.us_per_step), result.settings.size(),
                     percent_text(result.tolerance));
}

Command add_tune_command(CLI::App& program) {
  auto options = std::make_shared<TuneArguments>();
  CLI::App& app = add_command(
      program, "tune", "Find the fastest setting of MuJoCo whose contact forces can be trusted");
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  add_value(app, "--tolerance", options->tolerance, "SHARE",
            "Largest difference of a judged figure that passes, e.g. 1% or 0.01")
      .shows_default();
  add_value(app, "--steps", options->steps, "LIST",
            "Steps to try, e.g. 100us,10us (default: 1-2-5 from 1 ms to 1 µs, and the scene's)");
  add_value(app, "--twins", options->twins, "N",
            "Number of native runs whose starts differ by a few units in the last place; their "
            "scatter shows what can be decided")
      .shows_default();
  add_value(app, "-o,--output", options->file, "FILE.toml",
            "Write the scene with that setting to this file");
  add_value(app, "--end", options->end, "TIME", "End of the run, e.g. 0.5s (run.end)");
  add_controller_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return run_tune(*options); }};
}

}  // namespace rotorub
