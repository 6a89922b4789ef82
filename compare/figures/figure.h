// The registry of figures: one entry for each number that describes a run and is compared. The
// tables, the JSON, the pages, `tune` and the split into model gap and step error use it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "compare/metrics/extrapolation.h"
#include "compare/metrics/metrics.h"
#include "native_model/trajectory/columns.h"

namespace rotorub {

// The names and the unit of a figure, for a run, a contact or a record.
struct FigureText {
  const char* key;      // in JSON
  const char* label;    // in tables
  const char* unit;     // of the value as written
  double per_unit;      // written value = SI value * per_unit
  const char* meaning;  // one sentence
};

// A value (SI) in the unit of the figure, as the terminal and the pages show it.
std::string figure_value(const FigureText& figure, double value);
std::string figure_label(const FigureText& figure);         // "mean normal force, N"
std::string_view figure_si_unit(const FigureText& figure);  // in JSON; "": dimensionless

// How the difference of two values is judged and written.
enum class Scale {
  kRelative,  // difference / native value
  kPoints,    // the difference itself, for shares of time
  // As kRelative, for whole numbers; but a difference of one does not decide, and differences of
  // small counts are written as counts (trust.h).
  kCount
};

// Whether the tolerance applies to a figure, and what the figure describes.
enum class Judged {
  kNo,
  kAverage,  // the whole run; bearings and heating depend on it
  kPeak      // single moments, such as impacts
};

// How the values of two runs are compared.
struct ComparisonRule {
  Scale scale;
  Judged judged;
  // SI, unused for points. A difference is relative to the native value, or to the resolution if
  // that is larger.
  double resolution = 0.0;
  bool split = true;       // converges with the step, so it is split into model gap and step error
  bool comparable = true;  // means the same for soft and rigid contacts, so it has a difference
  bool by_step = false;    // depends on impulses within steps, so runs with adaptive steps lack it

  bool is_judged() const { return judged != Judged::kNo; }
};

struct Figure : FigureText, ComparisonRule {
  double (*value)(const Metrics&);  // NaN: the run lacks the figure
};

std::span<const Figure> figures();
// Whether a single run has the figure.
bool has_figure(const Metrics& metrics, const Figure& figure);
// Asserts that the key exists.
const Figure& figure(const std::string& key);

// Difference on the scale of a figure, as a share (0.01: 1 % or 1 point). Relative differences are
// positive if the magnitude grows. 0 for two zeros; infinite if only the native value is 0 and the
// figure has no resolution.
double deviation(const Figure& figure, double native, double other);
// A size or a change in SI on the same scale, relative to a native value; keeps the sign of `size`.
double share_of(const Figure& figure, double native, double size);

// The errors of a figure from the contact model and from the step, on its scale; empty if they
// cannot be determined.
struct SplitShares {
  std::optional<double> contact;  // remains as the step goes to 0
  std::optional<double> step;     // vanishes with the step: MuJoCo's minus the native one
};
SplitShares split_shares(const Figure& figure, double native, const Split& split);

// "+0.52 %", "-77 points", "×188" on the figure's scale; "∞" if the native value is 0; "–" for
// a figure that is not comparable.
std::string deviation_text(const Figure& figure, double deviation);
// The same for a size, without a sign, and never as a factor.
std::string size_text(const Figure& figure, double size);

// Whether differences from this native value are written in the figure's unit: a value below the
// resolution, of which a share is not the share that is judged, or a count below 100.
bool is_in_units(const Figure& figure, double native);
// The same texts, but in the figure's unit where is_in_units() says so: "+0.0387 mm/s", "+12".
std::string deviation_text(const Figure& figure, double native, double deviation);
std::string size_text(const Figure& figure, double native, double size);
// A difference in SI in the figure's unit: "+0.0387 mm/s", "+12".
std::string change_text(const Figure& figure, double change);

// The residuals of the laws of contact over the rows of a run.
struct ResidualFigure {
  const char* key;         // in JSON
  const char* definition;  // half a sentence; F: Residuals::force_scale, delta_0: the clearance
  const char* law;         // in pages: "law g ≥ 0"
  const char* meaning;     // one sentence
  double Residuals::*value;
};
std::span<const ResidualFigure> residual_figures();
nlohmann::json residuals_json(const Residuals& residuals);

// Figures (SI, a count as a whole number), settled state, residuals and cost of a run, and the
// meaning of their keys. A number that is not finite becomes null. A summary and a sweep contain
// some of them, by key.
nlohmann::json metrics_json(const Metrics& metrics);
std::span<const ColumnMeaning> metric_keys();

// One of them; "settled.from" is within "settled". metric_key and metric_value assert that the key
// exists.
const ColumnMeaning& metric_key(std::string_view key);
// Whether it is a computing time, which is not a result and differs from run to run.
bool is_timing(std::string_view key);
nlohmann::json metric_value(const Metrics& metrics, std::string_view key);

}  // namespace rotorub
