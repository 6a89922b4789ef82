// The program `rotorub`: subcommands, and how errors become exit codes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>
#include <sstream>
#include <string>
#include <vector>

#include "compare/base/version.h"
#include "compare/commands/command.h"
#include "compare/commands/command_line.h"
#include "compare/engine/engine.h"
#include "compare/run_files/run_directory.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"

namespace {

using namespace rotorub;

// Line by line, each as a terminal can show it: a message may quote what the user wrote.
std::string shown(const std::string& message) {
  constexpr std::size_t kLongestLine = 1000;  // bytes
  std::istringstream lines(message);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    text += (text.empty() ? "" : "\n") + scene::printable(line, kLongestLine);
  }
  return text;
}

int failed(int code, const std::string& message) {
  std::cerr << "rotorub: " << shown(message) << "\n";
  return code;
}

// The parser's own words: help and version on standard output, mistakes on standard error.
int parser_exit(const CLI::App& program, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const int code = program.exit(error, out, err) == 0 ? kDone : kBadInput;
  std::cout << out.str();
  if (!err.str().empty()) std::cerr << shown(err.str()) << "\n";
  return code;
}

// What was printed has arrived, or the program has not done what it was asked to. `code`: what it
// would end with.
int with_whole_output(int code) {
  const bool streamed = static_cast<bool>(std::cout.flush());
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (streamed && flushed) return code;
  failed(kFailed, "standard output could not be written to its end");
  return code == kDone || code == kOutside ? kFailed : code;
}

// A variable of a script that is not set, and "-o=DIR", which would name a folder "=DIR". Empty:
// there is none.
std::string empty_value(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& value : option->results()) {
      if (value.empty() || value == "=") return option->get_name() + ": its value is empty";
      if (value.starts_with('='))
        return fmt::format("{0} {1}: accepted is {0} {2}", option->get_name(), value,
                           value.substr(1));
    }
  }
  return {};
}

int run(const Action& action) {
  try {
    return action();
  } catch (const scene::SceneError& error) {
    std::cerr << error.what() << "\n";
    return kBadInput;
  } catch (const UsageError& error) {
    return failed(kBadInput, error.what());
  } catch (const UnwritablePlace& error) {
    return failed(kBadInput, error.what());
  } catch (const BrokenRun& error) {
    return failed(kBadInput, error.what());
  } catch (const MissingColumn& error) {
    return failed(kBadInput, error.what());
  } catch (const NotOffered& error) {
    return failed(kBadInput, error.what());
  } catch (const std::invalid_argument& error) {
    return failed(kBadInput, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string place = error.path1().string();
    return failed(kBadInput,
                  (place.empty() ? "the current folder" : place) + ": " + error.code().message());
  } catch (const std::bad_alloc&) {
    return failed(kFailed,
                  "there is not enough memory for this: a shorter run, fewer rows or a smaller "
                  "picture needs less");
  } catch (const Interrupted& error) {
    return failed(kStopped, error.what());
  } catch (const std::exception& error) {
    return failed(kFailed, error.what());
  }
}

int rotorub_main(int argc, char** argv) {
  CLI::App program(
      "A flexible rotor rubbing in an active auxiliary bearing, in MuJoCo and in a "
      "native rigid-contact model",
      "rotorub");
  set_help_format(program);  // before its commands: they take it over
  program.set_version_flag("--version", version_line());
  program.require_subcommand(1);
  const std::vector<Command> commands{
      add_init_command(program),     add_run_command(program),   add_compare_command(program),
      add_modes_command(program),    add_mjcf_command(program),  add_fmu_command(program),
      add_render_command(program),   add_bench_command(program), add_sweep_command(program),
      add_optimise_command(program), add_check_command(program), add_tune_command(program),
      add_identify_command(program), add_plot_command(program),  add_schema_command(program),
      add_manual_command(program)};
  program.footer("`rotorub help COMMAND` lists the options of a command.");
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.app->get_name());
  std::vector<std::string> arguments = with_help({argv + 1, argv + argc});
  if (const std::string wrong = unknown_command(arguments, names); !wrong.empty()) {
    return failed(kBadInput, wrong);
  }
  std::reverse(arguments.begin(), arguments.end());  // as the parser takes them
  try {
    program.parse(std::move(arguments));
  } catch (const CLI::ParseError& error) {
    return parser_exit(program, error);
  }
  for (const Command& command : commands) {
    if (!command.app->parsed()) continue;
    if (const std::string wrong = empty_value(*command.app); !wrong.empty())
      return failed(kBadInput, wrong);
  }
  catch_interrupts();
  // A file beyond `ulimit -f` then fails to be written, which is reported.
  std::signal(SIGXFSZ, SIG_IGN);
  for (const Command& command : commands) {
    if (command.app->parsed()) return run(command.action);
  }
  return kBadInput;
}

}  // namespace

// An interruption is reported as a shell reports the signal: 130 (SIGINT), 143 (SIGTERM).
int main(int argc, char** argv) {
  const int code = with_whole_output(rotorub_main(argc, argv));
  return code == kStopped && interrupting_signal() > 0 ? 128 + interrupting_signal() : code;
}
