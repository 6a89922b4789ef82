// The fastest engine at each level of error: what the work-precision table says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"

namespace rotorub::bench {

// The quickest point of an engine among those whose position error is within the level: what the
// ladder holds, nothing between its rungs.
struct Best {
  std::string engine;
  Family family = Family::kNative;
  std::size_t point = 0;  // index
  double seconds = 0.0;   // median
};

struct Level {
  double share = 0.0;         // of the clearance
  double error = 0.0;         // m
  bool judged = true;         // false: nearer to the reference than its own error lets tell
  std::vector<Best> engines;  // by rising time; engines that do not reach the level are left out
};

// Native engine fastest of all, and `rigid` fastest of MuJoCo: true, false, or nothing where none
// of them reaches the level (or, for rigid, no MuJoCo does).
std::optional<bool> native_is_fastest(const Level& level);
std::optional<bool> rigid_is_fastest_mujoco(const Level& level);

// Levels down to 1e-5 of the clearance are engineering; finer ones, which stand in the JSON and on
// the page, are no part of a headline.
inline constexpr double kHeadlineShare = 1e-5;
bool in_headline(const Level& level);

// A sentence on both, with the levels of the headline where it is not so.
std::string verdict_text(const std::vector<Level>& levels);

// Shares 1e-2, 1e-3, ..., 1e-8. Points that were not timed are left out.
std::vector<Level> levels(const std::vector<Point>& points, const std::vector<BenchEngine>& engines,
                          double clearance, double reference_error);

}  // namespace rotorub::bench
