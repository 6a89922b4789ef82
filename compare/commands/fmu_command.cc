// rotorub fmu: exports a scene as a plant for other programs (Functional Mock-up Interface).

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "compare/base/module_file.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/fmu/archive.h"
#include "compare/fmu/description.h"
#include "compare/fmu/names.h"
#include "compare/result/result.h"
#include "native_model/scene/reader.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct FmuArguments : CommonOptions {
  std::string scene, file, version = "3.0";
  bool modal = false;
};

// The shared library with the plant and its FMI functions.
std::string binary() {
  const std::filesystem::path file = module_file("librotorub_fmu.so");
  if (file.empty())
    throw std::runtime_error(
        "librotorub_fmu.so is missing; it belongs in the folder lib beside the program's bin");
  return scene::regular_file_text(file);
}

std::vector<fmi::ArchiveFile> files_of(const scene::Scene& scene, const StepwiseRun& run,
                                       fmi::Version version, bool modal) {
  return {{"modelDescription.xml", model_description(scene, run, version, modal)},
          {std::string("resources/") + fmi::kSceneFile, scene.text},
          {fmi::binary_path(scene, version), binary()}};
}

// Whether a library commands a ring.
bool has_ring_library(const scene::Scene& scene) {
  return std::ranges::any_of(scene.auxiliary, [](const scene::AuxiliaryBearing& at) {
    return at.controller && at.controller->kind == scene::ControllerKind::kLibrary;
  });
}

// JSON alone.
result::Table ports_table(const std::string& place, const std::vector<StepwiseRun::Port>& ports) {
  result::Table table{
      .place = place, .columns = {{"name"}, {"unit"}, {"meaning"}}, .seen = result::kJson};
  for (const StepwiseRun::Port& port : ports)
    table.rows.push_back({.items = {{port.name}, {port.unit}, {port.meaning}}});
  return table;
}

// JSON alone.
result::Table parameters_table(const std::vector<scene::Adjustable>& parameters) {
  result::Table table{.place = "parameters/#/{column}",
                      .columns = {{"name"}, {"unit"}, {"start"}, {"meaning"}},
                      .seen = result::kJson};
  for (const scene::Adjustable& number : parameters)
    table.rows.push_back({.items = {{number.name()},
                                    {std::string(number.key->quantity.unit)},
                                    {number.value},
                                    {std::string(number.key->meaning)}}});
  return table;
}

int write_fmu(const FmuArguments& options) {
  const scene::Scene scene = read_scene(options.scene, options);
  const std::filesystem::path file = options.file.empty() ? scene.name + ".fmu" : options.file;
  check_ending(file, ".fmu");
  check_output_file(file);
  const StepwiseRun run(scene);
  const fmi::Version version = options.version == "2.0" ? fmi::Version::k2 : fmi::Version::k3;
  write_whole(file, fmi::archive(files_of(scene, run, version, options.modal)));
  const std::vector<StepwiseRun::Port> outputs = fmi::outputs_of(run, options.modal);
  const std::vector<scene::Adjustable> parameters = fmi::parameters_of(scene);
  std::string inputs;
  for (const StepwiseRun::Port& port : run.inputs())
    inputs += fmt::format("{}{} ({})", inputs.empty() ? "" : ", ", port.name, port.unit);
  result::Section result{
      .parts = {
          result::Data{"",
                       {{"scene", scene.name},
                        {"scene_hash", scene::scene_hash(scene)},
                        {"file", file.string()},
                        {"fmi_version", options.version}}},
          ports_table("inputs/#/{column}", run.inputs()),
          ports_table("outputs/#/{column}", outputs), parameters_table(parameters),
          result::line(fmt::format("FMI {}, co-simulation; {} outputs; {} parameters; inputs: {}",
                                   options.version, outputs.size(), parameters.size(), inputs)),
          written_to(file)}};
  if (has_ring_library(scene)) {
    const bool is_current = std::ranges::find(run.inputs(), "command_1",
                                              &StepwiseRun::Port::name) != run.inputs().end();
    result.add({result::Sentence{fmt::format(
        "The scene's controller is a library and is not part of the FMU; {} take its place.",
        is_current ? "command_1 and command_2" : "command_x and command_y")}});
  }
  return finish(result, options);
}

}  // namespace

Command add_fmu_command(CLI::App& program) {
  auto options = std::make_shared<FmuArguments>();
  CLI::App& app =
      add_command(program, "fmu",
                  "Write a scene as a plant for Simulink, Modelica or FMPy (FMI, co-simulation)");
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  add_value(app, "-o,--output", options->file, "FILE.fmu", "File (default: SCENE.fmu)");
  add_option(app, "--fmi", options->version, "Version of the interface, 3.0 or 2.0")
      .one_of({"3.0", "2.0"})
      .shows_default();
  add_flag(app, "--modal", options->modal,
           "Show the coordinates of the rotor's modes as outputs too");
  add_common_options(app, *options);
  return {&app, [options] { return write_fmu(*options); }};
}

}  // namespace rotorub
