// The result of a kept run, from its summary.json.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "compare/run_files/summary.h"

namespace rotorub {

using nlohmann::json;

namespace {

// The number at a key of a summary, "settled.from"; empty if there is none. An earlier version may
// have written fewer keys.
std::optional<double> read_number(const json& summary, std::string_view key) {
  const json* at = &summary;
  while (true) {
    const std::size_t dot = key.find('.');
    const auto found = at->find(key.substr(0, dot));
    if (found == at->end()) return std::nullopt;
    at = &*found;
    if (dot == std::string_view::npos) break;
    key.remove_prefix(dot + 1);
  }
  return at->is_number() ? std::optional(at->get<double>()) : std::nullopt;
}

Attractor read_attractor(const json& summary) {
  const std::string name = summary.value("/settled/attractor"_json_pointer, std::string());
  for (int k = 0; k < static_cast<int>(Attractor::kUnknown); ++k) {
    if (name == to_string(Attractor{k})) return Attractor{k};
  }
  return Attractor::kUnknown;
}

}  // namespace

result::Section kept_result(const json& summary) {
  const auto number = [&](std::string_view key) { return read_number(summary, key); };
  Metrics m;
  m.first_touch = number("first_touch");
  m.least_gap = number("least_gap");
  m.hard_impacts = static_cast<std::size_t>(number("hard_impacts").value_or(0.0));
  m.mean_force = number("mean_force").value_or(0.0);
  m.settled.attractor = read_attractor(summary);
  const bool ended = summary.value("status", "") == to_string(Status::kOk);
  result::Section kept;
  if (m.first_touch || m.least_gap)
    kept.add({result::Sentence{rub_answer(m, ended ? std::nullopt : number("end")), "rubs: "}});
  for (const json& doubt : summary.value("warnings", json::array()))
    kept.add({result::Sentence{doubt.get<std::string>(), "warning: "}});
  result::Table table{
      .columns = {{"", "figure", -32}, {"", "value", 12}, {"", "unit", -8}, {"", "meaning", -1}}};
  for (const ColumnMeaning& key : summary_keys()) {
    if (const auto value = number(key.name))
      table.rows.push_back({.items = {{std::string(key.name)},
                                      result::number(value, 4),
                                      {std::string(key.unit)},
                                      {std::string(key.meaning)}}});
  }
  if (!table.rows.empty()) kept.add({table});
  return kept;
}

}  // namespace rotorub
