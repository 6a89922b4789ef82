// A [[vary]] of a study: a key of the scene and its values; and the file with the points of a list.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "compare/base/table_text.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// The points of a study in a file: a column per name and one line per point. A header field may
// include a unit, as in "clearance [um]", for the numbers of its column.
struct PointsFile {
  std::filesystem::path file;
  std::string text;
  std::vector<std::string> names, units;  // of the columns; a unit may be empty
  std::vector<Fields> points;
  std::vector<int> lines;  // line number of each point in the file
};
// Throws scene::SceneError.
PointsFile read_points(const std::filesystem::path& file);

// path: for error messages, "vary[1]". points: the points of a list in a file, otherwise empty.
// Errors are added to the diagnostics.
Vary read_vary(scene::TomlNode& node, const std::string& path, SampleKind kind,
               const PointsFile& points, std::vector<scene::Diagnostic>& diagnostics);

}  // namespace rotorub::sweep
