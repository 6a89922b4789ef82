// rotorub run: runs one scene on one engine and writes a folder of results.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/commands/command.h"
#include "compare/commands/measured_options.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/engine/engine.h"
#include "compare/engine/lyapunov.h"
#include "compare/measured/measured_run.h"
#include "compare/measured/output.h"
#include "compare/result/result.h"
#include "compare/run_files/run_directory.h"
#include "compare/run_files/summary.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

using std::filesystem::path;

struct RunArguments : CommonOptions, MeasuredArguments {
  std::string scene, engine = "native", integrator, contact, folder, format = "csv";
  bool lyapunov = false;
};

bool is_native(const RunArguments& options) { return options.engine == "native"; }

scene::Integrator integrator_of(const RunArguments& options, const scene::Scene& scene) {
  return integrator_named(options.integrator).value_or(scene.run.integrator);
}

std::unique_ptr<Engine> engine_of(const RunArguments& options, const scene::Scene& scene) {
  if (is_native(options)) {
    if (!options.contact.empty() && options.contact != "rigid") {
      throw UsageError("--contact {} belongs to --engine mujoco; the native engine has only rigid",
                       options.contact);
    }
    return native_engine(integrator_of(options, scene));
  }
  if (!options.integrator.empty()) {
    throw UsageError(
        "--integrator belongs to --engine native; for MuJoCo use --set mujoco.integrator=...");
  }
  return mujoco_engine(options.contact.empty() ? scene.mujoco.contact
                                               : scene::contact_model(options.contact).value());
}

bool writes_shadow(const RunArguments& options, const scene::Scene& scene) {
  return !is_native(options) && scene.mujoco.shadow;
}

// Writes the run of the native model that ran alongside in the plugin. Only a controller of the
// scene commands the actuator in such a run, so a separate native run at the same step is identical
// to the bit (tests/plugin/shadow_test.cc). (Magnets without a controller are the exception: in the
// plugin their force comes from MuJoCo.)
void write_shadow(const path& folder, const scene::Scene& scene, const RunArguments& options,
                  hdf5::ImageOf hdf5) {
  const auto engine = native_engine(scene::Integrator::kVerlet);
  const Trajectory trajectory = run_shown(*engine, scene, kShadowFolder, options.quiet);
  write_run(folder / kShadowFolder, scene, trajectory, summary_json(scene, trajectory), hdf5);
  say(options, fmt::format("shadow written to {}\n", printable_path(folder / kShadowFolder)));
  say_failure(scene, "shadow: ", trajectory);
}

// --lyapunov: the rate at which neighbouring trajectories diverge from the state that the run
// reached.
Lyapunov lyapunov_of(const RunArguments& options, const scene::Scene& scene,
                     const Trajectory& trajectory) {
  LyapunovParameters parameters;
  parameters.integrator = integrator_named(options.integrator);
  parameters.interrupt = &interrupted();
  const Lyapunov found = lyapunov_after(scene, trajectory, parameters);
  if (interrupted()) throw Interrupted();
  return found;
}

result::Section lyapunov_result(const Lyapunov& found) {
  std::string text = "not found, because " + found.refused;
  nlohmann::json all = {{"exponent", nullptr}, {"refused", found.refused}};
  if (found.exponent) {
    text = fmt::format("{} 1/s: {}", short_number(*found.exponent),
                       *found.exponent > 0.0
                           ? "neighbouring runs diverge; a value clearly above 0 means chaos"
                           : "neighbouring runs converge");
    all = {{"exponent", *found.exponent}, {"stretch", found.stretch}, {"refused", nullptr}};
  }
  return {"lyapunov",
          {result::Data{"", all}, result::Sentence{"largest Lyapunov exponent: " + text, "  "}}};
}

// The record compared with the run; empty without a record.
std::optional<MeasuredRun> laid_in(const MeasuredInput& measured, const scene::Scene& scene,
                                   const RunArguments& options, const Trajectory& trajectory) {
  if (!measured.record || trajectory.status == Status::kInterrupted) return std::nullopt;
  const std::string label = is_native(options) ? "native" : trajectory.contact_model;
  return with_record(measured, [&] {
    return align_record(*measured.record, measured.alignment, scene, {{label, &trajectory}});
  });
}

std::vector<std::string> output_files(const RunArguments& options, const scene::Scene& scene,
                                      const path& folder) {
  std::vector<std::string> files = run_files(folder);
  if (options.lyapunov) files.emplace_back(kLyapunovFile);
  if (writes_shadow(options, scene)) {
    for (std::string& file : run_files(folder, kShadowFolder)) files.push_back(std::move(file));
  }
  return files;
}

int run(const RunArguments& options) {
  const hdf5::ImageOf hdf5 = hdf5_of(options.format);
  if (options.lyapunov && !is_native(options))
    throw UsageError("--lyapunov belongs to --engine native; remove it, or use that engine");
  const MeasuredInput measured = measured_of(options);
  const scene::Scene scene = read_scene(options.scene, options);
  const auto engine = engine_of(options, scene);
  const scene::Integrator integrator = integrator_of(options, scene);
  if (is_native(options)) note_idle_step(options, integrator);
  if (!is_native(options) || integrator != scene::Integrator::kEvent)
    check_sample_times(scene, options);
  const path folder = options.folder.empty() ? path("runs") / (scene.name + "-" + engine->name())
                                             : path(options.folder);
  check_output_folder(folder, output_files(options, scene, folder));

  const Trajectory trajectory = run_shown(*engine, scene, engine->name(), options.quiet);
  result::Section told = run_result(scene, trajectory);
  write_run(folder, scene, trajectory, result::json_of(told), hdf5);
  if (options.lyapunov) {
    const result::Section lyapunov = lyapunov_result(lyapunov_of(options, scene, trajectory));
    write_whole(folder / kLyapunovFile, json_text(result::json_of(lyapunov)));
    told.add({lyapunov});
  }
  if (const auto beside = laid_in(measured, scene, options, trajectory))
    told.add({measured_section(*beside)});
  told.add({written_to(folder)});
  const int code = finish(told, options, exit_code_of(trajectory.status));
  say_failure(scene, "", trajectory);
  if (writes_shadow(options, scene) && code != kStopped) write_shadow(folder, scene, options, hdf5);
  return code;
}

}  // namespace

Command add_run_command(CLI::App& program) {
  auto options = std::make_shared<RunArguments>();
  CLI::App& app =
      add_command(program, "run", "Run a scene and write its time series, impacts and summary");
  const auto today = [](const std::string& word) {
    const std::string current(scene::current_word(word));
    if (current != word)
      fmt::print(stderr, "note: {}\n", scene::old_word_note("--integrator", word));
    return current;
  };
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  add_option(app, "--engine", options->engine, "Engine that runs the scene: native or mujoco")
      .one_of({"native", "mujoco"})
      .shows_default();
  add_option(app, "--integrator", options->integrator,
             "Integrator of the native engine: event, verlet or euler (default: the scene's)")
      .transform(today)
      .one_of({"event", "verlet", "euler"});
  add_option(app, "--contact", options->contact,
             "How MuJoCo solves the contact (default: the scene's)")
      .one_of(scene::contact_words<std::vector<std::string>>());
  add_run_options(app, *options);
  add_value(app, "-o,--output", options->folder, "DIR",
            "Folder of the results (default: runs/<scene>-<engine>)");
  add_measured_options(app, *options, "to show beside this one");
  add_format_option(app, options->format);
  add_flag(app, "--lyapunov", options->lyapunov,
           "Also find the largest Lyapunov exponent of the motion at the end of the native "
           "run (above 0: chaos), over 100 further turns of the shaft");
  add_controller_option(app, *options);
  add_units_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return run(*options); }};
}

}  // namespace rotorub
