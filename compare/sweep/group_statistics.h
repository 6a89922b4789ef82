// Statistics of a study's results: of each group of points and each figure, of numbers the mean,
// the spread and quantiles, of words the share of each.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "compare/sweep/order_statistics.h"
#include "compare/sweep/store.h"

namespace rotorub::sweep {

struct StatisticsRow {
  std::vector<std::string> group;  // value of each key of Statistics::by, SI
  std::string figure, unit;        // column of the results; SI
  std::string statistic;           // mean, deviation, least, largest, quantile <p>, or share <word>
  Estimate estimate;
  std::size_t count = 0;  // points of the group that have the figure
};

// Groups in the order in which their first points come; asserts [statistics]. Bounds presuppose
// independent points: those of a Latin hypercube and of Sobol's sequence are not, and have none.
std::vector<StatisticsRow> group_statistics(Store& store, const Study& study);

// A header line and a line a row, whole or not at all.
void write_statistics(const std::vector<StatisticsRow>& rows, const Study& study,
                      const std::filesystem::path& file);

// Its columns, as of columns.json.
nlohmann::ordered_json statistics_columns_json(const Study& study);

}  // namespace rotorub::sweep
