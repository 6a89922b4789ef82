// rotorub plot: makes the page of a saved run.

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/report/page.h"
#include "compare/result/result.h"
#include "compare/run_files/run_directory.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

using std::filesystem::path;

struct PlotArguments : CommonOptions {
  std::string folder, file;
};

// Throws UsageError for a folder without a run.
StoredRun run_of(const PlotArguments& options) {
  if (!options.overrides.empty())
    throw UsageError("{} is the folder of a run, but --set changes only scenes; leave it out",
                     options.folder);
  if (!std::filesystem::is_directory(options.folder)) {
    throw UsageError("{} is not a folder; give the output folder of `rotorub run -o DIR`",
                     options.folder);
  }
  return stored_run(options.folder);
}

int plot(const PlotArguments& options) {
  ProgressBar bar(options.quiet);
  bar.show(0.0, "reading the run");
  const StoredRun run = run_of(options);
  const auto shadow = read_shadow(options.folder, run);
  if (shadow)
    check_series(shadow->trajectory, options.folder + "/" + kShadowFolder + "/series.csv");
  const path file = options.file.empty() ? path(options.folder) / kRunPage : path(options.file);
  check_ending(file, ".html");
  check_output_file(file);
  bar.show(0.5, "writing the page");
  write_whole(file, run_page(run, shadow));
  bar.clear();
  const result::Section result{
      .parts = {result::Data{"",
                             {{"scene", run.scene.name},
                              {"file", file.string()},
                              {"rows", run.trajectory.rows()},
                              {"impacts", run.trajectory.impacts.size()},
                              {"shadow", shadow.has_value()}}},
                result::line(fmt::format("{}: {} rows{}", scene::printable(run.scene.name),
                                         run.trajectory.rows(), shadow ? ", with the shadow" : "")),
                written_to(file)}};
  return finish(result, options);
}

}  // namespace

Command add_plot_command(CLI::App& program) {
  auto options = std::make_shared<PlotArguments>();
  CLI::App& app = add_command(program, "plot", "Write the page of a run: its plots and a player");
  add_option(app, "RUN_DIR", options->folder, "Output folder of `rotorub run -o DIR`").required();
  add_value(app, "-o,--output", options->file, "FILE.html", "File (default: RUN_DIR/plot.html)");
  add_common_options(app, *options);
  app.get_option("--set")->description(
      "Refused: the folder has a finished run, and --set changes only scenes");
  return {&app, [options] { return plot(*options); }};
}

}  // namespace rotorub
