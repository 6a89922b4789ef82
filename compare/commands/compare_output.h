// What `rotorub compare` leaves behind: series, films, compare.json and report.html in a folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "compare/report/page.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// <folder>/<scene>/<run>/ for each run: series and summary, rows at the scene's output times.
void write_runs(const std::filesystem::path& folder, const SceneComparison& comparison);

// Films of every run, of one framing, MuJoCo's with the native one as a ghost; all of them in
// <folder>/<scene>/. progress: share done; what it throws ends the filming.
std::vector<Film> write_films(const std::filesystem::path& folder,
                              const SceneComparison& comparison,
                              const std::function<void(double)>& progress);

// compare.json and report.html.
void write_report(const std::filesystem::path& folder,
                  const std::vector<SceneComparison>& comparisons,
                  const std::vector<PageScene>& pages);

}  // namespace rotorub
