// rotorub sweep: maps over values of a scene, on this computer or on a cluster.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "compare/base/json.h"
#include "compare/commands/command.h"
#include "compare/commands/options.h"
#include "compare/commands/sweep_output.h"
#include "compare/commands/sweep_progress.h"
#include "compare/commands/terminal.h"
#include "compare/sweep/bifurcation.h"
#include "compare/sweep/sweep_run.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

using std::filesystem::path;

void check_arguments(const SweepArguments& options) {
  const int modes =
      (options.shard.empty() ? 0 : 1) + (options.slurm ? 1 : 0) + (options.merge.empty() ? 0 : 1);
  if (modes > 1) throw UsageError("--shard, --slurm and --merge are three ways; give one of them");
  if (options.bifurcation && (!options.shard.empty() || options.slurm))
    throw UsageError(
        "--bifurcation follows a motion from value to value: not with --shard or --slurm");
  if (!options.points.empty() && (modes > 0 || options.bifurcation))
    throw UsageError(
        "--point runs single points: not with --shard, --slurm, --merge or "
        "--bifurcation");
  if (options.tasks > 0 && !options.slurm) throw UsageError("--tasks belongs to --slurm");
}

void print_json(const Sweep& sweep, sweep::Store& store, const sweep::Shard& shard, bool complete) {
  const auto identity = sweep::identity_of(*sweep.scenes);
  std::cout << json_text({{"study_hash", identity.hash},
                          {"points", identity.points},
                          {"done", store.count()},
                          {"status", store.count_by_status()},
                          {"shard", fmt::format("{}/{}", shard.number, shard.count)},
                          {"complete", complete},
                          {"folder", sweep.folder.string()}});
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
  if (!complete) {
    if (options.json) print_json(sweep, store, shard, false);
    say(options, fmt::format("{} points are stored in {}; run it again to go on", store.count(),
                             (sweep.folder / shard.file()).string()));
    throw Interrupted();
  }
  if (shard.whole()) {
    write_results(options, sweep, store);
  } else {
    say(options,
        fmt::format("shard {}/{}: {} points: {}\nwritten to {}; --merge joins the shards",
                    shard.number, shard.count, store.count(), counts_text(store.count_by_status()),
                    (sweep.folder / shard.file()).string()));
  }
  if (options.json) print_json(sweep, store, shard, true);
  return kDone;
}

int merge(const SweepArguments& options, const Sweep& sweep) {
  std::vector<path> files;
  const path own = sweep.folder / sweep::Shard{}.file();
  for (const std::string& name : options.merge) {
    if (!std::filesystem::is_directory(name)) {
      throw UsageError(fmt::format("--merge {}: accepted are folders of sweeps", name));
    }
    for (const path& file : sweep::result_files(name)) {
      std::error_code none;
      if (!std::filesystem::equivalent(file, own, none)) files.push_back(file);
    }
  }
  sweep::Store store = sweep.store({});
  if (files.empty() && store.count() == 0) {
    throw UsageError("--merge: no results.*.sqlite in the folders given");
  }
  for (const path& file : files) store.merge(file);
  const std::int64_t missing = sweep.scenes->sample().size() - store.count();
  if (missing == 0) write_results(options, sweep, store);
  if (options.json) print_json(sweep, store, {}, missing == 0);
  if (missing == 0) return kDone;
  print_error(
      fmt::format("{} of {} points are missing in {}: run the shards that are not done, and "
                  "merge again",
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
        fmt::format("--tasks {}: {} holds results of {} shards, and other shards would run points "
                    "again; give --tasks {}, or another folder",
                    tasks, sweep.folder.string(), earlier, earlier));
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
  if (open.empty()) {
    if (options.json) std::cout << json_text({{"job", nullptr}, {"tasks", open}});
    say(options, "every shard is done or running; join them:\n  " + join);
    return kDone;
  }
  const std::string number = sweep::submit(script, open);
  if (options.json) {
    std::cout << json_text({{"job", number}, {"tasks", open}, {"script", script.string()}});
  }
  say(options, fmt::format("submitted {} as job {}, {} of {} tasks; when it is done:\n  {}",
                           printable_path(script), number, open.size(), job.tasks, join));
  return kDone;
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
      "Run a scene over a grid, a list or random points of its values; resume where it stopped");
  add_option(app, "STUDY", options->study, "Study file (.toml)").required();
  add_value(app, "-o,--output", options->folder, "DIR",
            "Folder of the results (default: runs/<study>)");
  add_option(app, "--jobs", options->jobs, "Number of threads (default: one for each processor)")
      .between(1, 4096);
  add_value(app, "--shard", options->shard, "i/n", "Run only part i of n, into a file of its own");
  add_flag(app, "--slurm", options->slurm, "Write and submit an array job, each task a shard");
  add_option(app, "--tasks", options->tasks, "Number of tasks of the array job (default: 16)")
      .between(1, sweep::kMostShards);
  add_value(app, "--merge", options->merge, "DIR...", "Join the shards in these folders");
  add_value(app, "--point", options->points, "N",
            "Run only this point, as `rotorub run`, and keep it in DIR/point-N with its page; may "
            "be repeated")
      .repeats()
      .between(0, sweep::kMostPoints);
  add_flag(app, "--bifurcation", options->bifurcation,
           "Also draw a bifurcation diagram over the one key, up and down: each value starts "
           "where the one before it ended; with periods and Lyapunov exponents");
  add_controller_option(app, *options);
  add_common_options(app, *options);
  return {&app, [options] { return sweep_study(*options); }};
}

}  // namespace rotorub
