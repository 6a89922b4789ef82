// The points of one engine and setting, which differ in step or tolerance alone.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "compare/bench/point.h"

namespace rotorub::bench {

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

}  // namespace rotorub::bench
