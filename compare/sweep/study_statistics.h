// The table [statistics] of a study, which requests statistics of groups of its points.
#pragma once

#include <string>
#include <vector>

#include "native_model/scene/toml_source.h"

namespace rotorub::sweep {

struct Study;

struct Statistics {
  std::vector<std::string> figures{"status", "attractor",
                                   "peak_impulse"};  // columns of the results
  std::vector<std::size_t> by;  // indices in Study::vary; a group has one value of each
  std::vector<double> quantiles{0.05, 0.5, 0.95};  // in (0, 1)
  double confidence = 0.95;                        // of the bounds, in (0, 1)
};

// Call it after the study's varied keys were read. Errors are added to the diagnostics.
Statistics read_statistics(const scene::TomlNode& node, const Study& study,
                           std::vector<scene::Diagnostic>& diagnostics);

}  // namespace rotorub::sweep
