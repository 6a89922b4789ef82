#include "compare/commands/sweep_output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/base/columns.h"
#include "compare/commands/terminal.h"
#include "compare/report/page.h"
#include "compare/result/result.h"
#include "compare/run_files/run_directory.h"
#include "compare/run_files/summary.h"
#include "compare/sweep/bifurcation.h"
#include "compare/sweep/group_statistics.h"
#include "compare/sweep/motion_branches.h"
#include "compare/sweep/page_data.h"
#include "compare/sweep/point_result.h"
#include "compare/sweep/point_run.h"
#include "native_model/trajectory/output.h"

namespace rotorub {
namespace {

using std::filesystem::path;

// With --bifurcation: computes the diagram and saves it beside the page; otherwise returns the
// saved one, or null.
nlohmann::json bifurcation_of(const SweepArguments& options, const Sweep& sweep) {
  const path file = sweep.folder / sweep::kBifurcationFile;
  if (!options.bifurcation) {
    if (!std::filesystem::exists(file)) return nullptr;
    nlohmann::json data = nlohmann::json::parse(std::ifstream(file), nullptr, false);
    return data.is_object() ? data : nullptr;
  }
  ProgressBar bar(options.quiet);
  const auto diagram = sweep::bifurcation(
      *sweep.scenes, &interrupted(), [&](double share) { bar.show(share, "bifurcation diagram"); });
  bar.clear();
  if (!diagram) throw Interrupted();
  std::optional<sweep::MotionBranches> branches;
  if (options.branches) {
    ProgressBar search(options.quiet);
    branches = sweep::motion_branches(*sweep.scenes, &interrupted(), [&](double share) {
      search.show(share, "branches of periodic motions");
    });
    search.clear();
    if (interrupted()) throw Interrupted();
  }
  nlohmann::json data = bifurcation_data(sweep.study, sweep.scenes->sample(), *diagram, branches);
  write_whole(file, data.dump());
  return data;
}

std::string point_folder(std::int64_t point) { return fmt::format("point-{}", point); }

// The runs of points for the page (page_data).
nlohmann::json point_runs(const SweepArguments& options, const Sweep& sweep) {
  std::string command = fmt::format("rotorub sweep {} -o {}", sweep::shell_word(options.study),
                                    sweep::shell_word(sweep.folder.string()));
  if (options.allow_library || !options.controller.empty()) command += " --allow-library";
  for (const std::string& text : overrides_of(options))
    command += " --set " + sweep::shell_word(text);
  nlohmann::json kept = nlohmann::json::object();
  for (const auto& entry : std::filesystem::directory_iterator(sweep.folder)) {
    const std::string name = entry.path().filename().string();
    std::int64_t point = 0;
    if (std::sscanf(name.c_str(), "point-%" SCNd64, &point) == 1 &&
        std::filesystem::exists(entry.path() / kRunPage))
      kept[std::to_string(point)] = name + "/" + kRunPage;
  }
  return {{"command", command}, {"kept", kept}, {"points", sweep.scenes->sample().size()}};
}

}  // namespace

std::vector<std::string> sweep_files(const SweepArguments& options, const Sweep& sweep) {
  std::vector<std::string> files{sweep::kStudyFile, sweep::kSceneFile};
  if (!sweep.study.points.empty()) files.emplace_back(sweep::kPointsFile);
  if (options.slurm) files.emplace_back(sweep::kSlurmFile);
  if (!options.shard.empty()) files.push_back(sweep::parse_shard(options.shard).file());
  for (const std::int64_t point : options.points) {
    const std::string folder = point_folder(point);
    for (std::string& file : run_files(sweep.folder, folder)) files.push_back(std::move(file));
    files.push_back(folder + "/" + kRunPage);
  }
  if (options.slurm || !options.shard.empty()) return files;
  files.insert(files.end(), {sweep::Shard{}.file(), sweep::kCsvFile, kColumnsFile, sweep::kDataFile,
                             sweep::kPageFile});
  if (sweep.study.statistics) files.emplace_back(sweep::kStatisticsFile);
  if (options.bifurcation) files.emplace_back(sweep::kBifurcationFile);
  return files;
}

void write_results(const SweepArguments& options, const Sweep& sweep, sweep::Store& store) {
  sweep::write_csv(store, sweep.folder / sweep::kCsvFile);
  const nlohmann::json kept = sweep_json(*sweep.scenes, store, sweep.study);
  write_whole(sweep.folder / sweep::kDataFile, kept.dump());
  nlohmann::ordered_json columns{{sweep::kCsvFile, columns_json(sweep::csv_columns(sweep.study))}};
  if (sweep.study.statistics) {
    columns[sweep::kStatisticsFile] = columns_json(sweep::statistics_columns(sweep.study));
    sweep::write_statistics(sweep::group_statistics(store, sweep.study), sweep.study,
                            sweep.folder / sweep::kStatisticsFile);
  }
  write_whole(sweep.folder / kColumnsFile, columns_text(columns));
  result::Section answer;
  for (const std::string sentence : kept.at("answer")) answer.add({result::Sentence{sentence}});
  const nlohmann::json data =
      sweep::page_data(*sweep.scenes, store, sweep.study, kept, point_runs(options, sweep),
                       bifurcation_of(options, sweep));
  write_whole(sweep.folder / sweep::kPageFile, page_of("sweep", kept.at("name"), answer, data));
}

// rotorub sweep STUDY.toml -o DIR --point N: saves the run of the point as `rotorub run` does, with
// its page.
int keep_points(const SweepArguments& options, const Sweep& sweep) {
  const std::int64_t last = sweep.scenes->sample().size() - 1;
  for (const std::int64_t point : options.points) {
    if (point > last) throw UsageError("--point {}: expected 0 to {}", point, last);
  }
  int code = kDone;
  result::Section all;
  for (const std::int64_t point : options.points) {
    const std::string name = point_folder(point);
    StoredRun kept{sweep.scenes->whole_at(point), {}, {}};
    kept.trajectory = run_shown(*sweep::engine_of(sweep.study, kept.scene), kept.scene, name,
                                options.quiet || options.json);
    const path folder = sweep.folder / name;
    kept.summary = summary_json(kept.scene, kept.trajectory);
    write_run(folder, kept.scene, kept.trajectory, kept.summary);
    write_whole(folder / kRunPage, run_page(kept, std::nullopt));
    const std::string status = to_string(kept.trajectory.status);
    const result::Section made{
        "points/#",
        {result::Data{"", {{"point", point}, {"status", status}, {"folder", folder.string()}}},
         result::line(fmt::format("point {}: {}\nwritten to {} ({})", point, status,
                                  printable_path(folder), kRunPage))}};
    say(options, result::text_of(made));
    all.add({made});
    say_failure(kept.scene, name + ": ", kept.trajectory);
    code = std::max(code, exit_code_of(kept.trajectory.status));
  }
  if (options.json) finish(all, options);
  // Update the page, so that it links to the saved runs.
  if (std::filesystem::exists(sweep.folder / sweep::kPageFile)) {
    sweep::Store store = sweep.store({});
    if (store.count() == last + 1) write_results(options, sweep, store);
  }
  return code;
}

}  // namespace rotorub
