// rotorub identify: determines values of a scene from a measured run.

#include <memory>

#include "compare/commands/command.h"
#include "compare/commands/measured_options.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "compare/identify/identify.h"
#include "compare/identify/output.h"
#include "compare/result/result.h"
#include "compare/sweep/study_reader.h"
#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct IdentifyArguments : CommonOptions, MeasuredArguments {
  std::string scene, file;
  std::vector<std::string> fit;
};

constexpr std::size_t kMostValues = 12;  // from one record

// "contact.friction=0.05:0.4"
identify::Wanted wanted_of(const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    throw UsageError(
        "--fit {}: {}; expected KEY=FROM:TO, for example contact.friction=0.05:0.4 or "
        "contact.clearance=0.3mm:0.6mm",
        scene::printable(text), why);
  };
  const std::size_t equals = text.find('='), colon = text.find(':', equals);
  if (equals == std::string::npos || colon == std::string::npos)
    refuse("this is not a key with a range");
  identify::Wanted wanted;
  wanted.key = scene::trimmed(text.substr(0, equals));
  std::string reason;
  const scene::Key* key = sweep::scene_key(wanted.key, reason);
  if (!reason.empty()) throw UsageError("--fit {}", reason);
  const bool is_number =
      key && key->type != scene::ValueType::kWord && key->type != scene::ValueType::kFlag &&
      key->type != scene::ValueType::kText && key->type != scene::ValueType::kWhole;
  if (!is_number) refuse("this key does not take a number");
  const auto end = [&](const std::string& number) {
    const auto parsed = scene::parse_quantity(number, key->quantity);
    if (!parsed.error.empty()) refuse(parsed.error);
    return parsed.value;
  };
  wanted.from = end(text.substr(equals + 1, colon - equals - 1));
  wanted.to = end(text.substr(colon + 1));
  if (key->quantity.unit != "1") wanted.unit = key->quantity.unit;
  if (!(wanted.from < wanted.to)) refuse("FROM must be below TO");
  return wanted;
}

int run_identify(const IdentifyArguments& options) {
  identify::Parameters parameters;
  for (const std::string& text : options.fit) parameters.wanted.push_back(wanted_of(text));
  if (parameters.wanted.size() > kMostValues) {
    throw UsageError("--fit is given {} times; at most {} are accepted", parameters.wanted.size(),
                     kMostValues);
  }
  const identify::ReadScene read = scene_reader(options.scene, options);
  read({});  // reports errors in the scene before the record is read
  const MeasuredInput measured = measured_of(options);
  check_ending(options.file, ".toml");
  check_output_file(options.file);
  parameters.alignment = measured.alignment;
  parameters.interrupt = &interrupted();
  ProgressBar bar(options.quiet);
  parameters.progress = [&](double share) { bar.show(share, "identify"); };
  const identify::Result found =
      with_record(measured, [&] { return identify::identify(read, *measured.record, parameters); });
  bar.clear();
  if (found.interrupted) throw Interrupted();
  result::Section result = identify::result_of(measured.record->file, found);
  if (!options.file.empty()) {
    std::vector<std::string> values = found.overrides;
    const auto libraries = libraries_from(read(values), options.file);
    values.insert(values.end(), libraries.begin(), libraries.end());
    write_whole(options.file, read(values).text);
    result.add({written_to(options.file)});
  }
  return finish(result, options);
}

}  // namespace

Command add_identify_command(CLI::App& program) {
  auto options = std::make_shared<IdentifyArguments>();
  CLI::App& app = add_command(program, "identify",
                              "Find values of a scene from a measured run, with their confidence");
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  add_value(app, "--fit", options->fit, "KEY=FROM:TO",
            "Key to fit and the range to search, e.g. contact.friction=0.05:0.4; may be repeated")
      .repeats()
      .required();
  add_measured_options(app, *options, "from which the values are found").required();
  add_value(app, "-o,--output", options->file, "FILE.toml",
            "Write the scene with the values found to this file");
  add_run_options(app, *options);
  add_controller_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return run_identify(*options); }};
}

}  // namespace rotorub
