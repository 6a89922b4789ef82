// What the subcommands share: exit codes, common options, and how they join the program.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/hdf5/module.h"
#include "compare/own/own_machine.h"
#include "compare/run_files/run_directory.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/units.h"
#include "native_model/trajectory/trajectory.h"

namespace CLI {
class App;
}

namespace rotorub {

// The contract's exit codes.
enum ExitCode { kDone = 0, kOutside = 1, kBadInput = 2, kFailed = 3, kStopped = 130 };

// A mistake on the command line that the parser cannot see: exit code 2.
class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};
// The user stopped it (SIGINT): exit code 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

struct CommonOptions {
  std::vector<std::string> overrides;  // "table.key=value"
  std::string step, end;               // overrides of run.step and run.end; empty: none
  std::string controller;      // library in the place of the scene's controller; empty: none
  bool allow_library = false;  // scenes may have their library opened
  bool json = false, quiet = false;
};

// --set, --json, --quiet, and --step and --end.
void add_common_options(CLI::App& command, CommonOptions& options);
void add_run_options(CLI::App& command, CommonOptions& options);
// --controller and --allow-library; --allow-library alone.
void add_controller_option(CLI::App& command, CommonOptions& options);
void add_allow_library_option(CLI::App& command, CommonOptions& options);
// --format csv|hdf5
void add_format_option(CLI::App& command, std::string& format);
// Null: csv. Throws UsageError where there is no module for hdf5.
hdf5::ImageOf hdf5_of(const std::string& format);

// --controller and --set, as overrides.
std::vector<std::string> overrides_of(const CommonOptions& options);
// The scene with all overrides applied, --step and --end last. Throws scene::SceneError.
scene::Scene read_scene(const std::string& file, const CommonOptions& options);

// Reads each of the files; throws one scene::SceneError with everything that is wrong in any of
// them.
void read_each(const std::vector<std::string>& files,
               const std::function<void(const std::string&)>& read);

// --step, --end, --controller and --set for a machine of the user's own; throws UsageError for a
// key that is not of its controller.
OwnRun own_run(const CommonOptions& options);

// What an option was given, as "10us", in SI. Throws UsageError with the option, the text, and what
// is accepted; empty: what is wrong with it as such a quantity.
double quantity_of(const std::string& option, const std::string& text,
                   const scene::Quantity& quantity, const std::string& accepted = {});
// A note on standard error where the text is a speed without a unit that reads as turns per minute.
void note_unitless_speed(const std::string& option, const std::string& text);
// A tolerance as a user writes it: "1%" or 0.01; a bare number of 1 or more is refused, as it may
// mean either. Throws UsageError.
double tolerance_of(const std::string& text);
// Throws UsageError for a number of twins that is none, or more than a spread has a use for.
void check_twins(int twins);
// "rigid", "coulomb", "cone"; asserts one of them.
scene::ContactModel contact_model_of(const std::string& name);

// Adds a subcommand to the program. The action runs after parsing and gives the exit code.
using Action = std::function<int()>;
struct Command {
  CLI::App* app = nullptr;
  Action action;
};
Command add_run_command(CLI::App& program);
Command add_compare_command(CLI::App& program);
Command add_modes_command(CLI::App& program);
Command add_mjcf_command(CLI::App& program);
Command add_fmu_command(CLI::App& program);
Command add_render_command(CLI::App& program);
Command add_plot_command(CLI::App& program);
Command add_init_command(CLI::App& program);
Command add_schema_command(CLI::App& program);
Command add_bench_command(CLI::App& program);
Command add_sweep_command(CLI::App& program);
Command add_optimise_command(CLI::App& program);
Command add_check_command(CLI::App& program);
Command add_tune_command(CLI::App& program);
Command add_identify_command(CLI::App& program);
// The manual of the program itself: added last.
Command add_manual_command(CLI::App& program);

// Every command calls one of these with what -o names, or with its default, before its work starts,
// so that hours of work are not lost. They throw UsageError with the place and the reason: a folder
// that cannot be created or takes no new files, a file in the place of a folder, a folder in the
// place of a file, or a file that is there and read-only. They do nothing if the name is empty.
void check_output_file(const std::filesystem::path& file);
// files: the names of all that the command may write there, which may have folders of their own.
void check_output_folder(const std::filesystem::path& folder,
                         const std::vector<std::string>& files);
// To the file, or without one to standard output.
void write_or_print(const std::string& file, const std::string& text);
// The exit code for the status of a run.
int exit_code_of(Status status);
// On standard error why a run did not come to its end; `what`: which run of the scene, "shadow: ".
void say_failure(const scene::Scene& scene, const std::string& what, const Trajectory& trajectory);

// SIGINT, SIGTERM and SIGHUP as a flag that long work polls. From now on the first of them sets the
// flag, the second of its kind ends the program, as 20 s do after a SIGTERM or SIGHUP. One that the
// program was started to ignore stays ignored.
void catch_interrupts();
const std::atomic<bool>& interrupted();
int interrupting_signal();  // 0: none yet

// The run in a folder, as a command is given it. Throws UsageError for a folder that is none of a
// run, or of a broken one: a mistake of who named it.
StoredRun stored_run(const std::string& folder);

}  // namespace rotorub
