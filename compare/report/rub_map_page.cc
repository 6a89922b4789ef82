#include "compare/report/rub_map_page.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "compare/base/units.h"
#include "compare/modes/rub_analysis.h"
#include "compare/report/map_page.h"
#include "compare/report/rub_figures.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::RubMap;

std::string share(int count, const RubMap& map) {
  return fmt::format("{:.3g} %", 100.0 * count / static_cast<double>(map.points.size()));
}

// How much of the map each attractor holds, and how much has none.
json cards_of(const RubMap& map) {
  std::array<int, 16> met{};
  for (const rub::RubPoint& point : map.points) ++met[point.attractors()];
  json cards = json::array();
  const auto add = [&](unsigned bit, const char* title, const char* text) {
    int all = 0;
    for (unsigned k = 0; k < met.size(); ++k) all += k & bit ? met[k] : 0;
    cards.push_back(map_card(title, share(all, map), text));
  };
  add(rub::kForcedRub, "Synchronous rub stable", "the rotor slides round in step with its load");
  add(rub::kBackwardWhip, "Backward whip stable", "it slides round against the spin");
  add(rub::kRollingRub, "Rolling possible",
      "once there, it rolls round against the spin, and presses hard");
  cards.push_back(map_card("Nothing stable but rolling", share(met[0] + met[rub::kRollingRub], map),
                           "a rotor that does not roll bounces for ever"));
  return cards;
}

}  // namespace

json rub_map_plots(const RubMap& map) {
  return map_plots(map_key("spin speed", "Hz", map.speeds, kHz),
                   map_key("friction", "", map.frictions, 1.0), rub_figures(),
                   [&](std::size_t i, std::size_t j) { return rub_values(map.at(i, j)); });
}

std::string rub_map_page(const scene::Scene& scene, const RubMap& map) {
  return map_page(scene,
                  {"lasting rubs",
                   "Which rubs last, and where?",
                   "Steady rubs of rotor and ring over spin speed and friction, each judged by the "
                   "eigenvalues of its "
                   "small perturbations with contact kept. The spin is held, and each load keeps "
                   "its ratio to it. Where "
                   "several are stable, the start decides; where only rolling is, a rotor that "
                   "does not roll bounces. A "
                   "stable rub may still be out of reach: these maps know nothing of impacts.",
                   "--rub-map",
                   {kLinearAttractors, kLinearGrowth}},
                  cards_of(map), rub_map_plots(map), nullptr);
}

}  // namespace rotorub
