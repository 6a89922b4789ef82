// What `rotorub compare` leaves behind: series, compare.json and report.html in a folder.
#pragma once

#include <filesystem>
#include <vector>

#include "compare/hdf5/module.h"
#include "compare/report/page.h"
#include "compare/study/scene_comparison.h"

namespace rotorub {

// <folder>/<scene>/<run>/ for each run, its shadow, and in replay native-<contact> under the
// commands of each contact model but the first: series and summary, rows at the scene's output
// times. hdf5: as for write_run.
void write_runs(const std::filesystem::path& folder, const SceneComparison& comparison,
                hdf5::ImageOf hdf5);

// compare.json, columns.json and report.html.
void write_report(const std::filesystem::path& folder,
                  const std::vector<SceneComparison>& comparisons,
                  const std::vector<PageScene>& pages, const Beside& beside = {});

}  // namespace rotorub
