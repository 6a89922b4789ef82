// rotorub render: the film of a scene or of a run that was kept.

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
#include "compare/engine/engine.h"
#include "compare/study/json.h"
#include "compare/study/run_directory.h"
#include "compare/study/scene_comparison.h"
#include "native_model/scene/printable.h"
#include "renders/film.h"

namespace rotorub {
namespace {

struct RenderArguments : CommonOptions {
  std::string source, file;
};

// Rows close enough for smooth pictures and for every touch to be seen.
constexpr std::size_t kFilmRows = 50000;

StoredRun run_for_film(const RenderArguments& options, ProgressBar& bar) {
  StoredRun run;
  run.scene = read_scene(options.source, options);
  RunRequest request;
  request.output_times = dense_times(run.scene.run, kFilmRows);
  request.interrupt = &interrupted();
  request.progress = [&](double share) { bar.show(0.1 * share, "native"); };
  run.trajectory = native_engine(run.scene.run.integrator)->run(run.scene, request);
  return run;
}

StoredRun stored(const RenderArguments& options) {
  if (!options.overrides.empty() || !options.step.empty() || !options.end.empty()) {
    throw UsageError(fmt::format("{} is the folder of a run: --set, --step and --end change scenes",
                                 options.source));
  }
  return read_run(options.source);
}

int render_film(const RenderArguments& options) {
  ProgressBar bar(options.quiet);
  const bool is_run = std::filesystem::is_directory(options.source);
  const StoredRun run = is_run ? stored(options) : run_for_film(options, bar);
  const int code = is_run ? static_cast<int>(kDone) : exit_code_of(run.trajectory.status);
  if (code != kDone) {
    fmt::print(stderr, "rotorub: {}: {}: {}\n", scene::printable(run.scene.name),
               to_string(run.trajectory.status), run.trajectory.message);
    return code;
  }

  const std::string file = options.file.empty() ? run.scene.name + ".mp4" : options.file;
  renders::RenderOptions film;
  const std::optional<StoredRun> shadow =
      is_run ? read_shadow(options.source, run) : std::optional<StoredRun>();
  if (shadow) film.shadow = &shadow->trajectory;
  film.progress = [&](double share) {
    if (interrupted()) throw Interrupted();
    bar.show(0.1 + 0.9 * share, "film");
  };
  const renders::RenderResult result = renders::render(run.scene, run.trajectory, film, file);
  bar.clear();
  if (options.json) {
    std::cout << json_text({{"scene", run.scene.name},
                            {"file", file},
                            {"from", result.framing.from},
                            {"to", result.framing.to},
                            {"slow_motion", result.framing.slow_motion},
                            {"magnification", result.framing.magnification},
                            {"frames", result.framing.frames},
                            {"film_s", result.film_s},
                            {"shadow", shadow.has_value()}});
  } else if (!options.quiet) {
    fmt::print(
        "{}: {:.3g} s of film, slowed down {:.3g} times, displacements magnified {:.3g} "
        "times{}\nwritten to {}\n",
        run.scene.name, result.film_s, result.framing.slow_motion, result.framing.magnification,
        shadow ? ", its shadow as a ghost" : "", file);
  }
  return kDone;
}

}  // namespace

Command add_render_command(CLI::App& program) {
  auto options = std::make_shared<RenderArguments>();
  CLI::App* app =
      program.add_subcommand("render", "Film a scene (native engine), or a run's folder");
  app->add_option("SCENE|RUN_DIR", options->source, "Scene file (.toml), or folder of a run")
      ->required();
  app->add_option("-o,--output", options->file, "File (default: <scene>.mp4)")->type_name("FILE");
  add_run_options(*app, *options);
  add_common_options(*app, *options);
  return {app, [options] { return render_film(*options); }};
}

}  // namespace rotorub
