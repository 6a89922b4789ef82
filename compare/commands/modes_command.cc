// rotorub modes: whirl frequencies, critical speeds, the threshold of stability, mode shapes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/commands/command.h"
#include "compare/commands/interrupt.h"
#include "compare/commands/progress.h"
#include "compare/modes/text.h"
#include "compare/report/modes_page.h"
#include "compare/study/json.h"
#include "native_model/scene/units.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct ModesArguments : CommonOptions {
  std::string scene, up_to, output;
  std::vector<std::string> speeds;
};

double speed_of(const char* option, const std::string& text) {
  const auto parsed = scene::parse_quantity(text, scene::kSpin);
  if (!parsed.error.empty()) throw UsageError(fmt::format("{} {}: {}", option, text, parsed.error));
  return parsed.value;
}

// Empty: not given.
std::optional<double> range_of(const ModesArguments& options) {
  if (options.up_to.empty()) return std::nullopt;
  const double range = speed_of("--up-to", options.up_to);
  if (!(range > 0.0)) {
    throw UsageError(
        fmt::format("--up-to {}: accepted is a spin speed above 0, as 9000 rpm", options.up_to));
  }
  return range;
}

// A folder, or the page itself.
std::filesystem::path page_file(const std::string& output) {
  const std::filesystem::path path(output);
  return path.extension() == ".html" ? path : path / "modes.html";
}

void write_page(const ModesArguments& options, const scene::Scene& scene,
                const RotorAnalysis& analysis, std::optional<double> asked_range) {
  const double range = asked_range.value_or(campbell_range(scene, analysis));
  ProgressBar bar(options.quiet);
  const auto branches = whirl_branches(condensed(analysis.system, range, kCampbellAccuracy),
                                       even_speeds(range, kCampbellSpeeds), [&](double share) {
                                         if (interrupted()) throw Interrupted();
                                         bar.show(share, "Campbell diagram");
                                       });
  bar.clear();
  const std::filesystem::path file = page_file(options.output);
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  write_whole(file, modes_page(scene, analysis, range, branches));
}

int modes(const ModesArguments& options) {
  std::vector<double> speeds;
  for (const std::string& text : options.speeds) speeds.push_back(speed_of("--speed", text));
  const std::optional<double> range = range_of(options);
  const scene::Scene scene = read_scene(options.scene, options);
  const RotorAnalysis analysis = analyse_rotor(scene, speeds);
  if (!options.output.empty()) write_page(options, scene, analysis, range);

  if (options.json) {
    std::cout << json_text(modes_json(analysis));
  } else if (!options.quiet) {
    std::cout << modes_table(scene.name, analysis);
    if (!options.output.empty()) {
      fmt::print("\nwritten to {}\n", page_file(options.output).string());
    }
  }
  return kDone;
}

}  // namespace

Command add_modes_command(CLI::App& program) {
  auto options = std::make_shared<ModesArguments>();
  CLI::App* app =
      program.add_subcommand("modes", "Whirl frequencies, critical speeds and mode shapes");
  app->add_option("SCENE", options->scene, "Scene file (.toml)")->required();
  app->add_option("--speed", options->speeds,
                  "Spin speed, e.g. \"4000 rpm\"; may be repeated (default: rotor.speed)")
      ->type_name("SPEED")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  CLI::Option* page =
      app->add_option("-o,--output", options->output,
                      "Writes a page with Campbell diagram and mode shapes: a file that ends with "
                      ".html, or a folder for modes.html")
          ->type_name("DIR|FILE.html");
  app->add_option("--up-to", options->up_to,
                  "Highest spin speed of the Campbell diagram (default: to show what matters)")
      ->type_name("SPEED")
      ->needs(page);
  add_common_options(*app, *options);
  return {app, [options] { return modes(*options); }};
}

}  // namespace rotorub
