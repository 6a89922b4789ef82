#include "compare/sweep/point_result.h"

#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/columns.h"

namespace rotorub::sweep {
namespace {

using Type = ResultColumn::Type;
using Number = std::optional<double>;

template <auto Member>
Number member(const Figures& f) {
  if constexpr (std::is_same_v<std::decay_t<decltype(f.*Member)>, Number>) {
    return f.*Member;
  } else {
    return static_cast<double>(f.*Member);
  }
}
template <auto Member>
Number last(const Figures& f) {
  return f.settled.*Member;
}
const char* attractor(const Figures& f) { return to_string(f.settled.attractor); }

const ResultColumn kColumns[] = {
    {"end", Type::kNumber, "s", "time reached", member<&Figures::end>},
    {"steps", Type::kWhole, "", "steps of the integrator", member<&Figures::steps>},
    {"first_touch", Type::kNumber, "s",
     "first contact; of an ensemble the beginning of its step; empty: never touched",
     member<&Figures::first_touch>},
    {"impacts", Type::kWhole, "", "impacts that close faster than 0.1 mm/s",
     member<&Figures::impacts>},
    {"contact_fraction", Type::kNumber, "", "share of the time from first touch in contact",
     member<&Figures::contact_fraction>},
    {"mean_force", Type::kNumber, "N", "normal impulse over the time from first touch",
     member<&Figures::mean_force>},
    {"peak_force", Type::kNumber, "N",
     "largest normal impulse of one run.step, divided by it: an impact's grows as the step shrinks",
     member<&Figures::peak_force>},
    {"impulse_total", Type::kNumber, "N s", "all normal impulse", member<&Figures::impulse_total>},
    {"attractor", Type::kWord, "",
     "what the last fifth of the run is: no contact, chattering, resting, synchronous rub, forward "
     "rub, backward whip, rolling or unknown; from 41 rows evenly spaced over it",
     nullptr, attractor},
    {"contact_share", Type::kNumber, "", "share of the last fifth's rows in contact",
     last<&Settled::contact_share>},
    {"whirl_frequency", Type::kNumber, "rad/s", "mean whirl over the last fifth, forward positive",
     last<&Settled::whirl_frequency>},
    {"spin_speed", Type::kNumber, "rad/s", "mean spin speed over the last fifth",
     last<&Settled::spin_speed>},
    {"peak_impulse", Type::kNumber, "N s", "largest normal impulse of one impact",
     member<&Figures::peak_impulse>},
    {"friction_work", Type::kNumber, "J", "what friction took, never positive",
     member<&Figures::friction_work>},
    {"max_penetration", Type::kNumber, "m", "deepest penetration",
     member<&Figures::max_penetration>},
    {"energy_residual", Type::kNumber, "",
     "imbalance of the energy over the largest energy met; single runs",
     member<&Figures::energy_residual>},
};

constexpr ColumnMeaning kPoint{"point", "", "number of the point in the study's order, from 0", ""};
constexpr std::string_view kVaried = "value of the varied key";
constexpr ColumnMeaning kOutcome[] = {
    {"status", "", "as of a run, or refused: its values make no scene that can run", ""},
    {"reason", "", "why it is not ok; its figures are then empty", ""},
};

}  // namespace

std::span<const ResultColumn> result_columns() { return kColumns; }

double settled_row(double end, int row) {
  const double from = (1.0 - kSettledShare) * end;
  if (row == kSettledRows - 1) return end;
  return from + (end - from) * static_cast<double>(row) / static_cast<double>(kSettledRows - 1);
}

nlohmann::ordered_json sweep_columns_json(const Study& study) {
  auto all = nlohmann::ordered_json::array();
  const auto add = [&](const auto& c) { all.push_back(column_json(c.name, c.unit, c.meaning)); };
  add(kPoint);
  for (const Vary& vary : study.vary) all.push_back(column_json(vary.key, vary.unit, kVaried));
  for (const ColumnMeaning& column : kOutcome) add(column);
  for (const ResultColumn& column : result_columns()) add(column);
  return {{"results.csv", all}};
}

std::string sweep_columns_markdown() {
  std::vector<ColumnMeaning> all{kPoint, {"<key>", "SI", kVaried, "one for each key"}};
  all.insert(all.end(), std::begin(kOutcome), std::end(kOutcome));
  for (const ResultColumn& c : result_columns()) all.push_back({c.name, c.unit, c.meaning, ""});
  return columns_table(all);
}

}  // namespace rotorub::sweep
