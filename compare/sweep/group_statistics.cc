#include "compare/sweep/group_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <nlohmann/json.hpp>

#include "compare/base/columns.h"
#include "compare/sweep/folder.h"
#include "native_model/trajectory/output.h"

namespace rotorub::sweep {
namespace {

// The values of one figure in one group.
struct Gathered {
  std::vector<double> numbers;
  std::map<std::string, std::size_t> words;
  std::size_t count = 0;
};

struct FigureGroup {
  std::vector<std::string> values;
  std::vector<Gathered> figures;  // in the order of Statistics::figures
};

std::string text_of(const Statement& row, int column) {
  return row.is_text(column) ? row.text(column) : fmt::format("{}", row.number(column));
}

std::vector<FigureGroup> groups_of(Store& store, const Statistics& asked) {
  const std::vector<std::string> names = store.names();
  std::vector<int> columns;
  for (const std::string& figure : asked.figures)
    columns.push_back(
        static_cast<int>(std::find(names.begin(), names.end(), figure) - names.begin()));
  std::vector<FigureGroup> groups;
  std::map<std::vector<std::string>, std::size_t> places;
  store.each([&](const Statement& row) {
    std::vector<std::string> values;
    for (const std::size_t k : asked.by) values.push_back(text_of(row, static_cast<int>(k) + 1));
    const auto [place, is_new] = places.try_emplace(values, groups.size());
    if (is_new) groups.push_back({values, std::vector<Gathered>(columns.size())});
    for (std::size_t f = 0; f < columns.size(); ++f) {
      if (row.is_nothing(columns[f])) continue;
      Gathered& to = groups[place->second].figures[f];
      ++to.count;
      if (row.is_text(columns[f])) {
        ++to.words[row.text(columns[f])];
      } else {
        to.numbers.push_back(row.number(columns[f]));
      }
    }
  });
  return groups;
}

std::string unit_of(const std::string& figure) {
  for (const ResultColumn& column : result_columns())
    if (column.name == figure) return std::string(column.unit);
  return {};
}

// Calls `add` with every statistic of one figure in one group.
template <typename Add>
void each_statistic(Gathered& of, const Statistics& asked, const Add& add) {
  for (const auto& [word, hits] : of.words)
    add("share " + word, share_of(hits, of.count, asked.confidence));
  if (of.numbers.empty()) return;
  std::sort(of.numbers.begin(), of.numbers.end());
  add("mean", mean_of(of.numbers, asked.confidence));
  add("deviation", Estimate{deviation_of(of.numbers), {}, {}});
  add("least", Estimate{of.numbers.front(), {}, {}});
  for (const double p : asked.quantiles)
    add(fmt::format("quantile {}", p), quantile_of(of.numbers, p, asked.confidence));
  add("largest", Estimate{of.numbers.back(), {}, {}});
}

}  // namespace

std::vector<StatisticsRow> group_statistics(Store& store, const Study& study) {
  assert(study.statistics);
  const Statistics& asked = *study.statistics;
  const bool independent =
      study.kind != SampleKind::kLatinHypercube && study.kind != SampleKind::kSobol;
  std::vector<StatisticsRow> rows;
  for (FigureGroup& group : groups_of(store, asked)) {
    for (std::size_t f = 0; f < asked.figures.size(); ++f) {
      Gathered& of = group.figures[f];
      each_statistic(of, asked, [&](std::string name, Estimate estimate) {
        if (!independent) estimate.low = estimate.high = std::nullopt;
        rows.push_back({group.values, asked.figures[f], unit_of(asked.figures[f]), std::move(name),
                        estimate, of.count});
      });
    }
  }
  return rows;
}

void write_statistics(const std::vector<StatisticsRow>& rows, const Study& study,
                      const std::filesystem::path& file) {
  std::string text;
  for (const std::size_t k : study.statistics->by) text += csv_field(study.vary[k].key) + ",";
  text += "figure,statistic,value,low,high,count\n";
  const auto number = [](const std::optional<double>& x) {
    std::string digits;
    if (x) append_number(digits, *x);
    return digits;
  };
  for (const StatisticsRow& row : rows) {
    for (const std::string& value : row.group) text += csv_field(value) + ",";
    text += fmt::format("{},{},{},{},{},{}\n", row.figure, csv_field(row.statistic),
                        number(row.estimate.value), number(row.estimate.low),
                        number(row.estimate.high), row.count);
  }
  write_whole(file, text);
}

nlohmann::ordered_json statistics_columns_json(const Study& study) {
  auto all = nlohmann::ordered_json::array();
  for (const std::size_t k : study.statistics->by)
    all.push_back(
        column_json(study.vary[k].key, study.vary[k].unit, "value of the group's points"));
  constexpr ColumnMeaning kColumns[] = {
      {"figure", "", "column of results.csv, whose unit it has", ""},
      {"statistic", "", "mean, deviation, least, quantile p, largest; of words share WORD", ""},
      {"value", "", "of the points of the group that have the figure", ""},
      {"low", "", "bound below, with the confidence of the study; empty: there is none", ""},
      {"high", "", "bound above", ""},
      {"count", "", "number of points of the group that have the figure", ""}};
  for (const ColumnMeaning& c : kColumns) all.push_back(column_json(c.name, c.unit, c.meaning));
  return all;
}

}  // namespace rotorub::sweep
