#include "compare/check/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "native_model/scene/text.h"

namespace rotorub::check {
namespace {

using nlohmann::json;

constexpr std::size_t kIndent = 6;              // of the further lines of a reason
constexpr std::size_t kName = 23, kColumn = 8;  // with 7 engines: 80 columns
constexpr std::size_t kMostReason = 400;        // bytes of one reason

std::string cut(const std::string& name) { return scene::printable(name, kName - 4); }

// The word for a column of the table.
const char* word(Outcome outcome) {
  return outcome == Outcome::kViolates ? "fails" : to_string(outcome);
}

std::size_t width_of(const CheckEngine& engine) {
  return std::max(kColumn, std::string_view(engine.column).size() + 1);
}

std::string head() {
  std::string line(kName, ' ');
  std::size_t native = 0, mujoco = 0;
  for (const CheckEngine& e : check_engines()) {
    line += fmt::format("{:>{}}", e.column, width_of(e));
    (e.native ? native : mujoco) += width_of(e);
  }
  return fmt::format("{:{}}{:>{}}{:>{}}\n{}\n", "", kName, "native", native, "MuJoCo", mujoco,
                     line);
}

// The reasons of all cases with one outcome, native ones first.
std::string notes(const std::vector<Case>& cases, Outcome outcome) {
  std::string text;
  for (const bool native : {true, false}) {
    for (const Case& c : cases) {
      if (c.outcome() != outcome || c.native != native) continue;
      if (text.empty()) text = fmt::format("\n{}:\n", word(outcome));
      text += wrapped(fmt::format("  {}, {}: ", cut(scene::printable(c.scene)), c.engine),
                      scene::printable(c.deciding.reason, kMostReason), kIndent);
    }
  }
  return text;
}

json verdict_json(const Verdict& v) {
  return {{"outcome", to_string(v.outcome)},
          {"rule", v.rule},
          {"value", number_or_null(v.value)},
          {"limit", number_or_null(v.limit)},
          {"reason", v.reason}};
}

}  // namespace

std::string table(const std::vector<Case>& cases, const Palette& palette) {
  std::string text = head();
  for (std::size_t i = 0; i < cases.size();) {
    const std::size_t first = i;
    text += fmt::format("{:<{}}", cut(cases[first].scene), kName);
    for (; i < cases.size() && i < first + check_engines().size(); ++i) {
      const Outcome outcome = cases[i].outcome();
      const Tone tone = outcome == Outcome::kPass       ? Tone::kGood
                        : outcome == Outcome::kViolates ? Tone::kBad
                                                        : Tone::kPart;
      text += palette.paint_first(
          tone, fmt::format("{:>{}}", word(outcome), width_of(check_engines()[i - first])),
          word(outcome));
    }
    text += '\n';
  }
  return text + notes(cases, Outcome::kViolates) + notes(cases, Outcome::kRefused);
}

json cases_json(const std::vector<Case>& cases) {
  json all = json::array();
  for (const Case& c : cases) {
    json one = verdict_json(c.deciding);
    one["scene"] = c.scene;
    one["engine"] = c.engine;
    one["rules"] = json::array();
    for (const Verdict& v : c.verdicts) one["rules"].push_back(verdict_json(v));
    all.push_back(std::move(one));
  }
  return {{"cases", std::move(all)}};
}

}  // namespace rotorub::check
