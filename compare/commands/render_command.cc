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
#include "native_model/control/library.h"
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
    throw UsageError(
        fmt::format("{} {} s: accepted is a time of the run, which ends at {} s (--end)", flag,
                    *time, scene.run.end));
  }
}

scene::Scene scene_for_film(const RenderArguments& options, const renders::RenderOptions& film) {
  scene::Scene scene = read_scene(options.source, options);
  if (const auto libraries = libraries_of(scene); !libraries.empty()) {
    throw UsageError(
        fmt::format("{}: its controller is a library, {}, which render does not open; run it "
                    "first, rotorub run {} --allow-library -o DIR, and render DIR",
                    options.source, libraries.front().file, options.source));
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
    throw UsageError(fmt::format("{} is the folder of a run: --set, --step and --end change scenes",
                                 options.source));
  }
  StoredRun run = stored_run(options.source);
  if (run.trajectory.status != Status::kOk) {
    print_error(fmt::format("{}: ended at {:.6g} s of {:.6g} s: {}{}{}",
                            printable_path(options.source), run.trajectory.end, run.scene.run.end,
                            to_string(run.trajectory.status),
                            run.trajectory.message.empty() ? "" : ", ", run.trajectory.message));
  }
  return run;
}

// The run of --beside. Its engine, contact model and integrator may differ, but not what is drawn.
std::optional<StoredRun> run_beside(const FilmRequest& request, const StoredRun& run) {
  if (request.beside.empty()) return std::nullopt;
  if (!std::filesystem::is_directory(request.beside)) {
    throw UsageError(fmt::format("--beside {}: accepted is the folder of a run", request.beside));
  }
  StoredRun beside = stored_run(request.beside);
  if (beside.scene.name != run.scene.name) {
    throw UsageError(fmt::format("--beside {}: is a run of {}; accepted is one of {}",
                                 request.beside, beside.scene.name, run.scene.name));
  }
  return beside;
}

// The result, in words and as JSON.
struct Outcome {
  renders::Framing framing;
  std::string words;
  nlohmann::json json;
};

Outcome made_picture(const StoredRun& run, const FilmRequest& request, const std::string& file) {
  const auto made =
      renders::render_still(run.scene, run.trajectory, request.at, request.options, file);
  return {made.framing, fmt::format("a picture of {:.6g} s", made.t), {{"t", made.t}}};
}

Outcome made_film(const StoredRun& run, const FilmRequest& request, const std::string& file) {
  const auto made = renders::render(run.scene, run.trajectory, request.options, file);
  const renders::FilmClock& clock = made.framing.clock;
  std::string words =
      fmt::format("{:.3g} s of film, slowed down {:.4g} times", made.film_s, clock.base());
  if (!clock.impacts().empty()) {
    words += fmt::format(", {:.4g} times at {} impacts", clock.slowest(), clock.impacts().size());
  }
  return {made.framing,
          words,
          {{"slow_motion", made.framing.slow_motion},
           {"slow_motion_at_impacts", clock.slowest()},
           {"frames", made.framing.frames},
           {"frames_per_second", request.options.frames_per_second},
           {"film_s", made.film_s}}};
}

void tell(const RenderArguments& options, const FilmRequest& request, const StoredRun& run,
          const Outcome& made, const std::string& file) {
  const bool shadow = request.options.shadow != nullptr;
  const result::Section result{
      .parts = {result::Data{"", made.json},
                result::Data{"",
                             {{"scene", run.scene.name},
                              {"file", file},
                              {"from", made.framing.from},
                              {"to", made.framing.to},
                              {"width", request.options.width},
                              {"height", request.options.height},
                              {"magnification", made.framing.magnification},
                              {"shadow", shadow}}},
                result::line(fmt::format(
                    "{}: {}, displacements magnified {:.3g} times{}\nwritten to {}",
                    scene::printable(run.scene.name), made.words, made.framing.magnification,
                    shadow ? ", its shadow as a ghost" : "", printable_path(file)))}};
  result::print(result, {options.json, options.quiet});
}

int render_film(const RenderArguments& options) {
  FilmRequest request = film_request(options.film);
  const bool is_run = std::filesystem::is_directory(options.source);
  StoredRun run =
      is_run ? stored(options) : StoredRun{scene_for_film(options, request.options), {}};
  const std::string file =
      request.file.empty() ? run.scene.name + renders::extension(request.format) : request.file;
  check_output_file(file);
  ProgressBar bar(options.quiet);
  if (!is_run) run.trajectory = run_for_film(run.scene, bar);
  const int code = is_run ? static_cast<int>(kDone) : exit_code_of(run.trajectory.status);
  if (code != kDone) {
    print_error(fmt::format("{}: {}: {}", scene::printable(run.scene.name),
                            to_string(run.trajectory.status), run.trajectory.message));
    return code;
  }

  const std::optional<StoredRun> shadow =
      is_run ? read_shadow(options.source, run) : std::optional<StoredRun>();
  if (shadow) request.options.shadow = &shadow->trajectory;
  const std::optional<StoredRun> beside = run_beside(request, run);
  if (beside) request.options.beside = &beside->trajectory;
  request.options.progress = [&](double share) {
    if (interrupted()) throw Interrupted();
    bar.show(0.1 + 0.9 * share, "film");
  };
  const bool picture = request.format == renders::FilmFormat::kPng;
  const Outcome made = picture ? made_picture(run, request, file) : made_film(run, request, file);
  bar.clear();
  tell(options, request, run, made, file);
  return kDone;
}

}  // namespace

Command add_render_command(CLI::App& program) {
  auto options = std::make_shared<RenderArguments>();
  CLI::App& app =
      add_command(program, "render",
                  "Make a film or a picture of a scene (native engine), or of a run's folder");
  add_option(app, "SCENE|RUN_DIR", options->source, "Scene file (.toml), or folder of a run")
      .required();
  add_film_options(app, options->film);
  add_run_options(app, *options);
  add_common_options(app, *options);
  return {&app, [options] {
            set_scene_libraries(SceneLibraries::kLeftOut);
            return render_film(*options);
          }};
}

}  // namespace rotorub
