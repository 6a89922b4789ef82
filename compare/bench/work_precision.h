// Evaluation of the points of a bench: series of one engine and setting, and the fastest engine at
// each level of error.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/bench/engines.h"
#include "compare/bench/point.h"

namespace rotorub::bench {

// The points of one engine and setting, which differ only in step or tolerance.
struct Series {
  std::string engine, setting;  // the tolerances of `event` form one series without a setting
  std::vector<std::size_t> points;
  std::optional<double> order;      // error ~ step^order
  std::optional<std::size_t> best;  // index of the point with the smallest error
  double us_per_step = 0.0;         // of the finest timed point; 0: none
  std::map<Outcome, int> outcomes;
  std::string reason;  // of the first point that is not ok
};

// Errors that are significant for an order, m: above the reference's accuracy and below useless
// results.
struct ErrorRange {
  double floor = 0.0, ceiling = 0.0;
};

// In the order of their first points.
std::vector<Series> series_of(const std::vector<Point>& points, const ErrorRange& range);

// Order of error ~ step^order by least squares on the logarithms; steps and errors > 0. Empty with
// fewer than three points.
std::optional<double> fitted_order(const std::vector<double>& steps,
                                   const std::vector<double>& errors);

// "10 µs", "tolerance 1e-8", "implicit, 10 µs".
std::string setting_text(const Setting& setting);
// "7 ok, 1 chatter".
std::string outcomes_text(const Series& series);

// The fastest point of an engine among those whose position error is within the level, without
// interpolation between the rungs of the ladder.
struct Best {
  std::string engine;
  Family family = Family::kNative;
  std::size_t point = 0;  // index
  double seconds = 0.0;   // median
};

struct Level {
  double share = 0.0;         // of the clearance
  double error = 0.0;         // m
  bool judged = true;         // false: closer to the reference than its accuracy
  std::vector<Best> engines;  // by rising time, without engines that do not reach the level
};

// Whether a native engine is the fastest of all, and whether `rigid` is the fastest engine of
// MuJoCo. Empty if no engine (or, for rigid, no MuJoCo engine) reaches the level.
std::optional<bool> native_is_fastest(const Level& level);
std::optional<bool> rigid_is_fastest_mujoco(const Level& level);

// Levels down to 1e-5 of the clearance are relevant in engineering. Finer levels are in the JSON
// and on the page, but not in a headline.
inline constexpr double kHeadlineShare = 1e-5;
bool in_headline(const Level& level);

// A sentence on both questions, naming the levels of the headline where the answer is no.
std::string verdict_text(const std::vector<Level>& levels);

// Levels 1e-2, 1e-3, ..., 1e-8 of the clearance. Points that were not timed are left out.
std::vector<Level> levels(const std::vector<Point>& points, const std::vector<BenchEngine>& engines,
                          double clearance, double reference_error);

}  // namespace rotorub::bench
