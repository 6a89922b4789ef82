#include "compare/report/branches_page.h"

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
  return laid_out_page(
      {scene.name, "periodic rubs", "Which rubs repeat, and which of them last?"}, found,
      "branches", {{"branches", std::move(data)}, {"texts", {scene.text}}},
      "`rotorub modes --periodic --across --json` prints the figures in SI units.");
}

}  // namespace rotorub
