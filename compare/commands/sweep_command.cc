// rotorub sweep: maps over values of a scene, on this computer or on a cluster.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <thread>

#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/sweep_output.h"
#include "compare/commands/sweep_progress.h"
#include "compare/commands/terminal.h"
#include "compare/result/result.h"
#include "compare/sweep/bifurcation.h"
#include "compare/sweep/sweep_run.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

using std::filesystem::path;

void check_arguments(const SweepArguments& options) {
  const int modes =
      (options.shard.empty() ? 0 : 1) + (options.slurm ? 1 : 0) + (options.merge.empty() ? 0 : 1);
  if (modes > 1)
    throw UsageError("--shard, --slurm and --merge exclude each other; give one of them");
  if (options.bifurcation && (!options.shard.empty() || options.slurm))
    throw UsageError(
        "--bifurcation follows a motion from value to value, so it cannot be split; leave out "
        "--shard "
        "and --slurm");
  if (!options.points.empty() && (modes > 0 || options.bifurcation))
    throw UsageError(
        "--point runs single points; leave out --shard, --slurm, --merge and --bifurcation");
  if (options.tasks > 0 && !options.slurm)
    throw UsageError("--tasks belongs to --slurm, which is missing");
}

// "13 points: 12 ok, 1 diverged"
std::string counts_text(sweep::Store& store) {
  std::string text;
  for (const auto& [status, count] : store.count_by_status())
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, status);
  return fmt::format("{} points: {}", store.count(), text.empty() ? "none" : text);
}

std::string results_text(const Sweep& sweep, sweep::Store& store) {
  const auto counts = store.count_by_status();
  const bool all_ok = std::ranges::all_of(counts, [](const auto& c) { return c.first == "ok"; });
  return fmt::format("{}\nwritten to {} ({}, results.sqlite, {}){}", counts_text(store),
                     printable_path(sweep.folder), sweep::kCsvFile, sweep::kPageFile,
                     all_ok ? "" : "; the column `reason` says why points failed");
}

// Prints what is stored as JSON, or words for people, which may be empty. Returns kDone.
int finish_with_state(const SweepArguments& options, const Sweep& sweep, sweep::Store& store,
                      const sweep::Shard& shard, const std::string& words) {
  const auto identity = sweep::identity_of(*sweep.scenes);
  const std::int64_t done = store.count();
  result::Section state{
      .parts = {result::Data{"",
                             {{"study_hash", identity.hash},
                              {"points", identity.points},
                              {"done", done},
                              {"status", store.count_by_status()},
                              {"shard", fmt::format("{}/{}", shard.number, shard.count)},
                              {"complete", done == shard.points_of(identity.points)},
                              {"folder", sweep.folder.string()}}}}};
  if (!words.empty()) state.add({result::line(words)});
  return finish(state, options);
}

int run_points(const SweepArguments& options, const Sweep& sweep) {
  const sweep::Shard shard =
      options.shard.empty() ? sweep::Shard{} : sweep::parse_shard(options.shard);
  sweep::Store store = sweep.store(shard);
  SweepProgressReport report(options.quiet, shard, sweep.jobs);
  sweep::SweepOptions run;
  run.jobs = sweep.jobs;
  run.shard = shard;
  run.interrupt = &interrupted();
  run.progress = [&](const sweep::SweepProgress& progress) { report.show(progress); };
  const bool complete = sweep::run_sweep(*sweep.scenes, store, run);
  report.clear();
  const std::string file = (sweep.folder / shard.file()).string();
  if (!complete) {
    finish_with_state(
        options, sweep, store, shard,
        fmt::format("{} points are stored in {}; run the same command again to continue",
                    store.count(), file));
    throw Interrupted();
  }
  if (shard.whole()) write_results(options, sweep, store);
  return finish_with_state(
      options, sweep, store, shard,
      shard.whole() ? results_text(sweep, store)
                    : fmt::format("shard {}/{}: {}\nwritten to {}; join the shards with --merge",
                                  shard.number, shard.count, counts_text(store), file));
}

int merge(const SweepArguments& options, const Sweep& sweep) {
  std::vector<path> files;
  const path own = sweep.folder / sweep::Shard{}.file();
  for (const std::string& name : options.merge) {
    if (!std::filesystem::is_directory(name)) {
      throw UsageError("--merge {}: expected the output folders of sweeps", name);
    }
    for (const path& file : sweep::result_files(name)) {
      std::error_code none;
      if (!std::filesystem::equivalent(file, own, none)) files.push_back(file);
    }
  }
  sweep::Store store = sweep.store({});
  if (files.empty() && store.count() == 0) {
    throw UsageError(
        "--merge: the folders contain no results.*.sqlite; give the output folders of the shards");
  }
  for (const path& file : files) store.merge(file);
  const std::int64_t missing = sweep.scenes->sample().size() - store.count();
  if (missing == 0) {
    write_results(options, sweep, store);
    return finish_with_state(options, sweep, store, {}, results_text(sweep, store));
  }
  finish_with_state(options, sweep, store, {}, "");
  print_message(
      fmt::format("{} of {} points are missing in {}; run the remaining shards, and merge "
                  "again",
                  missing, sweep.scenes->sample().size(), own.string()));
  return kFailed;
}

// The shards with points left, except those that are locked because they are running.
std::vector<int> open_shards(const Sweep& sweep, int tasks) {
  std::vector<int> open;
  for (int task = 1; task <= tasks; ++task) {
    const sweep::Shard shard{task, tasks};
    const std::int64_t of = shard.points_of(sweep.scenes->sample().size());
    bool left = of > 0;
    if (left && std::filesystem::exists(sweep.folder / shard.file())) {
      try {
        left = sweep.store(shard).count() < of;
      } catch (const sweep::DatabaseError& error) {
        if (!error.busy) throw;
        left = false;
      }
    }
    if (left) open.push_back(task);
  }
  return open;
}

// The requested number of shards, otherwise as many as in the existing results; at most one per
// point.
int tasks_of(const SweepArguments& options, const Sweep& sweep) {
  constexpr int kDefaultTasks = 16;
  const std::int64_t points = std::max<std::int64_t>(sweep.scenes->sample().size(), 1);
  const int earlier = sweep::shards_in(sweep.folder);
  const int wanted = options.tasks > 0 ? options.tasks : earlier > 0 ? earlier : kDefaultTasks;
  const int tasks = static_cast<int>(std::min<std::int64_t>(wanted, points));
  if (earlier > 0 && earlier != tasks) {
    throw UsageError(
        "--tasks {0}: {1} holds results of {2} shards, and another number of shards would run "
        "their "
        "points again; give --tasks {2}, or another folder with -o",
        tasks, sweep.folder.string(), earlier);
  }
  return tasks;
}

int submit_to_slurm(const SweepArguments& options, const Sweep& sweep) {
  sweep::SlurmJob job;
  job.program = std::filesystem::canonical("/proc/self/exe");
  job.study = std::filesystem::canonical(options.study);
  job.folder = std::filesystem::canonical(sweep.folder);
  job.tasks = tasks_of(options, sweep);
  job.jobs = options.jobs > 0 ? options.jobs : 1;
  job.overrides = overrides_of(options);
  job.allow_library = options.allow_library || !options.controller.empty();
  const path script = job.folder / sweep::kSlurmFile;
  write_whole(script, sweep::slurm_script(job));
  const std::vector<int> open = open_shards(sweep, job.tasks);
  const std::string folder = sweep::shell_word(sweep.folder.string());
  const std::string join = fmt::format("rotorub sweep {} -o {} --merge {}",
                                       sweep::shell_word(options.study), folder, folder);
  result::Section submitted{.parts = {result::Data{"tasks", open}}};
  if (open.empty()) {
    submitted.add(
        {result::Data{"job", nullptr},
         result::line("every shard is done or running; when all are done, join them with\n  " +
                      join)});
  } else {
    const std::string number = sweep::submit(script, open);
    submitted.add(
        {result::Data{"job", number}, result::Data{"script", script.string()},
         result::line(fmt::format(
             "submitted {} as job {}, {} of {} tasks; when it is done, join the shards with\n  {}",
             printable_path(script), number, open.size(), job.tasks, join))});
  }
  return finish(submitted, options);
}

// Prints notes on old words in the scene, as every command does. Notes on the study are printed
// when it is read.
void say_old_words(const Sweep& sweep) {
  try {
    for (const std::string& note : sweep.scenes->at(0).notes) {
      if (!sweep.study.varies(note.substr(0, note.find(':'))))
        fmt::print(stderr, "note: {}: {}\n", printable_path(sweep.study.scene), note);
    }
  } catch (const scene::SceneError&) {  // a refused point has its row in the results
  }
}

int sweep_study(const SweepArguments& options) {
  check_arguments(options);
  Sweep sweep;
  sweep.study = sweep::read_study(options.study);
  const std::string none = options.bifurcation ? sweep::no_bifurcation(sweep.study) : "";
  if (!none.empty()) throw UsageError("--bifurcation: " + none);
  sweep.scenes = std::make_unique<sweep::PointScenes>(sweep.study, overrides_of(options));
  sweep.scenes->check();
  sweep.folder =
      options.folder.empty() ? path("runs") / path(options.study).stem() : path(options.folder);
  check_output_folder(sweep.folder, sweep_files(options, sweep));
  if (!options.quiet) say_old_words(sweep);
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  sweep.jobs = options.jobs > 0 ? options.jobs : std::max(1, processors);
  try {
    sweep::keep_study(sweep.folder, *sweep.scenes);
    if (!options.points.empty()) return keep_points(options, sweep);
    if (!options.merge.empty()) return merge(options, sweep);
    return options.slurm ? submit_to_slurm(options, sweep) : run_points(options, sweep);
  } catch (const sweep::StoreMismatch& error) {
    throw UsageError(error.what());
  }
}

}  // namespace

Command add_sweep_command(CLI::App& program) {
  auto options = std::make_shared<SweepArguments>();
  CLI::App& app = add_command(
      program, "sweep",
      "Run a scene over a grid, a list or random points of its values, and resume a sweep that "
      "was stopped");
  add_option(app, "STUDY", options->study, "Study file (.toml)").required();
  add_value(app, "-o,--output", options->folder, "DIR",
            "Folder of the results (default: runs/<study>)");
  add_value(app, "--jobs", options->jobs, "N",
            "Number of threads (default: one for each processor)")
      .between(1, 4096);
  add_value(app, "--shard", options->shard, "i/n",
            "Run only part i of n, and store it in a separate file");
  add_flag(app, "--slurm", options->slurm,
           "Write and submit an array job for Slurm, with one shard per task");
  add_value(app, "--tasks", options->tasks, "N", "Number of tasks of the array job (default: 16)")
      .between(1, sweep::kMostShards);
  add_value(app, "--merge", options->merge, "DIR...", "Join the shards in these folders");
  add_value(app, "--point", options->points, "N",
            "Run only this point, as `rotorub run` does, and keep the run and its page in "
            "DIR/point-N; may be repeated")
      .repeats()
      .between(0, sweep::kMostPoints);
  const Option diagram = add_flag(
      app, "--bifurcation", options->bifurcation,
      "Also draw a bifurcation diagram, with periods and Lyapunov exponents, over the only key "
      "of the study, upwards and downwards; each run starts where the previous one ended");
  add_flag(app, "--branches", options->branches,
           "Also draw the branches of periodic motions in the bifurcation diagram, stable and "
           "unstable, as `modes --periodic --across` finds them")
      .needs(diagram);
  add_controller_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return sweep_study(*options); }};
}

}  // namespace rotorub
