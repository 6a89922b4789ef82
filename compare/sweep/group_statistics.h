// Statistics of a study's results for each group of points and each figure: mean, deviation and
// quantiles of numbers, and shares of words.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "compare/sweep/store.h"
#include "native_model/trajectory/columns.h"

namespace rotorub::sweep {

// An estimate from a sample of independent values, and the bounds of its confidence interval; a
// bound is empty if the sample is too small.
struct Estimate {
  double value = 0.0;
  std::optional<double> low, high;
};

// In all functions `confidence` is in (0, 1) and two-sided.

// The p-quantile, p in (0, 1): linear interpolation between the order statistics x_(h), h = (n - 1)
// p + 1 (type 7 of Hyndman and Fan 1996, as in numpy). Its bounds are order statistics and hold for
// any distribution (Conover, Practical Nonparametric Statistics, 3.2). For B binomial(n, p):
//   low x_(l), l the largest with P(B <= l - 1) <= (1 - confidence)/2,
//   high x_(u), u the smallest with P(B <= u - 1) >= 1 - (1 - confidence)/2.
// sorted: ascending, at least one value.
Estimate quantile_of(std::span<const double> sorted, double p, double confidence);

// The mean with the bounds of Student's t, which are exact for normal values and otherwise
// approximate for many values. At least one value; a single value has no bounds.
Estimate mean_of(std::span<const double> values, double confidence);

// The share hits / count with the bounds of Clopper and Pearson (1934), whose confidence is at
// least the requested one. count >= 1, hits in [0, count].
Estimate share_of(std::size_t hits, std::size_t count, double confidence);

struct StatisticsRow {
  std::vector<std::string> group;  // the value of each key in Statistics::by, SI
  std::string figure, unit;        // column of the results, and its SI unit
  std::string statistic;           // mean, deviation, least, largest, quantile <p>, or share <word>
  Estimate estimate;
  std::size_t count = 0;  // number of points in the group that have the figure
};

// The groups are in the order of their first points. Asserts that the study has [statistics].
// Bounds require independent points, so a Latin hypercube and Sobol's sequence have none.
std::vector<StatisticsRow> group_statistics(Store& store, const Study& study);

// Writes a header line and one line per row, completely or not at all.
void write_statistics(const std::vector<StatisticsRow>& rows, const Study& study,
                      const std::filesystem::path& file);

// The columns of that file. The study must outlive them.
std::vector<ColumnMeaning> statistics_columns(const Study& study);

}  // namespace rotorub::sweep
