// rotorub tune: the fastest setting of MuJoCo whose contact forces can be trusted.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/commands/command.h"
#include "compare/commands/progress.h"
#include "compare/commands/terminal.h"
#include "compare/commands/tuning.h"
#include "compare/study/scene_comparison.h"
#include "compare/tune/output.h"
#include "compare/tune/setting.h"
#include "compare/tune/tune.h"
#include "native_model/trajectory/output.h"
#include "native_model/trajectory/part_file.h"

namespace rotorub {
namespace {

struct TuneArguments : CommonOptions {
  std::string scene, tolerance = "1%", steps, file;
  int twins = kDefaultTwins;
};

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
  fmt::print("\nwritten{}; its own comparison:\n  rotorub compare {} --contact {}\n",
             tuned.comments_kept ? "" : " (anew: comments could not be kept)", options.file,
             to_string(setting.contact));
}

int run_tune(const TuneArguments& options) {
  const double tolerance = tolerance_of(options.tolerance);
  check_twins(options.twins);
  const scene::Scene scene = read_scene(options.scene, options);
  if (!scene.first().contact) {
    throw UsageError(fmt::format(
        "{}: without a contact there is nothing to tune; accepted is a scene with [contact]",
        options.scene));
  }
  if (!options.file.empty()) check_writable(std::filesystem::path(options.file).parent_path());
  ProgressBar bar(options.quiet);
  const tune::TuneResult result =
      tuned(options.scene, scene, options, tolerance, options.twins, options.steps,
            [&](double share, const std::string& what) { bar.show(share, what); });
  bar.clear();

  if (options.json) {
    std::cout << json_text(tune::tune_json(result));
  } else if (!options.quiet) {
    fmt::print("{}", tune::tune_table(result, palette_of(stdout)));
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
