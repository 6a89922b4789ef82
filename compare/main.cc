// The program `rotorub`: subcommands, and how errors become exit codes.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <vector>

#include "compare/commands/command.h"
#include "compare/commands/interrupt.h"
#include "compare/engine/engine.h"
#include "compare/version.h"
#include "native_model/scene/diagnostic.h"

namespace {

using namespace rotorub;

int failed(int code, const std::string& message) {
  std::cerr << "rotorub: " << message << "\n";
  return code;
}

int run(const Action& action) {
  try {
    return action();
  } catch (const scene::SceneError& error) {
    std::cerr << error.what() << "\n";
    return kBadInput;
  } catch (const UsageError& error) {
    return failed(kBadInput, error.what());
  } catch (const NotOffered& error) {
    return failed(kBadInput, error.what());
  } catch (const std::invalid_argument& error) {
    return failed(kBadInput, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return failed(kBadInput, error.what());
  } catch (const Interrupted& error) {
    return failed(kStopped, error.what());
  } catch (const std::exception& error) {
    return failed(kFailed, error.what());
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App program(
      "A flexible rotor rubbing in an active auxiliary bearing, in MuJoCo and in a "
      "native rigid-contact model",
      "rotorub");
  program.set_version_flag("--version",
                           "rotorub " + program_version() + " (MuJoCo " + mujoco_version() + ")");
  program.require_subcommand(1);
  const std::vector<Command> commands{add_run_command(program), add_compare_command(program),
                                      add_modes_command(program), add_mjcf_command(program),
                                      add_render_command(program)};
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return program.exit(error) == 0 ? kDone : kBadInput;
  }
  catch_interrupts();
  for (const Command& command : commands) {
    if (command.app->parsed()) return run(command.action);
  }
  return kBadInput;
}
