// rotorub init: writes a scene to start from.

#include <fmt/format.h>

#include <array>
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

// The options of the sizes, and what each sets.
struct Size {
  const char *option, *type, *words;
  StarterValue Starter::*target;
  const scene::Quantity& quantity;
  bool zero = false;  // whether 0 is accepted too
};
constexpr std::array kSizes{
    Size{"--speed", "SPEED", "Spin speed", &Starter::speed, scene::kSpin},
    Size{"--length", "LENGTH", "Length of the shaft", &Starter::length, scene::kLength},
    Size{"--diameter", "LENGTH", "Diameter of the shaft", &Starter::diameter, scene::kLength},
    Size{"--disc-mass", "MASS", "Mass of the disc", &Starter::disc_mass, scene::kMass},
    Size{"--clearance", "LENGTH", "Radial clearance of the auxiliary bearing", &Starter::clearance,
         scene::kLength},
    Size{"--friction", "NUMBER", "Coefficient of friction", &Starter::friction, scene::kPure,
         true}};

struct InitArguments : PrintOptions {
  std::string name = "rotor", form = "geometry", file, unbalance;
  Starter starter;  // the options set the texts of its sizes
  bool force = false;
};

// No real machine has sizes outside of this range.
constexpr double kLeast = 1e-6, kMost = 1e6;

// A sentence for a number without a unit, whose unit may not be the one that the user meant; empty
// for other texts.
std::string bare_number(const std::string& text, const scene::Quantity& quantity) {
  const bool bare = quantity.unit != "1" && scene::trimmed(text).find_first_not_of(
                                                "0123456789.eE+-") == std::string_view::npos;
  return bare ? fmt::format(". A number without a unit is in {}", quantity.unit) : std::string();
}

// Finds the value of the text. zero: whether 0 is accepted too.
void read(StarterValue& size, const char* option, const scene::Quantity& quantity,
          const std::string& standard, bool zero = false) {
  const auto parsed = scene::parse_quantity(size.text, quantity);
  const bool in_range =
      (zero && parsed.value == 0.0) || (parsed.value >= kLeast && parsed.value <= kMost);
  if (!parsed.error.empty() || !in_range) {
    const std::string unit = quantity.unit == "1" ? "" : " " + std::string(quantity.unit);
    throw UsageError("{} {}: expected {}{} from {:g} to {:g}{}, for example \"{}\"{}", option,
                     scene::printable(size.text), quantity.name, zero ? ", 0 or" : "", kLeast,
                     kMost, unit, standard, bare_number(size.text, quantity));
  }
  size.value = parsed.value;
}

Starter starter_of(const InitArguments& options) {
  Starter starter = options.starter;
  for (const StarterFormWord& each : kStarterForms) {
    if (options.form == each.word) starter.form = each.form;
  }
  for (const Size& size : kSizes) {
    read(starter.*size.target, size.option, size.quantity, (Starter().*size.target).text,
         size.zero);
  }
  if (!options.unbalance.empty()) {
    if (!loses_mass(starter.form)) {
      throw UsageError(
          "--unbalance: the form {} loses no mass; use --form geometry, modal, overhung or "
          "vertical",
          options.form);
    }
    starter.unbalance = StarterValue{options.unbalance};
    read(*starter.unbalance, "--unbalance", scene::kStaticMoment, "72 g mm");
  }
  if (starter.diameter.value > starter.length.value / 5.0) {
    throw UsageError(
        "--diameter {}: expected at most a fifth of the length {}, so that the shaft is a beam{}",
        scene::printable(starter.diameter.text), scene::printable(starter.length.text),
        bare_number(starter.diameter.text, scene::kLength));
  }
  if (starter.clearance.value > starter.diameter.value) {
    refuse("--clearance", scene::printable(starter.clearance.text),
           "at most the diameter, " + scene::printable(starter.diameter.text) +
               bare_number(starter.clearance.text, scene::kLength));
  }
  return starter;
}

// The file for the scene; empty for standard output.
std::filesystem::path starter_file(const InitArguments& options) {
  if (options.file == "-") return {};
  std::filesystem::path file = options.file.empty() ? options.name : options.file;
  if (!file.has_filename())
    throw UsageError("{} is the name of a folder; give the name of a scene, for example rotor.toml",
                     scene::printable(file.string()));
  if (file.extension() == ".xml") {
    throw UsageError(
        "{0}: give the name of a scene, for example rotor.toml; `rotorub mjcf SCENE.toml -o {0}` "
        "then writes its MuJoCo model",
        file.string());
  }
  if (file.extension() != ".toml") file += ".toml";
  std::error_code none;
  if (std::filesystem::is_directory(file, none))
    throw UsageError("{} is a folder; give the name of a file", file.string());
  if (file.has_parent_path() && !std::filesystem::is_directory(file.parent_path(), none)) {
    throw UsageError("{}: the folder {} does not exist; create it first", file.string(),
                     file.parent_path().string());
  }
  if (!options.force && std::filesystem::exists(file, none))
    throw UsageError("{} exists already; give another name, or --force to overwrite it",
                     file.string());
  return file;
}

// The folder for the laws beside the scene: rotor_controller for rotor.toml.
std::filesystem::path laws_folder(const InitArguments& options, const std::filesystem::path& file) {
  auto folder = file.parent_path() / (file.stem().string() + "_controller");
  if (!options.force && std::filesystem::exists(folder)) {
    throw UsageError("{} exists already; give another name, or --force to overwrite its files",
                     scene::printable(folder.string()));
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
  if (!options.quiet) note_unitless_speed("--speed", options.starter.speed.text);
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
    const std::string scene = typed(file.string());
    result.add({result::Data{"file", file.string()},
                result::line(fmt::format("written to {}\ntry: rotorub run {}",
                                         scene::printable(file.string(), 1000), scene))});
    if (!laws.empty()) {
      result.add(
          {result::Data{"controller", laws.string()},
           result::line(fmt::format(
               "starting points for your own controller in C, C++ and Python: {}\n"
               "try: cc -shared -fPIC -I {} {} -o follow.so\n"
               "     rotorub run {} --controller follow.so --set controller.sample_time=50us",
               scene::printable(laws.string(), 1000), typed(laws.string()),
               typed((laws / "follow.c").string()), scene))});
    }
  }
  // A scene without a file is printed even if nothing else is.
  return finish(result, {options.json, options.quiet && !file.empty()});
}

}  // namespace

Command add_init_command(CLI::App& program) {
  auto options = std::make_shared<InitArguments>();
  CLI::App& app =
      add_command(program, "init", "Write a commented scene to start from; it runs unchanged");
  add_option(app, "NAME", options->name, "Name of the scene (default: rotor)");
  std::vector<std::string> forms;
  for (const StarterFormWord& each : kStarterForms) forms.emplace_back(each.word);
  add_option(
      app, "--form", options->form,
      "Kind of machine: geometry (default; a shaft with disc and bearings that loses a blade), "
      "modal (the same machine reduced to one mode), rig (with torsion, motor, exciter and "
      "actuator), controller (the rig with a controller at work, and starting points for your own "
      "in C, C++ and Python), overhung (the disc is beyond the bearings), vertical (the shaft "
      "hangs "
      "from above) or two-catchers (magnetic bearings fail)")
      .one_of(forms);
  for (const Size& size : kSizes) {
    std::string& text = (options->starter.*size.target).text;
    add_value(app, size.option, text, size.type, fmt::format("{} (default: {})", size.words, text));
  }
  add_value(
      app, "--unbalance", options->unbalance, "MASS LENGTH",
      "Unbalance of the piece that is lost, e.g. \"72 g mm\" or \"0.1 oz in\" (default: the value "
      "that makes a free orbit of two clearances)");
  add_value(app, "-o,--output", options->file, "FILE.toml",
            "File, or - for standard output (default: NAME.toml)");
  add_flag(app, "--force", options->force, "Overwrite a file that exists");
  add_flag(app, "--json", options->json, "Print the name of the file as JSON, and nothing else");
  add_flag(app, "--quiet,-q", options->quiet, "Print nothing but errors");
  return {&app, [options] { return write_starter(*options); }};
}

}  // namespace rotorub
