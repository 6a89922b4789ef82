// Statistics of a study's results for each group of points and each figure: mean, deviation and
// quantiles of numbers, and shares of words.
#pragma once

#include <string>
#include <vector>

#include "compare/sweep/order_statistics.h"
#include "compare/sweep/store.h"
#include "native_model/trajectory/columns.h"

namespace rotorub::sweep {

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
