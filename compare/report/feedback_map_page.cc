#include "compare/report/feedback_map_page.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/modes/rub_map_text.h"
#include "compare/report/map_page.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::FeedbackPoint;

constexpr const char* kGrowth = "rub, growth rate";
constexpr const char* kForce = "rub, normal force";

json feedback_figures() {
  return {
      map_figure(kGrowth, "1/s", "of its least stable pair: below 0 it is stable", false, true),
      map_figure("rub, frequency", "Hz", "of that pair, seen from the turning frame", false, false),
      map_figure(kForce, "N", "of the forced rub", false, false),
      map_figure("beside it", "", "what is stable beside the forced rub: the start decides", true,
                 false)};
}

std::vector<json> values_of(const FeedbackPoint& p) {
  std::vector<json> values(4);
  if (p.forced) {
    values[0] = map_number(p.forced->growth);
    values[1] = map_number(kHz * p.forced->frequency);
  }
  if (p.normal_force) values[2] = map_number(*p.normal_force);
  values[3] = p.whip ? "whip or rolling" : "nothing";
  return values;
}

json rule_rows(const rub::FeedbackMap& map) {
  json rows = json::array();
  const auto rule = map.rule();
  for (std::size_t i = 0; i < rule.size(); ++i) {
    const std::string speed = short_number(kHz * map.speeds[i]);
    if (!rule[i]) {
      rows.push_back({{"speed", speed},
                      {"feedback", ""},
                      {"from", ""},
                      {"to", ""},
                      {"decay", ""},
                      {"force", ""},
                      {"note", "no forced rub is stable"}});
      continue;
    }
    const FeedbackPoint& p = *rule[i]->point;
    rows.push_back({{"speed", speed},
                    {"feedback", short_number(p.feedback)},
                    {"from", short_number(rule[i]->from)},
                    {"to", short_number(rule[i]->to)},
                    {"decay", short_number(-p.forced->growth)},
                    {"force", short_number(*p.normal_force)},
                    {"note", p.whip ? "beside a whip" : ""}});
  }
  return rows;
}

json cards_of(const rub::FeedbackMap& map) {
  const auto rule = map.rule();
  std::size_t calm = 0;
  bool zero = map.feedbacks.front() == 0.0;
  std::size_t without = 0;
  for (std::size_t i = 0; i < rule.size(); ++i) {
    calm += rule[i].has_value();
    const auto& forced = map.at(i, 0).forced;
    without += zero && forced && forced->stable;
  }
  json cards = json::array();
  cards.push_back(map_card("Some k makes the forced rub stable",
                           fmt::format("at {} of {} speeds", calm, rule.size()),
                           "where no such rub lasts, or no k calms it, there is none"));
  if (zero) {
    cards.push_back(map_card("It is stable without feedback",
                             fmt::format("at {} of {} speeds", without, rule.size()),
                             "there feedback only makes it decay faster"));
  }
  return cards;
}

}  // namespace

json feedback_map_plots(const rub::FeedbackMap& map) {
  return map_plots(map_key("spin speed", "Hz", map.speeds, kHz),
                   map_key("feedback k", "N s/m", map.feedbacks, 1.0), feedback_figures(),
                   [&](std::size_t i, std::size_t j) { return values_of(map.at(i, j)); });
}

std::string feedback_map_page(const scene::Scene& scene, const rub::FeedbackMap& map) {
  return map_page(
      scene,
      {"cross-coupled feedback",
       "Which feedback calms the rub?",
       "The forced rub of the scene's friction with the force u = -k e_z x q' on the ring, q' the "
       "ring's "
       "velocity, in its closed loop, over spin speed and k: judged by the eigenvalues of its "
       "small "
       "perturbations with contact kept. The rule is the k under which it decays fastest.",
       "--feedback-map",
       {kGrowth, kForce}},
      cards_of(map), feedback_map_plots(map),
      {{"rows", rule_rows(map)}, {"keys", feedback_keys(map)}});
}

}  // namespace rotorub
