#include "compare/sweep/point_result.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/figures/figure.h"

namespace rotorub::sweep {
namespace {

using nlohmann::json;

// The metrics that a sweep stores, in the order of its columns.
constexpr const char* kKept[] = {"end",
                                 "steps",
                                 "first_touch",
                                 "impacts",
                                 "contact_fraction",
                                 "mean_force",
                                 "peak_force",
                                 "impulse_total",
                                 "settled.attractor",
                                 "settled.contact_share",
                                 "settled.whirl_frequency",
                                 "settled.spin_speed",
                                 "peak_impulse",
                                 "friction_work",
                                 "max_penetration",
                                 "energy_residual",
                                 "forward_passes",
                                 "backward_passes",
                                 "whirl_time",
                                 "hard_impacts",
                                 "lasting_fraction"};

constexpr ColumnMeaning kPoint{"point", "", "number of the point in the study's order, from 0", ""};
constexpr std::string_view kVaried = "value of the varied key";
constexpr ColumnMeaning kOutcome[] = {
    {"status", "", "status of the run, or refused: the values make no valid scene", ""},
    {"reason", "", "why the status is not ok; the figures are then empty", ""},
};

}  // namespace

std::span<const ResultColumn> result_columns() {
  static const std::vector<ResultColumn> columns = [] {
    std::vector<ResultColumn> all;
    for (const std::string_view key : kKept) {
      const ColumnMeaning& metric = metric_key(key);
      all.push_back({{key.substr(key.rfind('.') + 1), metric.unit, metric.meaning, ""}, key});
    }
    return all;
  }();
  return columns;
}

json ResultColumn::value(const Metrics& metrics) const { return metric_value(metrics, key); }

std::vector<ColumnMeaning> csv_columns(const Study& study) {
  std::vector<ColumnMeaning> all{kPoint};
  for (const Vary& vary : study.vary) all.push_back({vary.key, vary.unit, kVaried, ""});
  all.insert(all.end(), std::begin(kOutcome), std::end(kOutcome));
  all.insert(all.end(), result_columns().begin(), result_columns().end());
  return all;
}

}  // namespace rotorub::sweep
