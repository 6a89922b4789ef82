#include "compare/identify/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/measured/output.h"

namespace rotorub::identify {
namespace {

using Eigen::Index;
using nlohmann::json;
using result::Data, result::Section, result::Sentence, result::Table;

constexpr double kAlike = 0.95;  // correlation beyond which two values are hardly distinguishable

std::string named(const Wanted& w) {
  return w.unit.empty() ? w.key : fmt::format("{}, {}", w.key, w.unit);
}

Table parameters_table(const Result& r) {
  std::size_t width = 34;
  for (const Found& f : r.found) width = std::max(width, named(f.wanted).size() + 2);
  Table table{"parameters/#/{column}",
              {{.key = "key", .width = -static_cast<int>(width + 2)},
               {.key = "value", .heading = "value", .width = 12},
               {.key = "error", .heading = "  95 %", .width = -16},
               {.key = "from", .heading = "searched in"},
               {.key = "to", .seen = result::kJson},
               {.key = "unit", .seen = result::kJson},
               {.key = "low", .seen = result::kJson},
               {.key = "high", .seen = result::kJson},
               {.key = "at_edge", .seen = result::kJson}}};
  for (const Found& f : r.found) {
    const Wanted& w = f.wanted;
    const std::string within =
        f.error ? fmt::format("  ± {}", short_number(Found::kSure * *f.error)) : "  unknown";
    table.rows.push_back({.items = {{w.key, named(w)},
                                    {f.value, fmt::format("{:.6g}", f.value)},
                                    {number_or_null(f.error), within},
                                    {w.from, fmt::format("{:.4g} to {:.4g}", w.from, w.to)},
                                    {w.to},
                                    {w.unit},
                                    {f.error ? json(f.low()) : json()},
                                    {f.error ? json(f.high()) : json()},
                                    {f.at_edge}}});
  }
  return table;
}

// For people.
Section doubts(const Result& r) {
  Section all;
  const auto add = [&](const std::string& text) {
    all.add({Sentence{.text = text, .lead = "  - "}});
  };
  if (r.is_exact()) {
    add("Both the original scene and these values fit the record to round-off.");
  } else if (r.no_better()) {
    add("the original scene has a smaller residual than these values, so they are not the best, or "
        "its values lie outside the ranges; try other ranges");
  }
  for (const Found& f : r.found) {
    const std::string& key = f.wanted.key;
    if (f.at_edge) add(key + " is at the edge of its range; the best value may lie beyond");
    if (!f.error)
      add(key + " cannot be determined, because nothing in the record depends on it alone");
  }
  for (Index i = 0; i < r.correlation.rows(); ++i) {
    for (Index j = i + 1; j < r.correlation.cols(); ++j) {
      if (std::abs(r.correlation(i, j)) < kAlike) continue;
      add(fmt::format("{} and {} can hardly be distinguished (correlation {:+.3f})",
                      r.found[static_cast<std::size_t>(i)].wanted.key,
                      r.found[static_cast<std::size_t>(j)].wanted.key, r.correlation(i, j)));
    }
  }
  return all;
}

}  // namespace

Section result_of(const std::string& measured, const Result& r) {
  json correlation = json::array();
  for (Index i = 0; i < r.correlation.rows(); ++i) {
    const Eigen::VectorXd of = r.correlation.row(i);
    correlation.push_back(std::vector<double>(of.begin(), of.end()));
  }
  const std::optional<double>& left = r.alignment.residual;
  const std::string before =
      r.left_before ? fmt::format("{:.3g} % with the original scene", 100.0 * *r.left_before)
                    : "while the record fits no shift of the original scene";
  return {.parts = {
              Data{"",
                   {{"measured", measured},
                    {"samples", r.samples},
                    {"runs", r.runs},
                    {"correlation", correlation},
                    {"alignment", alignment_json(r.alignment)},
                    {"left_before", number_or_null(r.left_before)},
                    {"left", number_or_null(left)}}},
              Sentence{.text = fmt::format("identified from {}: {} samples, {} native runs",
                                           measured, r.samples, r.runs)},
              parameters_table(r), doubts(r),
              Sentence{.text = fmt::format("residual of the record: {:.3g} % of the run's rms, {}",
                                           100.0 * left.value_or(0.0), before),
                       .lead = "  "},
              Sentence{.text = alignment_text(r.alignment), .lead = "  "}}};
}

}  // namespace rotorub::identify
