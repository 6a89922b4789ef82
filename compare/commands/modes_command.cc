// rotorub modes: whirl frequencies, critical speeds and the threshold of stability.

#include "compare/modes_command.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/commands/command.h"
#include "native_model/scene/units.h"

namespace rotorub {
namespace {

struct Options : CommonOptions {
  std::string scene;
  std::vector<std::string> speeds;
};

std::vector<double> speeds_of(const Options& options) {
  std::vector<double> speeds;
  for (const std::string& text : options.speeds) {
    const auto parsed = scene::parse_quantity(text, scene::kSpin);
    if (!parsed.error.empty()) {
      throw UsageError(fmt::format("--speed {}: {}", text, parsed.error));
    }
    speeds.push_back(parsed.value);
  }
  return speeds;
}

int modes(const Options& options) {
  const std::vector<double> speeds = speeds_of(options);
  const scene::Scene scene = read_scene(options.scene, options);
  if (options.json) {
    std::cout << modes_json(scene, speeds).dump(2) << "\n";
  } else if (!options.quiet) {
    std::cout << modes_table(scene, speeds);
  }
  return kDone;
}

}  // namespace

Command add_modes_command(CLI::App& program) {
  auto options = std::make_shared<Options>();
  CLI::App* app = program.add_subcommand("modes", "Whirl frequencies and critical speeds");
  app->add_option("SCENE", options->scene, "Scene file (.toml)")->required();
  app->add_option("--speed", options->speeds,
                  "Spin speed, e.g. \"4000 rpm\"; may be repeated (default: rotor.speed)")
      ->type_name("SPEED")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  add_common_options(*app, *options);
  return {app, [options] { return modes(*options); }};
}

}  // namespace rotorub
