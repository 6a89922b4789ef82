#include "compare/check/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "compare/base/json.h"
#include "native_model/scene/text.h"

namespace rotorub::check {
namespace {

using nlohmann::json;
using result::Part;
using result::Role;
using result::Section;
using result::Sentence;
using result::Table;

constexpr std::size_t kIndent = 6;        // of the further lines of a reason
constexpr int kName = 23, kColumn = 8;    // with 7 engines: 80 columns
constexpr std::size_t kMostReason = 400;  // bytes of one reason

std::string cut(const std::string& name) { return scene::printable(name, kName - 4); }

// The word for a column of the table.
const char* word(Outcome outcome) {
  return outcome == Outcome::kViolates ? "fails" : to_string(outcome);
}

int width_of(const CheckEngine& engine) {
  return std::max(kColumn, static_cast<int>(engine.column.size()) + 1);
}

// The headings above those of the engines.
Sentence sides() {
  int native = 0, mujoco = 0;
  for (const CheckEngine& e : check_engines()) (e.native ? native : mujoco) += width_of(e);
  Sentence shown =
      result::line(fmt::format("{:>{}}{:>{}}", "native", kName + native, "MuJoCo", mujoco));
  shown.seen = result::kTerminal;
  return shown;
}

std::size_t index_of(const std::string& engine) {
  const auto& all = check_engines();
  const auto found = std::ranges::find(all, engine, &CheckEngine::name);
  if (found == all.end()) throw std::out_of_range("no engine is called " + engine);
  return static_cast<std::size_t>(found - all.begin());
}

// A row per scene, a column per engine. A page has room for the whole names.
Table outcomes(const std::vector<Case>& cases) {
  Table table{.columns = {{.width = -kName, .seen = result::kTerminal},
                          {.width = -kName, .seen = result::kPage, .title = "case"}},
              .lead = ""};
  const std::size_t names = table.columns.size();
  for (const CheckEngine& e : check_engines())
    table.columns.push_back({.heading = e.column, .width = width_of(e), .title = e.name});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const std::size_t column = names + index_of(c.engine);
    if (i == 0 || cases[i - 1].scene != c.scene || table.rows.back().items.size() > column)
      table.rows.push_back({.items = {{.text = cut(c.scene)}, {.text = c.scene}}});
    const Outcome outcome = c.outcome();
    const Tone tone = outcome == Outcome::kPass       ? Tone::kGood
                      : outcome == Outcome::kViolates ? Tone::kBad
                                                      : Tone::kPart;
    table.rows.back().items.resize(column);
    table.rows.back().items.push_back(
        {.text = word(outcome), .tone = tone, .note = c.deciding.reason});
  }
  return table;
}

// The reasons of all cases with one outcome, native ones first.
std::vector<Part> notes(const std::vector<Case>& cases, Outcome outcome) {
  std::vector<Part> parts;
  for (const bool native : {true, false}) {
    for (const Case& c : cases) {
      if (c.outcome() != outcome || c.native != native) continue;
      if (parts.empty())
        parts = {Sentence{}, result::line(fmt::format("{}:", word(outcome)), Role::kHeading)};
      parts.push_back(
          Sentence{.text = scene::printable(c.deciding.reason, kMostReason),
                   .lead = fmt::format("  {}, {}: ", cut(scene::printable(c.scene)), c.engine),
                   .indent = kIndent});
    }
  }
  return parts;
}

json verdict_json(const Verdict& v) {
  return {{"outcome", to_string(v.outcome)},
          {"rule", v.rule},
          {"value", number_or_null(v.value)},
          {"limit", number_or_null(v.limit)},
          {"reason", v.reason}};
}

}  // namespace

Section result_of(const std::vector<Case>& cases) {
  const std::size_t scenes = cases.size() / check_engines().size();
  const bool good = holds(cases);
  const std::string answer = good ? "every native case passes or is refused as its file says"
                                  : "a native case violates its rules";
  Section result{
      .parts = {Sentence{.text = answer,
                         .lead = fmt::format("{} {}: ", scenes, scenes == 1 ? "scene" : "scenes"),
                         .tone = good ? Tone::kGood : Tone::kBad,
                         .toned = answer},
                Sentence{}, sides(), outcomes(cases)}};
  for (const Case& c : cases) {
    json one = verdict_json(c.deciding);
    one.update({{"scene", c.scene}, {"engine", c.engine}, {"rules", json::array()}});
    for (const Verdict& v : c.verdicts) one["rules"].push_back(verdict_json(v));
    result.add({result::Data{"cases/#", std::move(one)}});
  }
  result.add(notes(cases, Outcome::kViolates));
  result.add(notes(cases, Outcome::kRefused));
  return result;
}

std::vector<Case> cases_of(const json& kept) {
  std::vector<Case> cases;
  for (const json& one : kept.at("cases")) {
    Case& c = cases.emplace_back();
    c.scene = one.at("scene");
    c.engine = one.at("engine");
    c.native = check_engines()[index_of(c.engine)].native;
    const std::string outcome = one.at("outcome");
    c.deciding.outcome = outcome == to_string(Outcome::kPass)      ? Outcome::kPass
                         : outcome == to_string(Outcome::kRefused) ? Outcome::kRefused
                                                                   : Outcome::kViolates;
    c.deciding.reason = one.at("reason");
  }
  return cases;
}

}  // namespace rotorub::check
