// A [[vary]] of a study: a key of the scene and its values.
#pragma once

#include <string>
#include <vector>

#include "compare/sweep/points_file.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// path: for error messages, "vary[1]". points: the points of a list in a file, otherwise empty.
// Errors are added to the diagnostics.
Vary read_vary(const scene::TomlNode& node, const std::string& path, SampleKind kind,
               const PointsFile& points, std::vector<scene::Diagnostic>& diagnostics);

}  // namespace rotorub::sweep
