// rotorub manual: prints the program's manual page or completion, generated from its parser.

#include <memory>
#include <string>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/parser_text.h"
#include "compare/manual/program_text.h"
#include "compare/manual/scene_schema.h"

namespace rotorub {
namespace {

struct ManualArguments {
  std::string kind = "man", file;
};

int write_manual(const CLI::App& program, const ManualArguments& options) {
  const ProgramText words = program_text(program);
  write_or_print(options.file, options.kind == "bash" ? bash_completion(words) : man_page(words));
  return kDone;
}

}  // namespace

Command add_schema_command(CLI::App& program) {
  auto file = std::make_shared<std::string>();
  CLI::App& app = add_command(program, "schema",
                              "Print the tables and keys of a scene as a JSON schema, "
                              "with which an editor completes and checks scenes");
  add_value(app, "-o,--output", *file, "FILE.json", "File (default: standard output)");
  return {&app, [file] {
            write_or_print(*file, scene_schema());
            return kDone;
          }};
}

Command add_manual_command(CLI::App& program) {
  auto options = std::make_shared<ManualArguments>();
  CLI::App& app =
      add_command(program, "manual", "Print the manual page, or the completion for Bash");
  add_option(app, "KIND", options->kind, "man: the manual page; bash: the completion for Bash")
      .one_of({"man", "bash"})
      .shows_default();
  add_value(app, "-o,--output", options->file, "FILE", "File (default: standard output)");
  return {&app, [options, &program] { return write_manual(program, *options); }};
}

}  // namespace rotorub
