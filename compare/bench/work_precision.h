// What the points of a bench say: series of one engine and setting, and the fastest engine at each
// level of error.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"

namespace rotorub::bench {

// The points of one engine and setting, which differ in step or tolerance alone.
struct Series {
  std::string engine, setting;  // the tolerances of `event` are one series without a setting
  std::vector<std::size_t> points;
  std::optional<double> order;      // error ~ step^order
  std::optional<std::size_t> best;  // the point with the least error
  double us_per_step = 0.0;         // of the finest point that was timed; 0: none
  std::map<Outcome, int> outcomes;
  std::string reason;  // of the first point that is not ok
};

// Errors that tell an order, m: above what the reference's own hides, below what is no result.
struct ErrorRange {
  double floor = 0.0, ceiling = 0.0;
};

// In the order in which they first occur.
std::vector<Series> series_of(const std::vector<Point>& points, const ErrorRange& range);

// Order of error ~ step^order by least squares through the logarithms; steps and errors > 0. None
// for fewer than three points.
std::optional<double> fitted_order(const std::vector<double>& steps,
                                   const std::vector<double>& errors);

// "10 µs", "tolerance 1e-8", "implicit, 10 µs".
std::string setting_text(const Setting& setting);
// "7 ok, 1 chatter".
std::string outcomes_text(const Series& series);

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
