// The registry of figures: the numbers that a run is described and compared by, one entry each. The
// tables, the JSON, the pages, tune, and the split into model gap and step error all go by it.
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

// How a figure is called and written, whatever it is a figure of: a run, one contact, a record.
struct FigureText {
  const char* key;      // in JSON
  const char* label;    // in tables
  const char* unit;     // of the value as written
  double per_unit;      // written value = value in SI * per_unit
  const char* meaning;  // one sentence
};

// The value, SI, in the unit that the figure is written in; the same on the terminal and in pages.
std::string figure_value(const FigureText& figure, double value);
std::string figure_label(const FigureText& figure);         // "mean normal force, N"
std::string_view figure_si_unit(const FigureText& figure);  // of JSON; "": a number

// How the difference of two values is judged and written.
enum class Scale {
  kRelative,  // difference / value of the native side
  kPoints,    // difference itself: shares of time, in points
  kCount      // of a whole number: as kRelative, but a difference of one does not decide, and small
              // counts are written as they are (trust.h)
};

// Whether the tolerance is on a figure, and what it tells.
enum class Judged {
  kNo,
  kAverage,  // of the whole run: what a machine's bearings and heat feel
  kPeak      // of single moments: what an impact does
};

// How the values of two runs are compared.
struct ComparisonRule {
  Scale scale;
  Judged judged;
  // SI, not of points: a difference is relative to the native value, or to this where that is
  // smaller.
  double resolution = 0.0;
  bool split = true;       // converges with the step: split into model gap and step error
  bool comparable = true;  // means the same for a soft and for a rigid contact: has a difference
  bool by_step = false;    // of impulses within steps: no figure of a run whose steps are its own

  bool is_judged() const { return judged != Judged::kNo; }
};

struct Figure : FigureText, ComparisonRule {
  double (*value)(const Metrics&);  // not a number: the run has no such figure
};

std::span<const Figure> figures();
// Whether a run by itself, beside no other, has the figure.
bool has_figure(const Metrics& metrics, const Figure& figure);
// Asserts that the key is one of the list.
const Figure& figure(const std::string& key);

// Difference on the scale of a figure, as a share (0.01: 1 % or 1 point); relative ones are
// positive where the magnitude grows, 0 for two zeros, infinite where the native value alone is 0
// and the figure has no resolution.
double deviation(const Figure& figure, double native, double other);
// A size or a change in SI on the same scale, beside a native value; of its sign.
double share_of(const Figure& figure, double native, double size);

// What contact model and step each put a figure off by, on its scale: none where that cannot be
// determined.
struct SplitShares {
  std::optional<double> contact;  // what remains as the step goes to 0
  std::optional<double> step;     // what vanishes with it, MuJoCo's less the native one's
};
SplitShares split_shares(const Figure& figure, double native, const Split& split);

// "+0.52 %", "-77 points", "×188" on the figure's scale; "∞" where the native value is 0; "–" for a
// figure that is not comparable.
std::string deviation_text(const Figure& figure, double deviation);
// The same of a size: without a plus.
std::string size_text(const Figure& figure, double size);

// The residuals of the laws of contact, of a run's rows.
struct ResidualFigure {
  const char* key;         // in JSON
  const char* definition;  // half a sentence; F: Residuals::force_scale, delta_0: the clearance
  const char* law;         // in pages: "law g ≥ 0"
  const char* meaning;     // one sentence
  double Residuals::*value;
};
std::span<const ResidualFigure> residual_figures();
nlohmann::json residuals_json(const Residuals& residuals);

// Figures (SI, a count as a whole number), settled state, residuals and cost of a run, a number
// that is not finite as null; and what the keys mean. A summary and a sweep hold some of them, by
// key.
nlohmann::json metrics_json(const Metrics& metrics);
std::span<const ColumnMeaning> metric_keys();

// One of them; "settled.from": within another. Assert that the key is one of the list.
const ColumnMeaning& metric_key(std::string_view key);
// Whether it is a time that the computing took: no result, and never the same twice.
bool is_timing(std::string_view key);
nlohmann::json metric_value(const Metrics& metrics, std::string_view key);

}  // namespace rotorub
