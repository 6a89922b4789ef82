#include "compare/measured/table.h"

#include <fmt/format.h>

#include <numbers>

#include "compare/base/format.h"

namespace rotorub {
namespace {

constexpr int kNameWidth = 30;
constexpr int kRunWidth = 10;

std::string record_line(const std::string& label, const std::string& measured,
                        const std::vector<std::string>& runs) {
  std::string text = fmt::format("{:<{}}{:>{}}", label, kNameWidth, measured, kRunWidth);
  for (const std::string& run : runs) text += fmt::format("{:>{}}", run, kRunWidth);
  while (text.back() == ' ') text.pop_back();
  return text + "\n";
}

// The unit that a quantity is written in, and SI values times it.
struct WrittenUnit {
  const char* unit;
  double per_unit;
};
WrittenUnit written_unit(const Measurable& what) {
  if (what.unit() == "m") return {"µm", 1e6};
  if (what.unit() == "rad/s") return {"rpm", 30.0 / std::numbers::pi};
  return {what.unit() == "N" ? "N" : "A", 1.0};
}

}  // namespace

std::string residual_unit(const Measurable& what) { return written_unit(what).unit; }

std::string residual_text(const Measurable& what, double value) {
  return short_number(value * written_unit(what).per_unit);
}

std::string share_text(const ColumnResidual& residual) {
  return residual.share ? fmt::format("{:.3g} %", 100.0 * *residual.share) : std::string("–");
}

std::string figure_label(const MeasuredFigure& f) { return fmt::format("{}, {}", f.label, f.unit); }

std::string measured_value(const MeasuredFigure& f) {
  const char* sign = f.bound == Bound::kAtLeast ? "≥ " : f.bound == Bound::kAtMost ? "≤ " : "";
  return sign + short_number(f.measured * f.per_unit);
}

std::string measured_table(const MeasuredRun& run) {
  std::string text = wrapped("  measured: ", fmt::format("{}, {} samples, {} apart", run.file,
                                                         run.samples, time_text(run.interval)));
  text += wrapped("    ", alignment_text(run.alignment));
  if (!run.figures.empty())
    text += record_line("  at the record's samples", "measured", run.labels);
  for (const MeasuredFigure& f : run.figures) {
    std::vector<std::string> values;
    for (const double value : f.runs) values.push_back(short_number(value * f.per_unit));
    text += record_line("    " + figure_label(f), measured_value(f), values);
  }
  text += record_line("  record less run, rms", "", run.labels);
  for (const ColumnFit& c : run.columns) {
    std::vector<std::string> rms, shares;
    for (const ColumnResidual& r : c.runs) {
      rms.push_back(residual_text(*c.what, r.rms));
      shares.push_back(share_text(r));
    }
    text += record_line(fmt::format("    {}, {}", c.what->name, residual_unit(*c.what)), "", rms);
    text += record_line("      of its deviation", "", shares);
  }
  for (const std::string& remark : run.remarks) text += wrapped("    - ", remark);
  return text;
}

}  // namespace rotorub
