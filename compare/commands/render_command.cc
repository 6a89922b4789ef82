// rotorub render: makes a film or picture of a scene or of a saved run.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
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
#include "native_model/scene/toml_source.h"
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
  note_idle_step(options, scene.run.integrator);
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

// The values of a scene's text by their keys, "contact[1].friction" among them, as TOML.
void add_values(const scene::TomlNode& node, const std::string& key,
                std::map<std::string, std::string>& values) {
  using Kind = scene::TomlNode::Kind;
  for (const auto& [name, entry] : node.entries)
    add_values(entry, key.empty() ? name : key + "." + name, values);
  const auto is_table = [](const scene::TomlNode& item) { return item.kind == Kind::kTable; };
  const bool is_list = node.kind == Kind::kArray && std::ranges::any_of(node.items, is_table);
  for (std::size_t k = 0; is_list && k < node.items.size(); ++k)
    add_values(node.items[k], fmt::format("{}[{}]", key, k), values);
  if (node.kind == Kind::kTable || is_list) return;
  scene::TomlNode line;
  line.entries.emplace_back("v", node);
  values[key] = scene::trimmed(scene::write_toml(line)).substr(std::string_view("v = ").size());
}

std::map<std::string, std::string> values_of(const scene::Scene& scene) {
  std::map<std::string, std::string> values;
  std::vector<scene::Diagnostic> ignored;
  if (const auto root = scene::parse_toml(scene.text, scene.name, ignored))
    add_values(*root, "", values);
  return values;
}

// The values of a scene that differ from another one: "contact.friction = 0.3".
std::string differences(const scene::Scene& scene, const scene::Scene& other) {
  std::string text;
  const auto values = values_of(scene), others = values_of(other);
  for (const auto& [key, value] : values) {
    const auto found = others.find(key);
    // The rows of the series are no part of the motion.
    if (key.starts_with("run.output_") || (found != others.end() && found->second == value))
      continue;
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key, value);
  }
  for (const auto& [key, value] : others) {
    if (key.starts_with("run.output_") || values.contains(key)) continue;
    text += fmt::format("{}no {}", text.empty() ? "" : ", ", key);
  }
  return text;
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
                    result::line(fmt::format("{}: {}, {}{}", scene::printable(run.scene.name),
                                             words, framing.magnification_text(film.view),
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
  return result_of(run, request.options, made.framing, file,
                   fmt::format("{:.3g} s of film, {}", made.film_s, clock.text()),
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
  if (!is_run) request.options.remark = fmt::format("{}", fmt::join(options.overrides, ", "));
  if (beside) {
    request.options.remark = differences(run.scene, beside->scene);
    request.options.beside_remark = differences(beside->scene, run.scene);
  }
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
