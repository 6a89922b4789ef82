// rotorub init: writes a scene to start from.

#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/result/result.h"
#include "compare/starter/starter.h"
#include "compare/starter/starter_laws.h"
#include "native_model/scene/text.h"
#include "native_model/scene/units.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct InitArguments {
  std::string name = "rotor", form = "geometry", file;
  std::string speed, length, diameter, disc_mass, clearance, friction, unbalance;
  bool force = false, json = false, quiet = false;
};

// No real machine has sizes outside of this range.
constexpr double kLeast = 1e-6, kMost = 1e6;

// Replaces the default by the given value. zero: whether 0 is accepted too.
void take(StarterValue& target, const char* option, const std::string& text,
          const scene::Quantity& quantity, bool zero = false) {
  if (text.empty()) return;
  const auto parsed = scene::parse_quantity(text, quantity);
  const bool in_range =
      (zero && parsed.value == 0.0) || (parsed.value >= kLeast && parsed.value <= kMost);
  if (!parsed.error.empty() || !in_range) {
    const std::string unit = quantity.unit == "1" ? "" : " " + std::string(quantity.unit);
    throw UsageError(fmt::format("{} {}: accepted is {}{} from {:g} to {:g}{}, as \"{}\"", option,
                                 scene::printable(text), quantity.name, zero ? ", 0 or" : "",
                                 kLeast, kMost, unit, target.text));
  }
  target = {text, parsed.value};
}

Starter starter_of(const InitArguments& options) {
  Starter starter;
  for (const StarterFormWord& each : kStarterForms) {
    if (options.form == each.word) starter.form = each.form;
  }
  take(starter.speed, "--speed", options.speed, scene::kSpin);
  take(starter.length, "--length", options.length, scene::kLength);
  take(starter.diameter, "--diameter", options.diameter, scene::kLength);
  take(starter.disc_mass, "--disc-mass", options.disc_mass, scene::kMass);
  take(starter.clearance, "--clearance", options.clearance, scene::kLength);
  take(starter.friction, "--friction", options.friction, scene::kPure, true);
  if (!options.unbalance.empty()) {
    if (!loses_mass(starter.form)) {
      throw UsageError(
          fmt::format("--unbalance: a machine of the form {} loses no mass; accepted "
                      "with geometry, modal, overhung and vertical",
                      options.form));
    }
    starter.unbalance = StarterValue{"72 g mm", 0.0};
    take(*starter.unbalance, "--unbalance", options.unbalance, scene::kStaticMoment);
  }
  if (starter.diameter.value > starter.length.value / 5.0) {
    throw UsageError(fmt::format(
        "--diameter {}: a shaft of {} is a beam up to a fifth of its length in diameter",
        scene::printable(starter.diameter.text), scene::printable(starter.length.text)));
  }
  if (starter.clearance.value > starter.diameter.value) {
    throw UsageError(fmt::format("--clearance {}: accepted is at most the diameter, {}",
                                 scene::printable(starter.clearance.text),
                                 scene::printable(starter.diameter.text)));
  }
  return starter;
}

// The file for the scene; empty for standard output.
std::filesystem::path starter_file(const InitArguments& options) {
  if (options.file == "-") return {};
  std::filesystem::path file = options.file.empty() ? options.name : options.file;
  if (!file.has_filename())
    throw UsageError("init: accepted is the name of a scene, as rotor or rotor.toml");
  if (file.extension() == ".xml") {
    throw UsageError(
        fmt::format("{}: accepted is the name of a scene, as rotor or rotor.toml; `rotorub mjcf "
                    "SCENE.toml -o {}` writes its MuJoCo model",
                    file.string(), file.string()));
  }
  if (file.extension() != ".toml") file += ".toml";
  std::error_code none;
  if (std::filesystem::is_directory(file, none))
    throw UsageError(fmt::format("{}: is a folder", file.string()));
  if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path(), none)) {
    throw UsageError(
        fmt::format("{}: there is no folder {}", file.string(), file.parent_path().string()));
  }
  if (!options.force && std::filesystem::exists(file, none)) {
    throw UsageError(fmt::format("{}: is there already; --force writes over it", file.string()));
  }
  return file;
}

// The folder for the laws beside the scene: rotor_controller for rotor.toml.
std::filesystem::path laws_folder(const InitArguments& options, const std::filesystem::path& file) {
  auto folder = file.parent_path() / (file.stem().string() + "_controller");
  if (!options.force && std::filesystem::exists(folder)) {
    throw UsageError(fmt::format("{}: is there already; --force writes over what it holds",
                                 scene::printable(folder.string())));
  }
  return folder;
}

// Writes the scene, and the laws if there is a folder for them.
void write_files(const std::filesystem::path& file, const std::string& text,
                 const std::filesystem::path& laws_folder) {
  std::vector<StarterFile> laws;
  if (!laws_folder.empty()) laws = starter_laws(file.filename().string());
  std::vector<std::string> names;
  for (const StarterFile& law : laws) names.emplace_back(law.name);
  check_output_file(file);
  check_output_folder(laws_folder, names);
  write_whole(file, text);
  for (const StarterFile& law : laws) write_whole(laws_folder / law.name, law.text);
}

int write_starter(const InitArguments& options) {
  Starter starter = starter_of(options);
  if (!options.quiet) note_unitless_speed("--speed", options.speed);
  const std::filesystem::path file = starter_file(options);
  starter.file = file.empty() ? options.name + (options.name.ends_with(".toml") ? "" : ".toml")
                              : file.filename().string();
  const std::string text = starter_scene(starter);
  std::filesystem::path laws;
  if (!file.empty()) {
    if (starter.form == StarterForm::kController) laws = laws_folder(options, file);
    write_files(file, text, laws);
  }
  result::Section result{.parts = {result::Data{"form", options.form}}};
  if (file.empty()) {
    result.add({result::Data{"scene", text}, result::line(text)});
  } else {
    const std::string scene = scene::printable(file.string(), 1000);
    result.add({result::Data{"file", file.string()},
                result::line(fmt::format("written to {0}\ntry: rotorub run {0}", scene))});
    if (!laws.empty()) {
      result.add(
          {result::Data{"controller", laws.string()},
           result::line(fmt::format(
               "your own controller, to begin with in C, C++ and Python: {0}\n"
               "try: cc -shared -fPIC -I {0} {0}/follow.c -o follow.so\n"
               "     rotorub run {1} --controller follow.so --set controller.sample_time=50us",
               scene::printable(laws.string(), 1000), scene))});
    }
  }
  // A scene without a file is printed even if nothing else is.
  result::print(result, {options.json, options.quiet && !file.empty()});
  return kDone;
}

}  // namespace

Command add_init_command(CLI::App& program) {
  auto options = std::make_shared<InitArguments>();
  CLI::App& app =
      add_command(program, "init", "Write a commented scene to start from, which runs as it is");
  add_option(app, "NAME", options->name, "Name of the scene (default: rotor)");
  std::vector<std::string> forms;
  for (const StarterFormWord& each : kStarterForms) forms.emplace_back(each.word);
  add_option(
      app, "--form", options->form,
      "Kind of machine: geometry (default: shaft, disc, bearings; loses a blade), modal (the "
      "same as one mode), rig (with torsion, motor, exciter, actuator), controller (the rig "
      "with a controller at work, and one of your own to begin with in C, C++ and Python), "
      "overhung (the disc beyond the bearings), vertical (hung from "
      "above) or two-catchers (magnetic bearings that fail)")
      .one_of(forms);
  const Starter standard;
  const auto size = [&](const char* option, std::string& target, const char* type,
                        const char* words, const StarterValue& value) {
    add_value(app, option, target, type, fmt::format("{} (default: {})", words, value.text));
  };
  size("--speed", options->speed, "SPEED", "Spin speed", standard.speed);
  size("--length", options->length, "LENGTH", "Length of the shaft", standard.length);
  size("--diameter", options->diameter, "LENGTH", "Diameter of the shaft", standard.diameter);
  size("--disc-mass", options->disc_mass, "MASS", "Mass of the disc", standard.disc_mass);
  size("--clearance", options->clearance, "LENGTH", "Radial clearance of the auxiliary bearing",
       standard.clearance);
  size("--friction", options->friction, "NUMBER", "Coefficient of friction", standard.friction);
  add_value(app, "--unbalance", options->unbalance, "MASS LENGTH",
            "Unbalance of the piece that is lost, as \"72 g mm\" or \"0.1 oz in\" (default: what "
            "makes a free orbit of two clearances)");
  add_value(app, "-o,--output", options->file, "FILE.toml",
            "File, or - for standard output (default: NAME.toml)");
  add_flag(app, "--force", options->force, "Overwrite a file that exists");
  add_flag(app, "--json", options->json, "Print the name of the file as JSON, and nothing else");
  add_flag(app, "--quiet,-q", options->quiet, "Print nothing but errors");
  return {&app, [options] { return write_starter(*options); }};
}

}  // namespace rotorub
