// The program `rotorub`: its commands, and how errors become exit codes.

#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/commands/command.h"
#include "compare/commands/command_line.h"
#include "compare/commands/terminal.h"
#include "compare/run_files/run_directory.h"
#include "native_model/control/shared_law.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/text.h"
#include "native_model/trajectory/output.h"

namespace {

using namespace rotorub;

int failed(int code, const std::string& message) {
  print_message(message);
  return code;
}

// A controller's library may call exit(). Its exit code must not look like one of rotorub's,
// because the work was not finished.
bool at_work = false;
void end_of_process() {
  if (!at_work) return;
  std::fputs(
      "rotorub: a loaded library, for example a controller, ended the program by calling exit(), "
      "so "
      "the results are incomplete. A controller must report a failure by its return value "
      "(rotorub/controller.h).\n",
      stderr);
  std::_Exit(kFailed);
}

// Returns `code` if standard output was written completely, otherwise the exit code of a failure.
int with_whole_output(int code) {
  const bool streamed = static_cast<bool>(std::cout.flush());
  const bool flushed = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (streamed && flushed) return code;
  failed(kFailed, "standard output could not be written completely");
  return code == kDone || code == kOutside ? kFailed : code;
}

int run(const Action& action) {
  try {
    return action();
  } catch (const scene::SceneError& error) {
    print_diagnostics(error.what());
    return kBadInput;
  } catch (const UsageError& error) {
    return failed(kBadInput, error.what());
  } catch (const UnwritablePlace& error) {
    return failed(kBadInput, error.what());
  } catch (const BrokenRun& error) {
    return failed(kBadInput, error.what());
  } catch (const MissingColumn& error) {
    return failed(kBadInput, error.what());
  } catch (const std::invalid_argument& error) {
    return failed(kBadInput, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    const std::string place = error.path1().string();
    return failed(kBadInput,
                  (place.empty() ? "the current folder" : place) + ": " + error.code().message());
  } catch (const std::bad_alloc&) {
    return failed(kFailed,
                  "there is not enough memory; try a shorter run, fewer rows or a smaller picture");
  } catch (const Interrupted& error) {
    return failed(kStopped, error.what());
  } catch (const std::exception& error) {
    return failed(kFailed, error.what());
  }
}

// Says which law was running when the program crashes. Only async-signal-safe functions; the signal
// then has its usual effect.
void on_crash(int signal) {
  if (const char* law = running_law()) {
    const auto say = [](const char* text) { return write(STDERR_FILENO, text, std::strlen(text)); };
    if (say("rotorub: the code of the controller ") < 0 || say(law) < 0 ||
        say(signal == SIGABRT ? " has called abort()\n"
                              : " has caused a fault (such as an invalid address or a division by "
                                "zero); run it with gdb --args\n") < 0) {
      return;
    }
  }
  raise(signal);  // blocked here, so it arrives with the default action after the return
}

void catch_crashes() {
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) {
    struct sigaction before = {}, action = {};
    if (sigaction(signal, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) continue;
    action.sa_handler = on_crash;
    action.sa_flags = SA_RESETHAND;
    sigemptyset(&action.sa_mask);
    sigaction(signal, &action, nullptr);
  }
}

int rotorub_main(const std::vector<std::string>& arguments) {
  const std::shared_ptr<CLI::App> whole = new_program();
  CLI::App& program = *whole;
  const std::vector<Command> commands{
      add_init_command(program),     add_run_command(program),   add_compare_command(program),
      add_modes_command(program),    add_mjcf_command(program),  add_fmu_command(program),
      add_render_command(program),   add_bench_command(program), add_sweep_command(program),
      add_optimise_command(program), add_check_command(program), add_tune_command(program),
      add_identify_command(program), add_plot_command(program),  add_schema_command(program),
      add_manual_command(program)};
  return run([&]() -> int {
    const Action action = parse(program, commands, arguments);
    catch_interrupts();
    catch_crashes();
    // A file larger than `ulimit -f` then causes a write error, which is reported.
    std::signal(SIGXFSZ, SIG_IGN);
    return action();
  });
}

}  // namespace

// An interruption is reported as a shell reports the signal: 130 (SIGINT), 143 (SIGTERM).
int main(int argc, char** argv) {
  std::atexit(end_of_process);
  at_work = true;
  const int code = with_whole_output(rotorub_main({argv + 1, argv + argc}));
  at_work = false;
  return code == kStopped && interrupting_signal() > 0 ? 128 + interrupting_signal() : code;
}
