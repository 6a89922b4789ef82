// A [[vary]] of a study: a key of the scene and the values that it gets.
#pragma once

#include <string>
#include <vector>

#include "compare/sweep/points_file.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// `path`: for diagnostics, "vary[1]". `points`: of a list that has them in a file, else empty. What
// is wrong goes to the diagnostics.
Vary read_vary(const scene::TomlNode& node, const std::string& path, SampleKind kind,
               const PointsFile& points, std::vector<scene::Diagnostic>& diagnostics);

}  // namespace rotorub::sweep
