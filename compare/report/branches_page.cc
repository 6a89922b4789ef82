#include "compare/report/branches_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/units.h"
#include "compare/modes/rub_branches_text.h"
#include "compare/report/page_frame.h"
#include "compare/result/result.h"

namespace rotorub {
namespace {

using nlohmann::json;

json axis_of(json axis) {
  const ShownUnit unit = shown_unit(axis.at("unit").get<std::string>());
  axis["name"] = axis.at("key");
  axis["unit"] = unit.name;
  axis["per_si"] = unit.per_si;
  return axis;
}

}  // namespace

std::string branches_page(const scene::Scene& scene, const RubBranches& all) {
  const result::Section found = rub_branches_result(scene.name, all);
  json data = result::json_of(found).at("rub_branches");
  data["across"] = axis_of(data.at("across"));
  if (all.up) data["up"] = axis_of(data.at("up"));
  constexpr const char* lead =
      "Motions of rotor and ring that repeat, with all impacts, slip and sticking, followed over "
      "{} "
      "by continuation; each is a solution of the event-driven model up to round-off. Runs settle "
      "only to stable ones.";
  json sheets = page_json(found);
  sheets.push_back({{"summary", "The scene's text"}, {"pre", scene.text}});
  const json parts = {{{"lead", fmt::format(lead, all.across.key)}},
                      {{"class", "plots"}, {"parts", {{{"plots", "branches"}}}}},
                      {{"class", "sheets"}, {"parts", std::move(sheets)}}};
  return laid_out_page(
      {scene.name, "periodic rubs", "Which rubs repeat, and which of them last?"}, found, parts,
      {{"branches", std::move(data)}},
      "`rotorub modes --periodic --across --json` prints the figures in SI units.");
}

}  // namespace rotorub
