// rotorub tune: the fastest setting of MuJoCo whose contact forces can be trusted.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/bench/ladder.h"
#include "compare/commands/command.h"
#include "compare/commands/interrupt.h"
#include "compare/commands/progress.h"
#include "compare/study/json.h"
#include "compare/study/scene_comparison.h"
#include "compare/tune/json.h"
#include "compare/tune/scene_text.h"
#include "compare/tune/table.h"
#include "compare/tune/tune.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct TuneArguments : CommonOptions {
  std::string scene, tolerance = "1%", steps, file;
  int twins = kDefaultTwins;
};

std::vector<double> tune_steps(const TuneArguments& options, const scene::Scene& scene) {
  std::vector<double> steps =
      options.steps.empty() ? bench::default_ladder().steps : bench::parse_steps(options.steps);
  // A slow machine may take more than the bench's steps. The scene's own step is one that its user
  // has a reason for.
  if (options.steps.empty()) steps.insert(steps.end(), {1e-3, 5e-4, scene.run.step});
  std::sort(steps.begin(), steps.end(), std::greater<>());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

// The scene with the trusted setting; says what it did, or why it did nothing.
void write_tuned(const TuneArguments& options, const tune::TuneResult& result) {
  if (!result.choice.trusted) {
    fmt::print(stderr, "rotorub: {} is not written: no setting can be trusted\n", options.file);
    return;
  }
  const auto& setting = result.settings[*result.choice.trusted].setting;
  const auto tuned = tune::tuned_text(result.scene.text, options.scene, setting);
  write_whole(options.file, tuned.text);
  if (options.json || options.quiet) return;
  fmt::print("\nwritten to {}{}; its own comparison: rotorub compare {} --contact {}\n",
             options.file, tuned.comments_kept ? "" : " (anew: comments could not be kept)",
             options.file, to_string(setting.contact));
}

int run_tune(const TuneArguments& options) {
  tune::TuneParameters parameters;
  parameters.tolerance = tolerance_of(options.tolerance);
  check_twins(options.twins);
  parameters.twins = options.twins;
  const scene::Scene scene = read_scene(options.scene, options);
  if (!scene.contact) {
    throw UsageError(fmt::format(
        "{}: without a contact there is nothing to tune; accepted is a scene with [contact]",
        options.scene));
  }
  parameters.steps = tune_steps(options, scene);
  parameters.interrupt = &interrupted();
  ProgressBar bar(options.quiet);
  parameters.progress = [&](double share, const std::string& what) { bar.show(share, what); };
  const auto reader = [&](const std::vector<std::string>& further) {
    TuneArguments with = options;
    with.overrides.insert(with.overrides.end(), further.begin(), further.end());
    return read_scene(options.scene, with);
  };
  const tune::TuneResult result = tune::tune_scene(reader, parameters);
  bar.clear();
  if (result.interrupted) throw Interrupted();

  if (options.json) {
    std::cout << json_text(tune::tune_json(result));
  } else if (!options.quiet) {
    fmt::print("{}", tune::tune_table(result));
  }
  if (!options.file.empty()) write_tuned(options, result);
  return result.choice.trusted ? kDone : kOutside;
}

}  // namespace

Command add_tune_command(CLI::App& program) {
  auto options = std::make_shared<TuneArguments>();
  CLI::App* app = program.add_subcommand(
      "tune", "The fastest setting of MuJoCo whose contact forces can be trusted");
  app->add_option("SCENE", options->scene, "Scene file (.toml)")->required();
  app->add_option("--tolerance", options->tolerance, "On the judged figures, as 1% or 0.01")
      ->type_name("SHARE")
      ->capture_default_str();
  app->add_option("--steps", options->steps,
                  "Steps that are tried, e.g. 100us,10us (default: 1-2-5 from 1 ms to 1 us, and "
                  "the scene's)")
      ->type_name("LIST");
  app->add_option("--twins", options->twins,
                  "Native runs a few units in the last place apart, whose spread tells what can be "
                  "decided")
      ->type_name("N")
      ->capture_default_str();
  app->add_option("-o,--output", options->file, "Writes the scene with the trusted setting there")
      ->type_name("FILE.toml");
  app->add_option("--end", options->end, "End of the run, e.g. 0.5s (run.end)")->type_name("TIME");
  add_controller_option(*app, *options);
  add_common_options(*app, *options);
  return {app, [options] { return run_tune(*options); }};
}

}  // namespace rotorub
