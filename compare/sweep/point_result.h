// What a sweep keeps of a point: one row of the results.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>

#include "compare/metrics/attractor.h"
#include "compare/sweep/study_file.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::sweep {

// Figures of a run that went to its end. An ensemble keeps no balance of the energy.
struct Figures {
  double end = 0.0;  // s
  std::int64_t steps = 0;
  std::optional<double> first_touch;      // s; nothing: never
  std::int64_t impacts = 0;               // counted ones
  double contact_fraction = 0.0;          // of the time from first touch
  double mean_force = 0.0;                // N, over the time from first touch
  double peak_force = 0.0;                // N, largest impulse of a step / step
  double impulse_total = 0.0;             // N s
  Settled settled;                        // over the last fifth
  std::optional<double> peak_impulse;     // N s, largest of one impact
  std::optional<double> friction_work;    // J, <= 0
  std::optional<double> max_penetration;  // m
  std::optional<double> energy_residual;  // 1; single runs
};

struct PointResult {
  std::int64_t point = 0;          // index in the study's order
  std::string status = "ok";       // as of a run, or "refused": no scene, or one that cannot run
  std::string reason;              // empty: ok
  std::optional<Figures> figures;  // nothing: not ok

  bool ok() const { return figures.has_value(); }
};

inline constexpr const char* kRefused = "refused";

// The columns of the results behind the point, the varied keys, status and reason.
struct ResultColumn {
  enum class Type { kNumber, kWhole, kWord };
  const char* name;
  Type type;
  const char* unit;                                           // SI; "": none
  const char* meaning;                                        // one sentence
  std::optional<double> (*number)(const Figures&) = nullptr;  // kNumber, kWhole
  const char* (*word)(const Figures&) = nullptr;              // kWord
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
