#include "compare/identify/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/measured/output.h"

namespace rotorub::identify {
namespace {

using Eigen::Index;
using nlohmann::json;

constexpr double kAlike = 0.95;  // correlation beyond which two values are hardly distinguishable

std::string named(const Wanted& w) {
  return w.unit.empty() ? w.key : fmt::format("{}, {}", w.key, w.unit);
}

// Width of the column of names.
std::size_t width_of_names(const Result& r) {
  std::size_t width = 34;
  for (const Found& f : r.found) width = std::max(width, named(f.wanted).size() + 2);
  return width;
}

std::string row(const Found& f, std::size_t width) {
  const std::string within =
      f.error ? fmt::format("± {}", short_number(Found::kSure * *f.error)) : "not told";
  return fmt::format("  {:<{}}{:>12.6g}  {:<14}{:.4g} to {:.4g}\n", named(f.wanted), width, f.value,
                     within, f.wanted.from, f.wanted.to);
}

std::string doubts(const Result& r) {
  std::string text;
  if (r.no_better()) {
    text += wrapped("  - ",
                    "the scene as it stood leaves less than these values: they are no best of all, "
                    "or its own lie outside of the ranges; other ranges may find better ones");
  }
  for (const Found& f : r.found) {
    if (f.at_edge) {
      text += wrapped("  - ", fmt::format("{} is at the edge of its range: what is best may lie "
                                          "beyond",
                                          f.wanted.key));
    }
    if (!f.error) {
      text += wrapped("  - ", fmt::format("{}: nothing that the record shows depends on it alone",
                                          f.wanted.key));
    }
  }
  for (Index i = 0; i < r.correlation.rows(); ++i) {
    for (Index j = i + 1; j < r.correlation.cols(); ++j) {
      if (std::abs(r.correlation(i, j)) < kAlike) continue;
      text += wrapped("  - ", fmt::format("{} and {} are hardly told apart: correlation {:+.3f}",
                                          r.found[static_cast<std::size_t>(i)].wanted.key,
                                          r.found[static_cast<std::size_t>(j)].wanted.key,
                                          r.correlation(i, j)));
    }
  }
  return text;
}

}  // namespace

json identify_json(const std::string& measured, const Result& r) {
  json parameters = json::array(), correlation = json::array();
  for (const Found& f : r.found) {
    parameters.push_back({{"key", f.wanted.key},
                          {"unit", f.wanted.unit},
                          {"value", f.value},
                          {"error", number_or_null(f.error)},
                          {"low", f.error ? json(f.low()) : json()},
                          {"high", f.error ? json(f.high()) : json()},
                          {"from", f.wanted.from},
                          {"to", f.wanted.to},
                          {"at_edge", f.at_edge}});
  }
  for (Index i = 0; i < r.correlation.rows(); ++i) {
    const Eigen::VectorXd of = r.correlation.row(i);
    correlation.push_back(std::vector<double>(of.begin(), of.end()));
  }
  return {{"measured", measured},
          {"samples", r.samples},
          {"runs", r.runs},
          {"parameters", parameters},
          {"correlation", correlation},
          {"alignment", alignment_json(r.alignment)},
          {"left_before", number_or_null(r.left_before)},
          {"left", number_or_null(r.alignment.residual)}};
}

std::string identify_table(const std::string& measured, const Result& r) {
  std::string text = wrapped("", fmt::format("identified from {}: {} samples, {} native runs",
                                             measured, r.samples, r.runs));
  const std::size_t width = width_of_names(r);
  text += fmt::format("  {:<{}}{:>12}  {:<14}{}\n", "", width, "value", "95 %", "looked for in");
  for (const Found& f : r.found) text += row(f, width);
  text += doubts(r);
  const std::string before =
      r.left_before ? fmt::format("{:.3g} % of the scene as it stood", 100.0 * *r.left_before)
                    : "it lay nowhere on the scene as it stood";
  text += wrapped("  ", fmt::format("left of the record: {:.3g} % of the run's rms, {}",
                                    100.0 * r.alignment.residual.value_or(0.0), before));
  return text + wrapped("  ", alignment_text(r.alignment));
}

}  // namespace rotorub::identify
