// The result of a point in a sweep: one row of the results.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "compare/metrics/metrics.h"
#include "compare/sweep/study_file.h"
#include "native_model/trajectory/columns.h"

namespace rotorub::sweep {

struct PointResult {
  std::int64_t point = 0;  // index in the study's order
  // The status of the run, or "refused" for a point without a scene that can run.
  std::string status = "ok";
  std::string reason;  // empty if ok
  // Empty unless ok; only the metrics of result_columns() are needed.
  std::optional<Metrics> figures;

  bool ok() const { return figures.has_value(); }
};

inline constexpr const char* kRefused = "refused";

// The columns of the results after the point, the varied keys, status and reason: metrics from the
// registry (compare/figures).
struct ResultColumn : ColumnMeaning {
  std::string_view key;
  // A column always has the same type: whole number, word or number. If there is no value, it is
  // null or a number that is not finite.
  nlohmann::json value(const Metrics& metrics) const;
};
std::span<const ResultColumn> result_columns();

// The columns of results.csv for columns.json: {"results.csv": [{"name", "unit", "meaning"}, ...]},
// including the columns of the study, in their order.
nlohmann::ordered_json sweep_columns_json(const Study& study);

}  // namespace rotorub::sweep
