#include "compare/sweep/group_statistics.h"

#include <fmt/format.h>

#include <cassert>
#include <map>

#include "compare/base/columns.h"
#include "compare/sweep/folder.h"
#include "native_model/trajectory/output.h"

namespace rotorub::sweep {
namespace {

// The values of one figure in one group.
struct Gathered {
  std::vector<std::string> group;  // the value of each key in Statistics::by
  std::vector<double> numbers;     // ascending
  std::map<std::string, std::size_t> words;
  std::size_t count = 0;
};

std::string text_of(const Statement& row, int column) {
  return row.is_text(column) ? row.text(column) : fmt::format("{}", row.number(column));
}

// By the first point of the group and the figure's place in Statistics::figures.
std::map<std::pair<std::int64_t, std::size_t>, Gathered> gathered(Store& store,
                                                                  const Study& study) {
  const Statistics& asked = *study.statistics;
  std::string keys;
  for (const std::size_t k : asked.by)
    keys += (keys.empty() ? "" : ", ") + quoted_name(study.vary[k].key);
  std::map<std::pair<std::int64_t, std::size_t>, Gathered> all;
  for (std::size_t f = 0; f < asked.figures.size(); ++f) {
    Statement rows = store.select(
        fmt::format("* FROM (SELECT min(point) OVER ({}) AS first, {} AS figure{} FROM points) "
                    "WHERE figure IS NOT NULL ORDER BY first, figure",
                    keys.empty() ? "" : "PARTITION BY " + keys, quoted_name(asked.figures[f]),
                    keys.empty() ? "" : ", " + keys));
    while (rows.step()) {
      Gathered& to = all[{rows.whole(0), f}];
      for (int k = 2; to.count == 0 && k < rows.columns(); ++k)
        to.group.push_back(text_of(rows, k));
      ++to.count;
      if (rows.is_text(1)) {
        ++to.words[rows.text(1)];
      } else {
        to.numbers.push_back(rows.number(1));
      }
    }
  }
  return all;
}

std::string unit_of(const std::string& figure) {
  for (const ResultColumn& column : result_columns())
    if (column.name == figure) return std::string(column.unit);
  return {};
}

// Calls `add` with every statistic of one figure in one group.
template <typename Add>
void each_statistic(const Gathered& of, const Statistics& asked, const Add& add) {
  for (const auto& [word, hits] : of.words)
    add("share " + word, share_of(hits, of.count, asked.confidence));
  if (of.numbers.empty()) return;
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
  for (const auto& [place, of] : gathered(store, study)) {
    const std::string& figure = asked.figures[place.second];
    each_statistic(of, asked, [&](std::string name, Estimate estimate) {
      if (!independent) estimate.low = estimate.high = std::nullopt;
      rows.push_back({of.group, figure, unit_of(figure), std::move(name), estimate, of.count});
    });
  }
  return rows;
}

void write_statistics(const std::vector<StatisticsRow>& rows, const Study& study,
                      const std::filesystem::path& file) {
  std::string text = csv_line(column_names(statistics_columns(study)));
  for (const StatisticsRow& row : rows) {
    std::vector<std::string> line = row.group;
    line.insert(line.end(), {row.figure, row.statistic, csv_number(row.estimate.value),
                             csv_number(row.estimate.low), csv_number(row.estimate.high),
                             std::to_string(row.count)});
    text += csv_line(line);
  }
  write_whole(file, text);
}

std::vector<ColumnMeaning> statistics_columns(const Study& study) {
  std::vector<ColumnMeaning> all;
  for (const std::size_t k : study.statistics->by)
    all.push_back({study.vary[k].key, study.vary[k].unit, "value of the group's points", ""});
  all.insert(
      all.end(),
      {{"figure", "", "column of results.csv, whose unit it has", ""},
       {"statistic", "", "mean, deviation, least, quantile p, largest; of words share WORD", ""},
       {"value", "", "of the points of the group that have the figure", ""},
       {"low", "", "bound below, with the confidence of the study; empty: there is none", ""},
       {"high", "", "bound above", ""},
       {"count", "", "number of points of the group that have the figure", ""}});
  return all;
}

}  // namespace rotorub::sweep
