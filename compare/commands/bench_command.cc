// rotorub bench: measures speed against error for every engine on a ladder of steps or tolerances.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>

#include "compare/base/json.h"
#include "compare/bench/output.h"
#include "compare/bench/scene_bench.h"
#include "compare/bench/soft_contact.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/report/beside.h"
#include "compare/report/page.h"
#include "compare/result/result.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

constexpr const char* kBenchPage = "bench.html";

struct BenchArguments : CommonOptions {
  std::vector<std::string> scenes;
  std::string engines, steps, tolerances, folder;
  int repeats = 20;
};

bench::BenchParameters bench_parameters(const BenchArguments& options) {
  bench::BenchParameters p;
  if (options.repeats < 1) refuse("--repeats", std::to_string(options.repeats), "1 or more");
  p.timing.repeats = options.repeats;
  if (!options.steps.empty()) p.ladder.steps = bench::parse_steps(options.steps);
  if (!options.tolerances.empty()) {
    p.ladder.tolerances = bench::parse_tolerances(options.tolerances);
  }
  p.engines = bench::chosen_engines(options.engines);
  p.stability_map = !options.folder.empty();
  return p;
}

// Reports the errors of all scenes before an hour is spent on the first.
void check_scenes(const BenchArguments& options) {
  read_each(options.scenes, [&](const std::string& file) {
    if (read_scene(file, options).has_contact()) return;
    throw UsageError(
        "{}: this scene has no [contact], but the levels of error are shares of contact.clearance; "
        "give a scene with one",
        file);
  });
}

void write_results(const BenchArguments& options, const result::Section& result,
                   const std::vector<bench::SceneBench>& benches) {
  const std::filesystem::path folder(options.folder);
  std::vector<std::string> names, texts;
  for (const bench::SceneBench& bench : benches) {
    names.push_back(bench.scene.name);
    texts.push_back(bench.scene.text);
  }
  write_whole(folder / kBenchFile, json_text(json_of(result)));
  write_whole(folder / kBenchPage, page_of("bench", fmt::format("{}", fmt::join(names, ", ")),
                                           result, {{"texts", texts}}));
  say(options,
      fmt::format("\nwritten to {}: bench.html, bench.json\n", printable_path(options.folder)));
}

int run_bench(const BenchArguments& options) {
  const bench::BenchParameters parameters = bench_parameters(options);
  check_scenes(options);
  check_output_folder(options.folder, {kBenchFile, kBenchPage});
  if (!options.quiet && options.engines.empty()) fmt::print(stderr, "{}", bench::missing_text());
  ProgressBar bar(options.quiet);
  std::vector<bench::SceneBench> benches;
  for (std::size_t k = 0; k < options.scenes.size(); ++k) {
    const std::string& file = options.scenes[k];
    benches.push_back(bench::bench_scene(scene_reader(file, options), parameters,
                                         bar.part(k, options.scenes.size(), file), &interrupted()));
    bar.clear();
    // The medians of an interrupted bench would come from fewer repeats.
    if (interrupted()) throw Interrupted();
    say(options, (k > 0 ? "\n" : "") + text_of(bench::scene_section(benches.back())));
  }
  std::vector<bench::RestitutionRow> restitution;
  if (!options.folder.empty()) {
    restitution = bench::restitution_table(
        [&](double share, const std::string& what) { bar.show(share, what); }, &interrupted());
    bar.clear();
    if (interrupted()) throw Interrupted();
  }
  const result::Section result = bench::result_of(bench::this_machine(), benches, restitution);
  if (!options.folder.empty()) write_results(options, result, benches);
  // People have read the results of each scene.
  if (options.json) finish(result, options);
  return kDone;
}

}  // namespace

Command add_bench_command(CLI::App& program) {
  auto options = std::make_shared<BenchArguments>();
  CLI::App& app = add_command(program, "bench",
                              "Measure speed against error of every engine over a series of steps");
  add_option(app, "SCENE", options->scenes, "Scene files (.toml)").required();
  add_value(app, "--engines", options->engines, "LIST",
            "Engines or families (native, mujoco, peer), separated by commas (default: all)");
  add_value(
      app, "--steps", options->steps, "LIST",
      "Fixed steps, separated by commas, e.g. 100us,10us (default: 1-2-5 from 200 µs to 1 µs)");
  add_value(app, "--tolerances", options->tolerances, "LIST",
            "Tolerances of `event`, separated by commas (default: decades from 1e-4 to 1e-12)");
  add_value(app, "--repeats", options->repeats, "N", "Number of timed runs of each point")
      .shows_default();
  add_value(app, "-o,--output", options->folder, "DIR",
            "Write bench.json and the page bench.html to this folder, with stability map and "
            "restitution table (hundreds of further runs)");
  add_value(app, "--end", options->end, "TIME", "End of the run, e.g. 0.5s (run.end)");
  add_controller_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return run_bench(*options); }};
}

}  // namespace rotorub
