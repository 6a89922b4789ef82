// rotorub mjcf: writes a scene as MuJoCo's XML.

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "compare/base/json.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/terminal.h"
#include "mjcf/writer.h"
#include "native_model/control/library.h"
#include "native_model/scene/reader.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

struct MjcfArguments : CommonOptions {
  std::string scene, file, mujoco;
};

int write_mjcf(const MjcfArguments& options) {
  check_output_file(options.file);
  const scene::Scene scene = read_scene(options.scene, options);
  const MujocoVersion target =
      options.mujoco.empty() ? built_for() : read_mujoco_version(options.mujoco);
  const std::string xml = mjcf(scene, target);
  if (options.file.empty()) {
    if (options.json) {
      std::cout << json_text(
          {{"scene", scene.name}, {"scene_hash", scene::scene_hash(scene)}, {"mjcf", xml}});
    } else {
      std::cout << xml;
    }
    return kDone;
  }
  write_whole(options.file, xml);
  if (options.json) {
    std::cout << json_text(
        {{"scene", scene.name}, {"scene_hash", scene::scene_hash(scene)}, {"file", options.file}});
  } else if (!options.quiet) {
    fmt::print("written to {}\n", printable_path(options.file));
  }
  return kDone;
}

}  // namespace

Command add_mjcf_command(CLI::App& program) {
  auto options = std::make_shared<MjcfArguments>();
  CLI::App& app = add_command(program, "mjcf", "Write a scene as MuJoCo's XML");
  add_option(app, "SCENE", options->scene, "Scene file (.toml)").required();
  add_value(app, "-o,--output", options->file, "FILE", "File (default: standard output)");
  add_value(app, "--mujoco", options->mujoco, "VERSION",
            "Version of MuJoCo that is to read it (default: " + to_string(built_for()) + ")");
  add_common_options(app, *options);
  return {&app, [options] {
            set_scene_libraries(SceneLibraries::kLeftOut);
            return write_mjcf(*options);
          }};
}

}  // namespace rotorub
