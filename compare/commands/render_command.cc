// rotorub render: makes a film or picture of a scene or of a saved run.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/commands/command.h"
#include "compare/commands/film_options.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/engine/engine.h"
#include "compare/result/result.h"
#include "compare/run_files/run_directory.h"
#include "compare/study/scene_comparison.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"
#include "renders/film.h"

namespace rotorub {
namespace {

struct RenderArguments : CommonOptions {
  std::string source;
  FilmArguments film;
};

// Enough rows for smooth pictures and for every contact to be visible.
constexpr std::size_t kFilmRows = 50000;

// Refuses a time window beyond the end of the scene's run before it runs.
void check_window(const scene::Scene& scene, const renders::RenderOptions& film) {
  for (const auto& [flag, time] : {std::pair{"--from", film.from}, {"--to", film.to}}) {
    if (!time || *time <= scene.run.end) continue;
    throw UsageError("{} {} s: expected a time within the run, which ends at {} s (--end)", flag,
                     *time, scene.run.end);
  }
}

scene::Scene scene_for_film(const RenderArguments& options, const renders::RenderOptions& film) {
  scene::Scene scene = read_scene(options.source, options);
  if (const auto libraries = libraries_of(scene); !libraries.empty()) {
    throw UsageError(
        "{0}: the controller of this scene is a library, {1}, which render does not load; run "
        "`rotorub run {0} --allow-library -o DIR` first, and render DIR",
        options.source, libraries.front().file);
  }
  check_window(scene, film);
  return scene;
}

Trajectory run_for_film(const scene::Scene& scene, ProgressBar& bar) {
  RunRequest request;
  request.output_times = dense_times(scene.run, kFilmRows);
  request.interrupt = &interrupted();
  request.progress = [&](double share) { bar.show(0.1 * share, "native"); };
  return native_engine(scene.run.integrator)->run(scene, request);
}

StoredRun stored(const RenderArguments& options) {
  if (!options.overrides.empty() || !options.step.empty() || !options.end.empty()) {
    throw UsageError(
        "{} is the folder of a run, but --set, --step and --end change only scenes; leave them out",
        options.source);
  }
  StoredRun run = stored_run(options.source);
  if (run.trajectory.status != Status::kOk) {
    print_message(fmt::format("{}: this run ended early, at {:.6g} s of {:.6g} s: {}{}{}",
                              printable_path(options.source), run.trajectory.end, run.scene.run.end,
                              to_string(run.trajectory.status),
                              run.trajectory.message.empty() ? "" : ", ", run.trajectory.message));
  }
  return run;
}

// The run of --beside. Its engine, contact model and integrator may differ, but not what is drawn.
std::optional<StoredRun> run_beside(const std::string& folder, const StoredRun& run) {
  if (folder.empty()) return std::nullopt;
  if (!std::filesystem::is_directory(folder)) refuse("--beside", folder, "the folder of a run");
  StoredRun beside = stored_run(folder);
  if (beside.scene.name != run.scene.name) {
    throw UsageError("--beside {} is a run of the scene {}; give a run of {}", folder,
                     beside.scene.name, run.scene.name);
  }
  return beside;
}

// words, json: what only a picture or only a film has.
result::Section result_of(const StoredRun& run, const renders::RenderOptions& film,
                          const renders::Framing& framing, const std::string& file,
                          const std::string& words, const nlohmann::json& json) {
  const bool shadow = film.shadow != nullptr;
  return {.parts = {result::Data{"", json},
                    result::Data{"",
                                 {{"scene", run.scene.name},
                                  {"file", file},
                                  {"from", framing.from},
                                  {"to", framing.to},
                                  {"width", film.width},
                                  {"height", film.height},
                                  {"magnification", framing.magnification},
                                  {"shadow", shadow}}},
                    result::line(fmt::format("{}: {}, displacements magnified {:.3g} times{}",
                                             scene::printable(run.scene.name), words,
                                             framing.magnification,
                                             shadow ? ", the shadow drawn as a ghost" : "")),
                    written_to(file)}};
}

result::Section make_picture(const StoredRun& run, const FilmRequest& request,
                             const std::string& file) {
  const auto made =
      renders::render_still(run.scene, run.trajectory, request.at, request.options, file);
  return result_of(run, request.options, made.framing, file,
                   fmt::format("picture of t = {:.6g} s", made.t), {{"t", made.t}});
}

result::Section make_film(const StoredRun& run, const FilmRequest& request,
                          const std::string& file) {
  const auto made = renders::render(run.scene, run.trajectory, request.options, file);
  const renders::FilmClock& clock = made.framing.clock;
  std::string words =
      fmt::format("{:.3g} s of film, slowed down {:.4g} times", made.film_s, clock.base());
  if (!clock.impacts().empty()) {
    words += fmt::format(", {:.4g} times at {} impacts", clock.slowest(), clock.impacts().size());
  }
  return result_of(run, request.options, made.framing, file, words,
                   {{"slow_motion", made.framing.slow_motion},
                    {"slow_motion_at_impacts", clock.slowest()},
                    {"frames", made.framing.frames},
                    {"frames_per_second", request.options.frames_per_second},
                    {"film_s", made.film_s}});
}

int render_film(const RenderArguments& options) {
  FilmRequest request = film_request(options.film);
  const bool is_run = std::filesystem::is_directory(options.source);
  StoredRun run =
      is_run ? stored(options) : StoredRun{scene_for_film(options, request.options), {}, {}};
  const std::string file = options.film.file.empty()
                               ? run.scene.name + renders::extension(request.format)
                               : options.film.file;
  check_output_file(file);
  ProgressBar bar(options.quiet);
  if (!is_run) run.trajectory = run_for_film(run.scene, bar);
  const int code = is_run ? static_cast<int>(kDone) : exit_code_of(run.trajectory.status);
  if (code != kDone) {
    print_message(fmt::format("{}: {}: {}", scene::printable(run.scene.name),
                              to_string(run.trajectory.status), run.trajectory.message));
    return code;
  }

  const std::optional<StoredRun> shadow =
      is_run ? read_shadow(options.source, run) : std::optional<StoredRun>();
  if (shadow) request.options.shadow = &shadow->trajectory;
  const std::optional<StoredRun> beside = run_beside(options.film.beside, run);
  if (beside) request.options.beside = &beside->trajectory;
  request.options.progress = [&](double share) {
    if (interrupted()) throw Interrupted();
    bar.show(0.1 + 0.9 * share, "film");
  };
  const bool picture = request.format == renders::FilmFormat::kPng;
  const result::Section made =
      picture ? make_picture(run, request, file) : make_film(run, request, file);
  bar.clear();
  return finish(made, options);
}

}  // namespace

Command add_render_command(CLI::App& program) {
  auto options = std::make_shared<RenderArguments>();
  CLI::App& app = add_command(
      program, "render",
      "Make a film or a picture of a scene, run by the native engine, or of a stored run");
  add_option(app, "SCENE|RUN_DIR", options->source, "Scene file (.toml), or folder of a run")
      .required();
  add_film_options(app, options->film);
  add_run_options(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return render_film(*options); }};
}

}  // namespace rotorub
