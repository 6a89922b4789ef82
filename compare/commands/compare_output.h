// The files that `rotorub compare` writes: series, films, compare.json and report.html.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/hdf5/module.h"
#include "compare/report/page.h"
#include "compare/result/result.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// All files that a comparison of the scene may write to the folder, as names within it.
std::vector<std::string> compare_files(const std::filesystem::path& folder,
                                       const scene::Scene& scene, bool own_machine);

// Writes <folder>/<scene>/<run>/ for each run, its shadow, and in replay native-<contact> for the
// native run under the commands of each contact model but the first: series and summary, with rows
// at the scene's output times. hdf5: as in write_run.
void write_runs(const std::filesystem::path& folder, const SceneComparison& comparison,
                hdf5::ImageOf hdf5);

// compare.json, columns.json and report.html. result: comparisons_result.
void write_report(const std::filesystem::path& folder, const result::Section& result,
                  const std::vector<PageScene>& pages, const Beside& beside = {});

// The films of a comparison.
struct SceneFilms {
  std::vector<Film> films;  // the films that were made
  std::string failure;      // message of the first film that could not be made; empty: none
};

// Writes <folder>/<scene>/<run>.mp4, each completely or not at all, with one camera, clock and
// scale: for each comparison MuJoCo alone beside the native run, or with `every` all runs,
// including the native one by itself. An interrupt ends it. progress: fraction done.
std::vector<SceneFilms> write_films(const std::filesystem::path& folder,
                                    const std::vector<SceneComparison>& comparisons, bool every,
                                    const std::atomic<bool>& interrupt,
                                    const std::function<void(double)>& progress);

}  // namespace rotorub
