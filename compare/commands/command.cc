#include "compare/commands/command.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string_view>
#include <system_error>

#include "compare/base/units.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/sweep/shard.h"
#include "native_model/control/library.h"
#include "native_model/control/library_file.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/overrides.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/text.h"
#include "native_model/scene/units.h"
#include "native_model/trajectory/output.h"

namespace rotorub {

namespace {

// Says why the file of --controller is neither a library nor a file of Python; empty if it may be
// one. Newcomers often give the source of a library.
std::string no_library(const std::string& file) {
  std::error_code none;
  if (!std::filesystem::exists(file, none)) return scene::printable(file) + ": no such file";
  if (std::filesystem::is_directory(file, none))
    return scene::printable(file) +
           " is a folder; give a shared library (.so) or a Python file (.py)";
  const std::string suffix = std::filesystem::path(file).extension().string();
  const std::string library = std::filesystem::path(file).stem().string() + ".so";
  if (suffix == ".c" || suffix == ".cc" || suffix == ".cpp") {
    return fmt::format(
        "{} is source code; build it with `{} -shared -fPIC -I $ROTORUB/native_model/control/abi "
        "{} -o {}`, and give "
        "{}",
        file, suffix == ".c" ? "cc" : "c++", file, library, library);
  }
  return "";
}

bool is_whole(double ratio) { return std::abs(ratio - std::round(ratio)) < 1e-6; }

// The largest step up to `step` that divides the sample time into at most a hundred steps more and
// is a whole number of tenths of a microsecond; otherwise the largest that divides it.
double dividing_step(double sample, double step) {
  constexpr double kTenths = 1e7;
  const double fewest = std::ceil(sample / step - 1e-6);
  for (double count = fewest; count < fewest + 100.0; ++count) {
    if (is_whole(kTenths * sample / count)) return sample / count;
  }
  return sample / fewest;
}

}  // namespace

void refuse(std::string_view option, std::string_view value, std::string_view accepted) {
  throw UsageError("{} {}: expected {}", option, value, accepted);
}

void add_common_options(CLI::App& command, CommonOptions& options) {
  add_value(command, "--set", options.overrides, "TABLE.KEY=VALUE",
            "Override a value of the scene, e.g. contact.friction=0.2; may be repeated")
      .repeats();
  add_flag(command, "--json", options.json, "Print the summary as JSON, and nothing else");
  add_flag(command, "--quiet,-q", options.quiet, "Print nothing but errors");
}

void add_run_options(CLI::App& command, CommonOptions& options) {
  add_value(command, "--step", options.step, "TIME",
            "Fixed step of MuJoCo, verlet and euler, e.g. 10us (run.step)");
  add_value(command, "--end", options.end, "TIME", "End of the run, e.g. 0.5s (run.end)");
}

void add_controller_option(CLI::App& command, CommonOptions& options) {
  add_value(
      command, "--controller", options.controller, "FILE",
      "Shared library (.so) or Python file (.py) with your own controller, which replaces the "
      "scene's")
      .check(no_library)
      .each([](const std::string& file) { allow_library(std::filesystem::absolute(file)); });
  add_allow_library_option(command, options);
}

void add_allow_library_option(CLI::App& command, CommonOptions& options) {
  add_flag(command, "--allow-library", options.allow_library,
           "Load the library that the scene names as its controller; do this only if you trust its "
           "code");
}

void add_format_option(CLI::App& command, std::string& format) {
  add_option(
      command, "--format", format,
      "Format of the results: csv, or hdf5, which adds a file run.h5 to the CSV files of each run")
      .one_of({"csv", "hdf5"})
      .shows_default();
}

std::string typed(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-+=.,:/%@").find(static_cast<char>(c)) != std::string_view::npos;
  };
  return !word.empty() && std::ranges::all_of(word, is_plain) ? word : sweep::shell_word(word);
}

hdf5::ImageOf hdf5_of(const std::string& format) {
  if (format != "hdf5") return nullptr;
  std::string missing;
  const hdf5::ImageOf image_of = hdf5::load(missing);
  if (!image_of) throw UsageError("--format hdf5: {}", missing);
  return image_of;
}

void add_units_option(CLI::App& command, PrintOptions& options) {
  add_option(command, "--units", options.units,
             "Units on the terminal: si, mm (mm and N) or us (mil and lbf); files and JSON keep "
             "theirs (default: mm, µm and N)")
      .one_of({"si", "mm", "us"});
}

std::vector<std::string> overrides_of(const CommonOptions& options) {
  std::vector<std::string> overrides;
  if (!options.controller.empty()) {
    const std::string library = std::filesystem::absolute(options.controller).string();
    overrides = {"controller.kind=library", "controller.library=" + library};
  }
  overrides.insert(overrides.end(), options.overrides.begin(), options.overrides.end());
  return overrides;
}

std::vector<std::string> libraries_from(const scene::Scene& scene,
                                        const std::filesystem::path& file) {
  namespace fs = std::filesystem;
  std::error_code none;
  const auto whole = [](const fs::path& folder) { return fs::absolute(folder / "."); };
  const bool same =
      scene.folder && fs::equivalent(whole(*scene.folder), whole(file.parent_path()), none);
  return same ? std::vector<std::string>() : absolute_libraries(scene);
}

std::string command_text(std::string_view command, const std::string& file,
                         const CommonOptions& options) {
  std::string text = fmt::format("rotorub {} {}", command, typed(file));
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} {}", name, typed(value));
  };
  add("--controller", options.controller);
  for (const std::string& override : options.overrides) add("--set", override);
  add("--end", options.end);
  return text + (options.allow_library ? " --allow-library" : "");
}

// The option from which an override of this key came.
const char* option_of(const std::string& key, const CommonOptions& options) {
  if (key == "run.step" && !options.step.empty()) return "--step";
  if (key == "run.end" && !options.end.empty()) return "--end";
  const bool set = std::ranges::any_of(
      options.overrides, [&](const auto& text) { return scene::override_key(text) == key; });
  const bool law = key == "controller" || key.starts_with("controller.");
  return law && !set && !options.controller.empty() ? "--controller" : scene::kOverrideFile;
}

scene::Scene read_scene(const std::string& file, const CommonOptions& options) {
  std::vector<std::string> overrides = overrides_of(options);
  if (!options.step.empty()) overrides.push_back("run.step=" + options.step);
  if (!options.end.empty()) overrides.push_back("run.end=" + options.end);
  scene::Scene scene;
  try {
    scene = scene::read_scene(file, overrides);
  } catch (const scene::SceneError& error) {
    // Use the option's name for an override that came from it.
    std::vector<scene::Diagnostic> wrong = error.diagnostics();
    for (scene::Diagnostic& d : wrong) {
      if (d.file != scene::kOverrideFile) continue;
      d.file = option_of(d.key, options);
      if (d.key == "controller" && !options.controller.empty() &&
          d.reason.starts_with("cannot stand beside")) {
        d.key.clear();
        d.reason =
            "this scene has several contacts, and --controller sets the controller of a single "
            "ring. Set [contact.controller] in the file. A law for magnetic bearings belongs in "
            "[magnetic_control] kind = \"library\" (mjcf/docs/own_controller.md).";
      }
    }
    throw scene::SceneError(wrong);
  }
  if (!options.controller.empty()) {  // for errors that only the loading of the law shows
    auto record = std::make_shared<scene::Record>(*scene.record);
    for (const char* key : {"controller", "controller.kind", "controller.library"}) {
      const std::string option = option_of(key, options);
      if (option != scene::kOverrideFile) record->move(key, scene::kOverrideFile, option);
    }
    scene.record = std::move(record);
  }
  if (!options.quiet) {
    // A study or a ladder reads its scene many times, so each note is printed once.
    static std::set<std::string> said;
    for (const std::string& note : scene.notes) {
      if (said.insert(file + note).second)
        fmt::print(stderr, "note: {}: {}\n", printable_path(file), note);
    }
  }
  return scene;
}

std::function<scene::Scene(const std::vector<std::string>&)> scene_reader(
    const std::string& file, const CommonOptions& options) {
  return [&options, file](const std::vector<std::string>& further) {
    CommonOptions with = options;
    with.overrides.insert(with.overrides.end(), further.begin(), further.end());
    return read_scene(file, with);
  };
}

void read_each(const std::vector<std::string>& files,
               const std::function<void(const std::string&)>& read) {
  std::vector<scene::Diagnostic> wrong;
  for (const std::string& file : files) {
    try {
      read(file);
    } catch (const scene::SceneError& error) {
      wrong.insert(wrong.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
  }
  if (!wrong.empty()) throw scene::SceneError(wrong);
}

OwnRun own_run(const CommonOptions& options) {
  for (const std::string& text : options.overrides) {
    if (scene::override_key(text).starts_with("controller.")) continue;
    throw UsageError(
        "--set {}: this key belongs to scenes, but a machine of your own has its values in its "
        ".xml; "
        "only keys of the controller on its ring are accepted, for example controller.sample_time",
        text);
  }
  const auto time = [](const char* flag, const std::string& text) {
    const std::string accepted = "a time above 0, for example 10us or 0.5s";
    const double value = quantity_of(flag, text, scene::kTime, accepted);
    if (!(value > 0.0)) refuse(flag, text, accepted);
    return value;
  };
  OwnRun run;
  run.control = overrides_of(options);
  if (!options.step.empty()) run.step = time("--step", options.step);
  if (!options.end.empty()) run.end = time("--end", options.end);
  return run;
}

double quantity_of(const std::string& option, const std::string& text,
                   const scene::Quantity& quantity, const std::string& accepted) {
  const auto parsed = scene::parse_quantity(text, quantity);
  if (parsed.error.empty()) return parsed.value;
  throw UsageError("{} {}: {}{}", option, scene::printable(text),
                   accepted.empty() ? "" : "expected ", accepted.empty() ? parsed.error : accepted);
}

void check_sample_times(const scene::Scene& scene, const CommonOptions& options) {
  for (std::size_t k = 0; k < scene.magnetic_bearings.size(); ++k) {
    const auto& control = scene.magnetic_bearings[k].control;
    if (!control || !control->works() || !control->sampled()) continue;
    const double sample = control->form == scene::ControlForm::kShared
                              ? scene.magnetic_control->sample_time
                              : control->sample_time;
    const double ratio = sample / scene.run.step;
    if (std::round(ratio) >= 1.0 && is_whole(ratio)) continue;
    const std::string why = fmt::format(
        "the sample time of {} ({:.6g} us) must be a multiple of the step ({:.6g} us). Use, for "
        "example, --step {:.6g}us",
        scene::magnetic_bearing_path(scene, k), kMicro * sample, kMicro * scene.run.step,
        kMicro * dividing_step(sample, scene.run.step));
    if (!options.step.empty()) throw UsageError("--step {}: {}", options.step, why);
    scene::refuse_at(scene, "run.step", why);
  }
}

void note_unitless_speed(const std::string& option, const std::string& text) {
  const std::string_view plain = scene::trimmed(text);
  if (plain.find_first_not_of("0123456789.eE+-") != std::string_view::npos) return;
  const std::string note =
      scene::unitless_speed_note(option, scene::parse_quantity(plain, scene::kSpin).value);
  if (!note.empty()) fmt::print(stderr, "note: {}\n", note);
}

double tolerance_of(const std::string& text) {
  const std::string accepted = "a share of 0 or more, for example 1% or 0.01";
  const double value = quantity_of("--tolerance", text, scene::kPure, accepted);
  if (!(value >= 0.0)) refuse("--tolerance", text, accepted);
  if (value >= 1.0 && text.find('%') == std::string::npos) {
    throw UsageError(
        "--tolerance {0}: a number without % is a share, so {0} means {1:.6g} %; write \"{0}%\" or "
        "{2:.6g}",
        text, 100.0 * value, 0.01 * value);
  }
  return value;
}

void check_twins(int twins) {
  constexpr int kMost = 10'000;
  if (twins >= 0 && twins <= kMost) return;
  throw UsageError(
      "--twins {}: expected a whole number from 0 to {} (0: the spread is not estimated)", twins,
      kMost);
}

void note_idle_step(const CommonOptions& options, scene::Integrator integrator) {
  if (options.quiet || options.step.empty() || integrator != scene::Integrator::kEvent) return;
  fmt::print(stderr,
             "note: --step {} has no effect, because the integrator event chooses its own steps; "
             "for a fixed step use the integrator verlet\n",
             scene::printable(options.step));
}

void say_failure(const scene::Scene& scene, const std::string& what, const Trajectory& trajectory) {
  if (trajectory.status == Status::kOk) return;
  // Do not add a time to a reason that contains one.
  const bool dated = trajectory.message.find("at t = ") != std::string::npos;
  print_message(fmt::format(
      "{}: {}{}{}: {}", scene::printable(scene.name), what, to_string(trajectory.status),
      dated ? std::string() : fmt::format(" at t = {:.9g} s", trajectory.end), trajectory.message));
}

int finish(const result::Section& result, const PrintOptions& options, int code) {
  result::print(result,
                {options.json, options.quiet, palette_of(stdout), result::units_of(options.units)});
  return code;
}

void say(const PrintOptions& options, const std::string& words) {
  if (options.json || options.quiet) return;
  fmt::print("{}", words);
  std::fflush(stdout);
}

result::Sentence written_to(const std::filesystem::path& place) {
  return result::line(fmt::format("written to {}", printable_path(place)));
}

Trajectory run_shown(const Engine& engine, const scene::Scene& scene, const std::string& what,
                     bool quiet) {
  ProgressBar bar(quiet);
  RunRequest request;
  request.interrupt = &interrupted();
  request.progress = [&](double share) { bar.show(share, what); };
  return engine.run(scene, request);
}

int exit_code_of(Status status) {
  if (status == Status::kOk) return kDone;
  return status == Status::kInterrupted ? kStopped : kFailed;
}

StoredRun stored_run(const std::string& folder) {
  StoredRun run = read_run(folder);
  check_series(run.trajectory, folder + "/series.csv");
  return run;
}

}  // namespace rotorub
