#include "compare/tune/output.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/palette.h"
#include "compare/base/version.h"
#include "compare/engine/engine.h"
#include "compare/figures/figure.h"
#include "compare/model_error/model_error.h"
#include "compare/result/result.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub::tune {
namespace {

using nlohmann::json;

json setting_json(const JudgedSetting& judged, int modes) {
  const Setting& s = judged.setting;
  json errors = json::object(), intervals = json::object(), undecided = json::array();
  for (const JudgedFigure& f : judged.figures) {
    errors[f.figure->key] = number_or_null(f.deviation);
    intervals[f.figure->key] = number_or_null(f.interval);
    if (f.verdict == FigureVerdict::kUndecidable) undecided.push_back(f.figure->key);
  }
  const bool soft = s.contact != scene::ContactModel::kRigid;
  const auto given = [](bool has, double value) {
    return has && value > 0.0 ? json(value) : json(nullptr);
  };
  return {
      {"contact", scene::to_string(s.contact)},
      {"integrator", to_string(s.integrator)},
      {"step", s.step},
      {"modes", modes},
      // null: chosen from the step, or not used by the contact model.
      {"solref_stiffness", given(soft, s.stiffness)},
      {"solref_damping", given(soft, s.damping)},
      {"friction_reference", given(s.contact == scene::ContactModel::kCone, s.friction_reference)},
      {"solver", to_string(s.solver)},
      {"us_per_step", judged.us_per_step > 0.0 ? json(judged.us_per_step) : json(nullptr)},
      {"seconds_per_second", number_or_null(judged.cost())},
      {"trusted", rotorub::to_string(judged.trust)},
      {"errors", errors},
      {"interval", intervals},
      {"undecidable", undecided},
      {"wrong", judged.wrong()},
      {"reason", !judged.failure.empty() ? judged.failure : judged.luck}};
}

json part_json(const ErrorParts& errors, std::optional<double> SplitShares::*part) {
  json all = json::object();
  for (const auto& [figure, shares] : errors.figures) {
    all[figure->key] = number_or_null(shares.*part);
  }
  if (!errors.reason.empty()) all["reason"] = errors.reason;
  return all;
}

constexpr int kLabel = 22, kValue = 15;

std::string cost_text(const JudgedSetting& s) {
  return fmt::format("{} µs a step, {} of computing for 1 s", short_number(s.us_per_step),
                     time_text(std::stod(fmt::format("{:.2g}", s.cost().value_or(0.0)))));
}

std::string wrong_text(const JudgedSetting& s, double tolerance) {
  if (!s.failure.empty()) return s.failure;
  if (!outside(s.figures).empty() || s.luck.empty()) return why(s.figures, tolerance);
  return "passes only by chance: " + s.luck;
}

std::string setting_lines(const char* label, const JudgedSetting& s, double tolerance) {
  const std::string margin = fmt::format("  {:<18}", "");
  return fmt::format("  {:<18}{}\n{}{}\n{}", label, text(s.setting), margin, cost_text(s),
                     wrapped(margin, wrong_text(s, tolerance)));
}

// The best setting of each contact model, unless it is shown already.
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

// The share of one cause in a figure; "not known" if it is undetermined, "-" if the figure has no
// parts.
std::string part_text(const ErrorParts& errors, const JudgedFigure& figure,
                      std::optional<double> SplitShares::*part) {
  for (const auto& [of, shares] : errors.figures) {
    if (of != figure.figure) continue;
    const std::optional<double>& share = shares.*part;
    return share ? deviation_text(*of, figure.native_mean, *share) : "not known";
  }
  return "-";
}

std::string mode_text(const ModelError& error, const Figure& figure) {
  for (const FigureLimit& f : error.figures) {
    if (f.figure != &figure) continue;
    return f.error ? deviation_text(figure, f.values[0], *f.error) : "no limit seen";
  }
  return "-";
}

// The trusted setting's deviation and its causes for each figure.
std::string error_lines(const TuneResult& r) {
  const auto line = [](const std::string& label, const std::vector<std::string>& values) {
    std::string text = fmt::format("  {:<{}}", label, kLabel);
    for (const std::string& value : values) text += fmt::format("{:>{}}", value, kValue);
    return text + "\n";
  };
  std::string lines =
      "\n" + line("errors", {"this setting", "contact model", "step", "modes kept"});
  for (const JudgedFigure& f : r.settings[*r.choice.trusted].figures) {
    lines +=
        line(f.figure->label,
             {deviation_text(f), part_text(r.errors, f, &SplitShares::contact),
              part_text(r.errors, f, &SplitShares::step), mode_text(r.model_error, *f.figure)});
  }
  if (!r.errors.reason.empty()) lines += wrapped("  not known: ", r.errors.reason);
  return lines + "\n" + result::text_of(model_error_section(r.model_error));
}

// The settings that the choice names. With a trusted one, also its errors.
std::string choice_lines(const TuneResult& r) {
  const auto lines = [&](const char* label, std::size_t k) {
    return setting_lines(label, r.settings[k], r.tolerance);
  };
  const auto& [trusted, next_cheaper, best, nearest] = r.choice;
  if (!trusted) {
    return "  none can be trusted\n" + (nearest ? lines("nearest", *nearest) : "") + best_lines(r);
  }
  return lines("trusted", *trusted) +
         (next_cheaper ? lines("next cheaper", *next_cheaper)
                       : "  next cheaper      none; the trusted setting is the cheapest\n") +
         best_lines(r) + error_lines(r);
}

}  // namespace

result::Section result_of(const TuneResult& r) {
  const auto one = [&](const std::optional<std::size_t>& k) {
    return k ? setting_json(r.settings[*k], r.modes) : json(nullptr);
  };
  json best = json::array(), all = json::array();
  for (const std::size_t k : r.choice.best_by_contact) best.push_back(one(k));
  for (const JudgedSetting& s : r.settings) all.push_back(setting_json(s, r.modes));
  const bool found = r.choice.trusted.has_value();
  return {
      .parts = {result::Data{"",
                             {{"program", "rotorub"},
                              {"version", program_version()},
                              {"mujoco_version", mujoco_version()},
                              {"scene", r.scene.name},
                              {"scene_hash", scene::scene_hash(r.scene)},
                              {"tolerance", r.tolerance},
                              {"trusted", one(r.choice.trusted)},
                              {"next_cheaper", one(r.choice.next_cheaper)},
                              {"best_by_contact", best},
                              {"nearest", one(r.choice.nearest)},
                              {"model_error", result::json_of(model_error_section(r.model_error))},
                              {"contact_error", part_json(r.errors, &SplitShares::contact)},
                              {"step_error", part_json(r.errors, &SplitShares::step)},
                              {"settings", all}}},
                result::line(fmt::format("{}: {} settings of MuJoCo judged at {}",
                                         scene::printable(r.scene.name), r.settings.size(),
                                         percent_text(r.tolerance))),
                result::Sentence{.text = choice_lines(r),
                                 .wraps = false,
                                 .tone = found ? Tone::kGood : Tone::kBad,
                                 .toned = found ? "trusted" : "none can be trusted"}}};
}

}  // namespace rotorub::tune
