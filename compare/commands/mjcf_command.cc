// rotorub mjcf: writes a scene as MuJoCo's XML.

#include <memory>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/result/result.h"
#include "mjcf/writer.h"
#include "native_model/scene/reader.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct MjcfArguments : CommonOptions {
  std::string scene, file, mujoco;
};

int write_mjcf(const MjcfArguments& options) {
  check_ending(options.file, ".xml");
  check_output_file(options.file);
  const scene::Scene scene = read_scene(options.scene, options);
  const MujocoVersion target =
      options.mujoco.empty() ? built_for() : read_mujoco_version(options.mujoco);
  const std::string xml = mjcf(scene, target);
  result::Section result{
      .parts = {
          result::Data{"", {{"scene", scene.name}, {"scene_hash", scene::scene_hash(scene)}}}}};
  if (options.file.empty()) {
    result.add({result::Data{"mjcf", xml}, result::line(xml)});
  } else {
    write_whole(options.file, xml);
    result.add({result::Data{"file", options.file}, written_to(options.file)});
  }
  // A model without a file is printed even if nothing else is.
  return finish(result, {options.json, options.quiet && !options.file.empty()});
}

}  // namespace

Command add_mjcf_command(CLI::App& program) {
  auto options = std::make_shared<MjcfArguments>();
  CLI::App& app = add_command(program, "mjcf", "Write a scene as MuJoCo's XML");
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  add_value(app, "-o,--output", options->file, "FILE.xml", "File (default: standard output)");
  add_value(app, "--mujoco", options->mujoco, "VERSION",
            "Version of MuJoCo that will read the file (default: " + to_string(built_for()) + ")");
  add_common_options(app, *options);
  return {&app, [options] { return write_mjcf(*options); }};
}

}  // namespace rotorub
