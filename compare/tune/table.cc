#include "compare/tune/table.h"

#include <fmt/format.h>

#include "compare/base/format.h"
#include "compare/engine/engine.h"
#include "compare/figures/figure_text.h"

namespace rotorub::tune {
namespace {

constexpr int kLabel = 22, kValue = 15;

std::string cost_text(const JudgedSetting& s) {
  return fmt::format("{} us a step, {} of computing for 1 s", short_number(s.us_per_step),
                     time_text(std::stod(fmt::format("{:.2g}", s.cost().value_or(0.0)))));
}

std::string wrong_text(const JudgedSetting& s, double tolerance) {
  if (!s.failure.empty()) return s.failure;
  if (!outside(s.figures).empty() || s.luck.empty()) return why(s.figures, tolerance);
  return "passes by luck; " + s.luck;
}

std::string setting_lines(const char* label, const JudgedSetting& s, double tolerance) {
  const std::string margin = fmt::format("  {:<18}", "");
  return fmt::format("  {:<18}{}\n{}{}\n{}", label, text(s.setting), margin, cost_text(s),
                     wrapped(margin, wrong_text(s, tolerance)));
}

// Each contact model at its best, where that is not shown already.
std::string best_lines(const TuneResult& r) {
  std::string lines;
  for (const std::size_t k : r.choice.best_by_contact) {
    if (k == r.choice.trusted || k == r.choice.next_cheaper || k == r.choice.nearest) continue;
    const JudgedSetting& s = r.settings[k];
    const std::string label = scene::to_string(s.setting.contact);
    lines += setting_lines((s.is_trusted() ? label : "no: " + label).c_str(), s, r.tolerance);
  }
  return lines;
}

// Each cause has the figures that it has something to say of.
std::string part_text(const ErrorPart& part, const Figure& figure) {
  for (const auto& [of, share] : part.figures) {
    if (of == &figure) return share ? deviation_text(figure, *share) : "not known";
  }
  return "-";
}

std::string mode_text(const ModelError& error, const Figure& figure) {
  for (const FigureLimit& f : error.figures) {
    if (f.figure == &figure) return f.error ? deviation_text(figure, *f.error) : "no limit seen";
  }
  return "-";
}

// The trusted setting's deviation and its causes, figure by figure.
std::string error_lines(const TuneResult& r) {
  const JudgedSetting& s = r.settings[*r.choice.trusted];
  std::string lines =
      fmt::format("\n  {:<{}}{:>{}}{:>{}}{:>{}}{:>{}}\n", "errors", kLabel, "this setting", kValue,
                  "contact model", kValue, "step", kValue, "modes kept", kValue);
  const ModelError& modes = r.model_error;
  for (const JudgedFigure& f : s.figures) {
    lines += fmt::format(
        "  {:<{}}{:>{}}{:>{}}{:>{}}{:>{}}\n", f.figure->label, kLabel,
        deviation_text(*f.figure, f.deviation), kValue, part_text(r.errors.contact, *f.figure),
        kValue, part_text(r.errors.step, *f.figure), kValue, mode_text(modes, *f.figure), kValue);
  }
  if (!r.errors.contact.reason.empty()) lines += wrapped("  not known: ", r.errors.contact.reason);
  return lines + "\n" + model_error_table(modes, "  ");
}

}  // namespace

std::string tune_table(const TuneResult& r, const Palette& palette) {
  const auto& all = r.settings;
  std::string lines = fmt::format("{}: {} settings of MuJoCo judged at {}\n", r.scene.name,
                                  all.size(), percent_text(r.tolerance));
  if (!r.choice.trusted) {
    lines += "  " + palette.paint(Tone::kBad, "none can be trusted") + "\n";
    if (r.choice.nearest) lines += setting_lines("nearest", all[*r.choice.nearest], r.tolerance);
    return lines + best_lines(r);
  }
  lines += palette.paint_first(
      Tone::kGood, setting_lines("trusted", all[*r.choice.trusted], r.tolerance), "trusted");
  if (!r.choice.next_cheaper) {
    return lines + "  next cheaper      none: it is the cheapest of all\n" + best_lines(r) +
           error_lines(r);
  }
  lines += setting_lines("next cheaper", all[*r.choice.next_cheaper], r.tolerance);
  return lines + best_lines(r) + error_lines(r);
}

}  // namespace rotorub::tune
