// Shared by the subcommands: exit codes, common options, and how they are added to the program.
#pragma once

#include <fmt/format.h>

#include <atomic>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/hdf5/module.h"
#include "compare/own/own_machine.h"
#include "compare/result/result.h"
#include "compare/run_files/run_directory.h"
#include "native_model/scene/scene.h"
#include "native_model/scene/units.h"
#include "native_model/trajectory/trajectory.h"

namespace CLI {
class App;
}

namespace rotorub {

// The exit codes of the contract.
enum ExitCode { kDone = 0, kOutside = 1, kBadInput = 2, kFailed = 3, kStopped = 130 };

// A mistake on the command line that the parser does not detect: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
  template <class First, class... Rest>
  UsageError(fmt::format_string<First, Rest...> text, First&& first, Rest&&... rest)
      : runtime_error(fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...)) {}
};
// Throws UsageError: "--fps 0: expected a number from 1 to 120".
[[noreturn]] void refuse(std::string_view option, std::string_view value,
                         std::string_view accepted);
// The user interrupted the program (SIGINT): exit code 130.
class Interrupted : public std::runtime_error {
 public:
  Interrupted() : std::runtime_error("interrupted") {}
};

struct PrintOptions {
  bool json = false, quiet = false;
  std::string units{};  // si, mm or us; empty: as the results are written
};

struct CommonOptions : PrintOptions {
  std::vector<std::string> overrides;  // "table.key=value"
  std::string step, end;               // overrides of run.step and run.end; empty if not given
  std::string controller;              // library that replaces the scene's controller; may be empty
  bool allow_library = false;          // the libraries of scenes may be opened
};

// --set, --json, --quiet, and --step and --end.
void add_common_options(CLI::App& command, CommonOptions& options);
void add_run_options(CLI::App& command, CommonOptions& options);
// --units
void add_units_option(CLI::App& command, PrintOptions& options);
// --controller and --allow-library, or only --allow-library. A command without the latter opens no
// library of a scene.
void add_controller_option(CLI::App& command, CommonOptions& options);
void add_allow_library_option(CLI::App& command, CommonOptions& options);
// --format csv|hdf5
void add_format_option(CLI::App& command, std::string& format);
// Null for csv. Throws UsageError if there is no module for hdf5.
hdf5::ImageOf hdf5_of(const std::string& format);

// --controller and --set, as overrides.
std::vector<std::string> overrides_of(const CommonOptions& options);
// Overrides with the absolute paths of a scene's libraries, if `file`, a copy of the scene, is in
// another folder; otherwise none.
std::vector<std::string> libraries_from(const scene::Scene& scene,
                                        const std::filesystem::path& file);
// A word as a user types it in a shell: in quotes only if it needs them.
std::string typed(const std::string& word);
// "rotorub tune rig.toml --controller law.so --set contact.friction=0.2": the command for this file
// with --controller, --set, --end and --allow-library as given.
std::string command_text(std::string_view command, const std::string& file,
                         const CommonOptions& options);
// The scene with all overrides applied, --step and --end last. Throws scene::SceneError.
scene::Scene read_scene(const std::string& file, const CommonOptions& options);
// Reads the scene with further overrides, after those of the options, which must outlive it.
std::function<scene::Scene(const std::vector<std::string>&)> scene_reader(
    const std::string& file, const CommonOptions& options);

// Reads every file, then throws one scene::SceneError with the errors of all of them, if any.
void read_each(const std::vector<std::string>& files,
               const std::function<void(const std::string&)>& read);

// --step, --end, --controller and --set for a user's own machine. Throws UsageError for a key that
// does not belong to its controller.
OwnRun own_run(const CommonOptions& options);

// The value of an option, as "10us", in SI. Throws UsageError with the option, the text and
// `accepted`, or if that is empty the error in reading the quantity.
double quantity_of(const std::string& option, const std::string& text,
                   const scene::Quantity& quantity, const std::string& accepted = {});
// Throws UsageError or scene::SceneError if the fixed step (run.step, --step) does not divide the
// sample time of a magnetic bearing's control, with a step that does.
void check_sample_times(const scene::Scene& scene, const CommonOptions& options);
// Writes a note to standard error if the text is a speed without a unit that looks like rpm.
void note_unitless_speed(const std::string& option, const std::string& text);
// A tolerance as "1%" or 0.01. A plain number of 1 or more is ambiguous and refused. Throws
// UsageError.
double tolerance_of(const std::string& text);
// Throws UsageError for a number of twins that is invalid or larger than useful.
void check_twins(int twins);

// A subcommand of the program. The action runs after parsing and returns the exit code.
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
// The program's own manual; add it last.
Command add_manual_command(CLI::App& program);

// Every command calls one of these with the value of -o, or with its default, before its work
// starts, so that hours of work are not lost. They throw UsageError with the place and the reason:
// the folder cannot be created or written to, a file is in the place of a folder or a folder in the
// place of a file, or the file exists and is read-only. They do nothing if the name is empty.
void check_output_file(const std::filesystem::path& file);
// Throws UsageError if the file has another ending than `ending` (".xml"), unless it is a device or
// a folder.
void check_ending(const std::filesystem::path& file, std::string_view ending);
// files: all names that the command may write there; they may include subfolders.
void check_output_folder(const std::filesystem::path& folder,
                         const std::vector<std::string>& files);
// Writes to the file, or to standard output if `file` is empty.
void write_or_print(const std::string& file, const std::string& text);

// Prints the result as JSON or in words, in colours on a terminal, or not at all, and returns the
// exit code.
int finish(const result::Section& result, const PrintOptions& options, int code = kDone);
// Prints words before the result, at once, for people alone.
void say(const PrintOptions& options, const std::string& words);
// "written to runs/ring-native"
result::Sentence written_to(const std::filesystem::path& place);

// Runs the scene with a progress bar. An interrupt ends the run.
Trajectory run_shown(const Engine& engine, const scene::Scene& scene, const std::string& what,
                     bool quiet);
// The exit code for the status of a run.
int exit_code_of(Status status);
// Notes that --step has no effect, if it was given for a native run by `integrator` = event.
void note_idle_step(const CommonOptions& options, scene::Integrator integrator);
// Writes to standard error why a run did not reach its end. what: which run of the scene, "shadow:
// ".
void say_failure(const scene::Scene& scene, const std::string& what, const Trajectory& trajectory);

// Sets a flag at SIGINT, SIGTERM or SIGHUP, which long tasks poll. The second signal of the same
// kind ends the program, and so does a SIGTERM or SIGHUP after 20 s. A signal that was ignored when
// the program started stays ignored.
void catch_interrupts();
const std::atomic<bool>& interrupted();
int interrupting_signal();  // 0 if there was none

// The run in a folder that the user named. Throws UsageError if the folder contains no run or
// the run is broken.
StoredRun stored_run(const std::string& folder);

}  // namespace rotorub
