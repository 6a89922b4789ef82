// rotorub schema: the scene's tables and keys for editors.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "compare/commands/command.h"
#include "compare/manual/scene_schema.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

int write_schema(const std::string& file) {
  const std::string text = scene_schema();
  if (file.empty()) {
    std::cout << text;
  } else {
    write_whole(file, text);
  }
  return kDone;
}

}  // namespace

Command add_schema_command(CLI::App& program) {
  auto file = std::make_shared<std::string>();
  CLI::App* app = program.add_subcommand(
      "schema",
      "The tables and keys of a scene as a JSON schema, with which an editor completes and checks");
  app->add_option("-o,--output", *file, "File (default: standard output)")->type_name("FILE.json");
  return {app, [file] { return write_schema(*file); }};
}

}  // namespace rotorub
