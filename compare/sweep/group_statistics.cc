#include "compare/sweep/group_statistics.h"

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/policies/policy.hpp>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>

#include "compare/base/columns.h"
#include "compare/sweep/folder.h"
#include "native_model/trajectory/output.h"

namespace rotorub::sweep {
namespace {

// Computes in double, as in distribution.cc.
using InDouble = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Binomial = boost::math::binomial_distribution<double, InDouble>;

// The smallest k in [0, n] with P(B <= k) >= share, for B binomial(n, p). Boost's quantile rounds
// by a policy, and round-off decides at the edge; here P itself decides.
std::size_t least_at_share(std::size_t n, double p, double share) {
  const Binomial law(static_cast<double>(n), p);
  std::size_t below = 0, at = n;
  while (below < at) {
    const std::size_t middle = below + (at - below) / 2;
    if (cdf(law, static_cast<double>(middle)) >= share) {
      at = middle;
    } else {
      below = middle + 1;
    }
  }
  return at;
}

// The standard deviation with divisor n - 1; 0 for one value.
double deviation_of(std::span<const double> values) {
  if (values.size() < 2) return 0.0;
  const auto n = static_cast<double>(values.size());
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / n;
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / (n - 1.0));
}

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

Estimate quantile_of(std::span<const double> sorted, double p, double confidence) {
  assert(!sorted.empty() && p > 0.0 && p < 1.0);
  const std::size_t n = sorted.size();
  const double tail = 0.5 * (1.0 - confidence);
  const double place = static_cast<double>(n - 1) * p;
  const auto below = static_cast<std::size_t>(std::floor(place));
  const double share = place - std::floor(place);
  Estimate out;
  out.value = sorted[below];
  if (share > 0.0) out.value += share * (sorted[below + 1] - sorted[below]);

  // Indices from 0: x_(l) is sorted[l - 1]. l is the number of k with P(B <= k) <= tail.
  const Binomial law(static_cast<double>(n), p);
  std::size_t l = least_at_share(n, p, tail);
  if (cdf(law, static_cast<double>(l)) <= tail) ++l;
  if (l >= 1) out.low = sorted[l - 1];
  const std::size_t u = least_at_share(n, p, 1.0 - tail);
  if (u < n) out.high = sorted[u];
  return out;
}

Estimate mean_of(std::span<const double> values, double confidence) {
  assert(!values.empty());
  const auto n = static_cast<double>(values.size());
  Estimate out;
  out.value = std::accumulate(values.begin(), values.end(), 0.0) / n;
  if (values.size() < 2) return out;
  const boost::math::students_t_distribution<double, InDouble> law(n - 1.0);
  const double half = quantile(law, 0.5 * (1.0 + confidence)) * deviation_of(values) / std::sqrt(n);
  out.low = out.value - half;
  out.high = out.value + half;
  return out;
}

Estimate share_of(std::size_t hits, std::size_t count, double confidence) {
  assert(count >= 1 && hits <= count);
  const auto n = static_cast<double>(count), k = static_cast<double>(hits);
  const double tail = 0.5 * (1.0 - confidence);
  return {k / n, hits == 0 ? 0.0 : Binomial::find_lower_bound_on_p(n, k, tail),
          hits == count ? 1.0 : Binomial::find_upper_bound_on_p(n, k, tail)};
}

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
