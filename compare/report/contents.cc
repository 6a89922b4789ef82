#include "compare/report/contents.h"

#include <nlohmann/json.hpp>

namespace rotorub {

using nlohmann::json;

namespace {

json entry(const std::string& to, const std::string& title, json parts = json::array()) {
  const bool has_parts = !parts.empty();
  return {{"to", to}, {"title", title}, {"has_parts", has_parts}, {"parts", std::move(parts)}};
}

}  // namespace

json scene_contents(const json& scene) {
  const std::string id = scene.at("id");
  json parts = {entry(id + "-live", "live"), entry(id + "-plots", "plots"),
                entry(id + "-rotor", "whirl")};
  if (scene.at("has_measured")) parts.push_back(entry(id + "-measured", "measured"));
  if (scene.at("by_figures")) parts.push_back(entry(id + "-differences", "differences"));
  if (scene.at("has_ladder")) parts.push_back(entry(id + "-modes", "modes kept"));
  parts.push_back(entry(id + "-figures", "figures"));
  if (scene.at("has_impacts")) parts.push_back(entry(id + "-impacts", "impacts"));
  parts.push_back(entry(id + "-conditions", "conditions"));
  return entry(id, scene.at("name"), std::move(parts));
}

json report_contents(const json& scenes, bool trades, const json& beside) {
  json all = {entry("verdicts", "Verdicts")};
  if (trades) all.push_back(entry("trades", "What control trades"));
  for (const json& scene : scenes) all.push_back(scene);
  if (!beside.at("benches").empty()) all.push_back(entry("precision", "Speed against error"));
  if (beside.at("has_cases")) all.push_back(entry("cases", "Hard cases"));
  if (!beside.at("map_sets").empty()) all.push_back(entry("maps", "Maps"));
  return all;
}

json run_contents(const std::string& id) {
  return {entry(id + "-live", "Live"), entry(id + "-plots", "Plots"), entry(id + "-rotor", "Whirl"),
          entry(id + "-conditions", "Conditions")};
}

}  // namespace rotorub
