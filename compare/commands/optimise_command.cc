// rotorub optimise: finds the values of a study's keys that optimise a figure.

#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/base/columns.h"
#include "compare/base/format.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/optimise/goal.h"
#include "compare/optimise/optimiser.h"
#include "compare/optimise/output.h"
#include "compare/report/page.h"
#include "compare/result/result.h"
#include "native_model/scene/overrides.h"
#include "native_model/scene/reader.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

using std::filesystem::path;

struct OptimiseArguments : CommonOptions {
  std::string study, folder;
};

std::vector<std::string> all_overrides(const OptimiseArguments& options,
                                       const optimise::Task& task) {
  std::vector<std::string> all = task.study.overrides;
  for (const std::string& text : overrides_of(options)) {
    const std::string key = scene::override_key(text);
    if (task.study.varies(key))
      throw UsageError("--set {}: varies in the study; set another key", key);
    all.push_back(text);
  }
  return all;
}

constexpr const char *kStudyFile = "study.toml", *kEvaluationsFile = "evaluations.csv",
                     *kOptimumFile = "optimum.json", *kBestFile = "best.toml",
                     *kPageFile = "optimum.html";

// json: the result; best: the scene.
void write_files(const path& folder, const optimise::Task& task, const optimise::Optimum& optimum,
                 const std::string& json, const std::string& best) {
  const std::string name = task.study.scene.stem().string();
  std::filesystem::create_directories(folder);
  write_whole(folder / kStudyFile, task.study.text);
  write_whole(folder / kEvaluationsFile, optimise::evaluations_csv(task, optimum));
  write_whole(
      folder / kColumnsFile,
      columns_text({{kEvaluationsFile, columns_json(optimise::evaluations_columns(task))}}));
  write_whole(folder / kOptimumFile, json);
  if (!best.empty()) write_whole(folder / kBestFile, best);
  write_whole(folder / kPageFile,
              page_of("optimise", name, optimise::result_of(name, task, optimum),
                      {{"search", search_json(task, optimum)}, {"texts", {best}}}));
}

int run_optimise(const OptimiseArguments& options) {
  const optimise::Task task = optimise::read_task(options.study);
  const scene::Variants variants(task.study.scene, all_overrides(options, task));
  const path folder =
      options.folder.empty() ? path("runs") / path(options.study).stem() : path(options.folder);
  check_output_folder(
      folder, {kStudyFile, kEvaluationsFile, kColumnsFile, kOptimumFile, kBestFile, kPageFile});
  ProgressBar bar(options.quiet);
  optimise::OptimiserOptions how;
  how.interrupt = &interrupted();
  how.progress = [&](const optimise::Optimum& so_far) {
    const auto count = so_far.evaluations.size();
    bar.show(
        static_cast<double>(count) / task.goal.evaluations,
        fmt::format(
            "{} evaluations{}", count,
            so_far.best ? ", best " + short_number(*so_far.evaluations[*so_far.best].figure) : ""));
  };
  const optimise::Optimum optimum = optimise::optimise(task, variants, how);
  bar.clear();
  if (optimum.ending == optimise::Ending::kInterrupted && optimum.evaluations.empty())
    throw Interrupted();
  std::string best;
  if (optimum.best) {
    const scene::Scene scene =
        optimise::scene_of(task, variants, optimum.evaluations[*optimum.best].values, true);
    const auto libraries = libraries_from(scene, folder / kBestFile);
    best =
        libraries.empty() ? scene.text : scene::parse_scene(scene.text, kBestFile, libraries).text;
  }
  result::Section result =
      optimise::result_of(printable_path(task.study.scene.stem()), task, optimum);
  const std::string json = result::ordered_json_of(result).dump(2) + "\n";
  write_files(folder, task, optimum, json, best);
  if (options.json) std::cout << json;
  result.add(
      {result::line(fmt::format("written to {} ({}{}, {})", printable_path(folder),
                                best.empty() ? "" : "best.toml, ", kEvaluationsFile, kPageFile))});
  result::print(result, {.quiet = options.quiet || options.json});
  if (optimum.ending == optimise::Ending::kInterrupted) throw Interrupted();
  return optimum.best ? kDone : kFailed;
}

}  // namespace

Command add_optimise_command(CLI::App& program) {
  auto options = std::make_shared<OptimiseArguments>();
  CLI::App& app =
      add_command(program, "optimise",
                  "Find the gains or the design for which a figure is best, within constraints");
  add_option(app, "STUDY", options->study, "Study file (.toml) with a table [optimise]").required();
  add_value(app, "-o,--output", options->folder, "DIR",
            "Folder of the results (default: runs/<study>)");
  add_controller_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return run_optimise(*options); }};
}

}  // namespace rotorub
