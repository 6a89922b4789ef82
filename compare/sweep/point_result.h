// What a sweep keeps of a point: one row of the results.
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
  std::int64_t point = 0;     // index in the study's order
  std::string status = "ok";  // as of a run, or "refused": no scene, or one that cannot run
  std::string reason;         // empty: ok
  // Nothing: not ok. Of them what result_columns() reads.
  std::optional<Metrics> figures;

  bool ok() const { return figures.has_value(); }
};

inline constexpr const char* kRefused = "refused";

// The columns of the results behind the point, the varied keys, status and reason: metrics of the
// registry (compare/figures).
struct ResultColumn : ColumnMeaning {
  std::string_view key;
  // Of one type, whatever the metrics: whole number, word, or else number; null or not finite:
  // none.
  nlohmann::json value(const Metrics& metrics) const;
};
std::span<const ResultColumn> result_columns();

// Rows that tell where a run has settled, evenly spaced over its last fifth, both ends included.
inline constexpr int kSettledRows = 41;
double settled_row(double end, int row);  // s, of row 0 .. kSettledRows - 1

// What the columns of results.csv are, in columns.json beside it:
// {"results.csv": [{"name", "unit", "meaning"}, ...]}, the study's own columns in their order.
nlohmann::ordered_json sweep_columns_json(const Study& study);

// Markdown: the table of all of them in compare/sweep/README.md.
std::string sweep_columns_markdown();

}  // namespace rotorub::sweep
