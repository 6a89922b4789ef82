// What `rotorub compare` leaves behind in a folder: series, films, compare.json and report.html.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/hdf5/module.h"
#include "compare/report/page.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// All that a comparison of the scene may leave in the folder, as names within it.
std::vector<std::string> compare_files(const std::filesystem::path& folder,
                                       const scene::Scene& scene, bool own_machine);

// <folder>/<scene>/<run>/ for each run, its shadow, and in replay native-<contact> under the
// commands of each contact model but the first: series and summary, rows at the scene's output
// times. hdf5: as for write_run.
void write_runs(const std::filesystem::path& folder, const SceneComparison& comparison,
                hdf5::ImageOf hdf5);

// compare.json, columns.json and report.html.
void write_report(const std::filesystem::path& folder,
                  const std::vector<SceneComparison>& comparisons,
                  const std::vector<PageScene>& pages, const Beside& beside = {});

// Of a comparison.
struct SceneFilms {
  std::vector<Film> films;  // runs that did not end well have none
  std::string failure;      // of the first film that could not be made; empty: none
};

// <folder>/<scene>/<run>.mp4, each whole or not at all: of every comparison MuJoCo alone beside the
// native run, with one camera, clock and scale; `every`: of each run, the native one by itself. An
// interrupt ends them. progress: share done.
std::vector<SceneFilms> write_films(const std::filesystem::path& folder,
                                    const std::vector<SceneComparison>& comparisons, bool every,
                                    const std::atomic<bool>& interrupt,
                                    const std::function<void(double)>& progress);

}  // namespace rotorub
