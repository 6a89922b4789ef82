#include "compare/commands/command.h"

#include <CLI/CLI.hpp>

#include "native_model/scene/reader.h"

namespace rotorub {

void add_common_options(CLI::App& command, CommonOptions& options) {
  command
      .add_option("--set", options.overrides,
                  "Override a value of the scene, e.g. contact.friction=0.2; may be repeated")
      ->type_name("TABLE.KEY=VALUE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
  command.add_flag("--json", options.json, "Print the summary as JSON, and nothing else");
  command.add_flag("--quiet,-q", options.quiet, "Print nothing but errors");
}

void add_run_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--step", options.step, "Fixed step, e.g. 10us (run.step)")->type_name("TIME");
  command.add_option("--end", options.end, "End of the run, e.g. 0.5s (run.end)")
      ->type_name("TIME");
}

scene::Scene read_scene(const std::string& file, const CommonOptions& options) {
  std::vector<std::string> overrides = options.overrides;
  if (!options.step.empty()) overrides.push_back("run.step=" + options.step);
  if (!options.end.empty()) overrides.push_back("run.end=" + options.end);
  return scene::read_scene(file, overrides);
}

int exit_code_of(Status status) {
  if (status == Status::kOk) return kDone;
  return status == Status::kInterrupted ? kStopped : kFailed;
}

}  // namespace rotorub
