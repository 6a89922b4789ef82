#include "compare/report/linear_maps.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "compare/base/units.h"
#include "compare/modes/rub_analysis.h"
#include "compare/modes/rub_map_text.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"
#include "compare/result/result.h"

namespace rotorub {
namespace {

using nlohmann::json;
using rub::FeedbackMap;
using rub::FeedbackPoint;
using rub::RubKind;
using rub::RubPoint;
using rub::StandingRub;

template <class Point>
struct MapFigure {
  const char *name, *unit, *meaning;
  bool word, is_signed;
  json (*value)(const Point&);
};

template <class Point, std::size_t count>
json figures_json(const MapFigure<Point> (&figures)[count]) {
  return list_of(figures, [](const MapFigure<Point>& f) -> json {
    return {{"name", f.name}, {"unit", f.unit}, {"meaning", f.meaning},
            {"word", f.word}, {"linear", true}, {"signed", f.is_signed}};
  });
}

// Describes one axis of a map: its key, its unit and the values shown.
json map_key(const std::string& name, const std::string& unit, json values) {
  return {{"name", name}, {"unit", unit}, {"even", true}, {"log", false}, {"values", values}};
}

// A grid with the second key varying fastest. point(i, j): null where there is none.
template <class Point, std::size_t count, class PointAt>
json map_plots(const json& first, const json& second, const MapFigure<Point> (&figures)[count],
               const PointAt& point) {
  json columns(count, json::array()), places = {json::array(), json::array()};
  json status = json::array();
  for (std::size_t i = 0; i < first["values"].size(); ++i) {
    for (std::size_t j = 0; j < second["values"].size(); ++j) {
      places[0].push_back(i);
      places[1].push_back(j);
      status.push_back(0);
      const Point* here = point(i, j);
      for (std::size_t k = 0; k < count; ++k)
        columns[k].push_back(here ? figures[k].value(*here) : json(nullptr));
    }
  }
  return {{"kind", "grid"},
          {"keys", {first, second}},
          {"figures", figures_json(figures)},
          {"values", places},
          {"columns", columns},
          {"status", status},
          {"statuses", {"ok"}},
          {"every", 1}};
}

// null if there is no value or it is not finite.
json shown(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(rounded(*value)) : json(nullptr);
}

// -------------------------------------------------------------------- lasting rubs
template <RubKind kind, class Value>
json of_leading(const RubPoint& point, Value value) {
  const StandingRub* leading = point.leading(kind);
  return leading ? shown(value(*leading)) : json(nullptr);
}

double growth(const StandingRub& r) { return r.stability.growth; }
double pair_frequency(const StandingRub& r) { return r.stability.frequency * kHz; }
double force(const StandingRub& r) { return r.rub.normal_force; }
double whirl(const StandingRub& r) { return r.rub.whirl * kHz; }

constexpr MapFigure<RubPoint> kRubFigures[] = {
    {kLinearAttractors, "", "what is stable by its eigenvalues, and so may coexist", true, false,
     [](const RubPoint& p) { return json(attractors_text(p.attractors())); }},
    {kLinearGrowth, "1/s", "synchronous rub, of its least stable pair: below 0 it is stable", false,
     true, [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, growth); }},
    {"linear: rub, frequency", "Hz", "synchronous rub, of that pair, seen from the turning frame",
     false, false,
     [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, pair_frequency); }},
    {"linear: rub, normal force", "N", "synchronous rub", false, false,
     [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, force); }},
    {"linear: whip, growth rate", "1/s",
     "backward whip that slips, load left out: below 0 it is stable", false, true,
     [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, growth); }},
    {"linear: whip, whirl", "Hz", "backward whip, its speed", false, false,
     [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, whirl); }},
    {"linear: whip, normal force", "N", "backward whip", false, false,
     [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, force); }},
    {"linear: rolling, normal force", "N", "backward rolling at the spin's pace, load left out",
     false, false, [](const RubPoint& p) { return of_leading<RubKind::kRolling>(p, force); }},
    {"linear: free orbit", "", "of the clearance, without contact", false, false,
     [](const RubPoint& p) { return p.orbit ? shown(*p.orbit / p.clearance) : json(nullptr); }},
};

// The share of the map for each set of attractors, and for none.
json cards_of(const RubKeyMap& map) {
  std::array<int, 16> met{};
  for (const auto& point : map.points)
    if (point) ++met[point->attractors()];
  const auto share = [&](int count) {
    return fmt::format("{:.3g} %", 100.0 * count / static_cast<double>(map.points.size()));
  };
  const auto of = [&](unsigned bit) {
    int all = 0;
    for (unsigned k = 0; k < met.size(); ++k) all += k & bit ? met[k] : 0;
    return share(all);
  };
  return {
      card("Synchronous rub stable", "", of(rub::kForcedRub),
           "the rotor slides round in step with its load"),
      card("Backward whip stable", "", of(rub::kBackwardWhip), "it slides round against the spin"),
      card("Rolling possible", "", of(rub::kRollingRub),
           "once there, it rolls round against the spin, and presses hard"),
      card("Nothing stable but rolling", "", share(met[0] + met[rub::kRollingRub]),
           "a rotor that does not roll bounces for ever")};
}

// -------------------------------------------------------------------- stabilising feedback
constexpr const char* kGrowth = "rub, growth rate";
constexpr const char* kForce = "rub, normal force";

constexpr MapFigure<FeedbackPoint> kFeedbackFigures[] = {
    {kGrowth, "1/s", "of its least stable pair: below 0 it is stable", false, true,
     [](const FeedbackPoint& p) { return p.forced ? shown(p.forced->growth) : json(nullptr); }},
    {"rub, frequency", "Hz", "of that pair, seen from the turning frame", false, false,
     [](const FeedbackPoint& p) {
       return p.forced ? shown(kHz * p.forced->frequency) : json(nullptr);
     }},
    {kForce, "N", "of the forced rub", false, false,
     [](const FeedbackPoint& p) { return shown(p.normal_force); }},
    {"beside it", "", "what is stable beside the forced rub: the start decides", true, false,
     [](const FeedbackPoint& p) { return json(p.whip ? "whip or rolling" : "nothing"); }},
};

json cards_of(const FeedbackMap& map) {
  const auto rule = map.rule();
  const bool zero = map.feedbacks.front() == 0.0;
  std::size_t calm = 0, without = 0;
  for (std::size_t i = 0; i < rule.size(); ++i) {
    const auto& forced = map.at(i, 0).forced;
    calm += rule[i].has_value();
    without += forced && forced->stable;
  }
  const auto speeds = [&](std::size_t n) {
    return fmt::format("at {} of {} speeds", n, rule.size());
  };
  json cards = {card("Some k makes the forced rub stable", "", speeds(calm),
                     "where no such rub lasts, or no k calms it, there is none")};
  if (zero) {
    cards.push_back(card("It is stable without feedback", "", speeds(without),
                         "there feedback only makes it decay faster"));
  }
  return cards;
}

}  // namespace

json rub_figures() { return figures_json(kRubFigures); }

std::vector<json> rub_values(const RubPoint& point) {
  std::vector<json> values;
  for (const auto& f : kRubFigures) values.push_back(f.value(point));
  return values;
}

json figure_choices(const std::vector<std::string>& first) {
  return list_of(first, [](const std::string& name) -> json { return {{"first", name}}; });
}

std::string map_page(MapPage page, const result::Section& found, json plots) {
  plots["maps"] = figure_choices(page.first);
  page.below.push_back({{"figures", 0}});
  if (!page.scene.empty())
    page.below.push_back({{"summary", "The scene's text"}, {"pre", page.scene}});
  page.above.push_back({{"maps", 0}});
  page.above.push_back({{"class", "sheets"}, {"parts", std::move(page.below)}});
  return laid_out_page(
      page.head, found, page.above, {{"maps", {plots}}},
      fmt::format("`rotorub {} --json` prints the figures in SI units.", page.command));
}

json rub_map_plots(const RubKeyMap& map) {
  const auto key = [](const MapAxis& axis) {
    const ShownUnit unit = shown_unit(axis.unit);
    const std::string name = axis.key == kSpeedKey      ? "spin speed"
                             : axis.key == kFrictionKey ? "friction"
                                                        : axis.key;
    return map_key(name, unit.name, rounded_list(axis.values, unit.per_si));
  };
  return map_plots(key(map.across), key(map.up), kRubFigures,
                   [&](std::size_t i, std::size_t j) -> const RubPoint* {
                     return map.at(i, j) ? &*map.at(i, j) : nullptr;
                   });
}

json feedback_map_plots(const FeedbackMap& map) {
  return map_plots(map_key("spin speed", "Hz", rounded_list(map.speeds, kHz)),
                   map_key("feedback k", "N s/m", rounded_list(map.feedbacks)), kFeedbackFigures,
                   [&](std::size_t i, std::size_t j) { return &map.at(i, j); });
}

std::string rub_map_page(const scene::Scene& scene, const RubKeyMap& map) {
  const std::string axes = map.of_speed_and_friction()
                               ? "spin speed and friction"
                               : fmt::format("{} and {}", map.across.key, map.up.key);
  const result::Section found = rub_map_picture(scene.name, map);
  const std::string lead = fmt::format(
      "Steady rubs of rotor and ring over {}, each judged by the eigenvalues of its small "
      "perturbations with contact kept. The spin is held, and where it changes each load keeps its "
      "ratio to it. Where several are stable, the start decides; where only rolling is, a rotor "
      "that does not roll bounces. A stable rub may still be out of reach: these maps know nothing "
      "of impacts.",
      axes);
  return map_page({.head = {scene.name, "lasting rubs", "Which rubs last, and where?"},
                   .command = "modes --rub-map",
                   .first = {kLinearAttractors, kLinearGrowth},
                   .above = {{{"cards", cards_of(map)}}, {{"lead", lead}}},
                   .below = page_json(found),
                   .scene = scene.text},
                  found, rub_map_plots(map));
}

std::string feedback_map_page(const scene::Scene& scene, const FeedbackMap& map) {
  const result::Section found = feedback_map_table(scene.name, map);
  constexpr const char* lead =
      "The forced rub of the scene's friction with the force u = -k e_z x q' on the ring, q' the "
      "ring's velocity, in its closed loop, over spin speed and k: judged by the eigenvalues of "
      "its small perturbations with contact kept. The rule is the k under which it decays fastest.";
  return map_page({.head = {scene.name, "cross-coupled feedback", "Which feedback calms the rub?"},
                   .command = "modes --feedback-map",
                   .first = {kGrowth, kForce},
                   .above = {{{"cards", cards_of(map)}}, {{"lead", lead}}},
                   .below = page_json(found),
                   .scene = scene.text},
                  found, feedback_map_plots(map));
}

}  // namespace rotorub
