#include "compare/report/bench_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "compare/bench/output.h"
#include "compare/bench/work_precision.h"
#include "compare/report/page_frame.h"
#include "compare/result/result.h"

namespace rotorub {

namespace {

using namespace bench;
using nlohmann::json;

json card_of(const SceneBench& bench, const std::string& id) {
  std::optional<bool> native;  // empty if no level is reached
  for (const Level& level : bench.levels) {
    const std::optional<bool> here = native_is_fastest(level);
    if (in_headline(level) && here) native = native.value_or(true) && *here;
  }
  json shown = card(bench.scene.name, native ? *native ? "good" : "bad" : "part",
                    !native   ? "No engine reaches a level"
                    : *native ? "A native integrator at every level reached"
                              : "Not native at every level",
                    verdict_text(bench.levels));
  shown["link"] = "#" + id;
  return shown;
}

}  // namespace

std::string bench_page(const Machine& machine, const std::vector<SceneBench>& benches,
                       const std::vector<RestitutionRow>& restitution) {
  const result::Section found = bench::result_of(machine, benches, restitution);
  json sections = page_json(found), cards = json::array();
  std::vector<std::string> names;
  for (std::size_t k = 0; k < benches.size(); ++k) {
    json& section = sections[k];
    json& parts = section["parts"];
    names.push_back(benches[k].scene.name);
    cards.push_back(card_of(benches[k], section["id"]));
    parts.insert(parts.begin(), json{{"plots", "bench"}, {"index", k}});
    parts.push_back({{"summary", "The scene's text"}, {"pre", benches[k].scene.text}});
  }
  const std::string lead = fmt::format(
      "Every engine on a ladder of steps (of tolerances, where it chooses its steps). An error is "
      "the largest distance of rotor or ring from the reference over the whole run; a time is the "
      "median of repeated whole integrations with the output off, all points in turns. Measured on "
      "{}, {}, one thread each; {}; MuJoCo {}.",
      machine.processor, machine.instructions, machine.compiler, machine.mujoco);
  sections.insert(sections.begin(), {{{"cards", cards}}, {{"lead", lead}}});
  return laid_out_page(
      {fmt::format("{}", fmt::join(names, ", ")), "speed against error",
       "Who is the fastest at a given error?"},
      found, sections, {{"benches", json_of(found).at("scenes")}},
      "Peers get the contact of a disc in a ring (its normal from the present positions) from us; "
      "the solver is theirs. Native times hold the bookkeeping of energy and contact; those of "
      "MuJoCo and of the peers do not.");
}

}  // namespace rotorub
