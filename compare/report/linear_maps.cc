#include "compare/report/linear_maps.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/modes/control_text.h"
#include "compare/modes/rub_analysis.h"
#include "compare/report/assets.h"
#include "compare/report/page_frame.h"
#include "compare/report/plot_points.h"

namespace rotorub {

using nlohmann::json;

json map_number(double value) {
  return std::isfinite(value) ? json(rounded(value, kDigits)) : json(nullptr);
}

json map_key(std::string_view name, std::string_view unit, const std::vector<double>& values,
             double per_si) {
  json list = json::array();
  for (const double value : values) list.push_back(rounded(value * per_si, kDigits));
  return {{"name", name}, {"unit", unit}, {"even", true}, {"log", false}, {"values", list}};
}

json map_figure(std::string_view name, std::string_view unit, std::string_view meaning, bool word,
                bool is_signed) {
  return {{"name", name}, {"unit", unit},   {"meaning", meaning},
          {"word", word}, {"linear", true}, {"signed", is_signed}};
}

json map_card(std::string_view title, std::string_view headline, std::string_view text) {
  return {{"title", title}, {"tone", ""}, {"headline", headline}, {"text", text}};
}

json map_plots(const json& first, const json& second, const json& figures, const MapRow& row) {
  json columns(figures.size(), json::array()), values = {json::array(), json::array()};
  json status = json::array();
  for (std::size_t i = 0; i < first.at("values").size(); ++i) {
    for (std::size_t j = 0; j < second.at("values").size(); ++j) {
      values[0].push_back(i);
      values[1].push_back(j);
      status.push_back(0);
      std::vector<json> here = row(i, j);
      for (std::size_t k = 0; k < here.size(); ++k) columns[k].push_back(std::move(here[k]));
    }
  }
  return {{"kind", "grid"},     {"keys", {first, second}}, {"figures", figures}, {"values", values},
          {"columns", columns}, {"status", status},        {"statuses", {"ok"}}, {"every", 1}};
}

std::string map_page(const scene::Scene& scene, const MapPage& map, const json& cards,
                     const json& plots, const json& rule) {
  json values = page_frame({scene.name, map.topic, map.heading}, {{"maps", {plots}}});
  values["lead"] = map.lead;
  values["option"] = map.option;
  values["maps"] = figure_choices(map.maps);
  values["cards"] = cards;
  values["figures"] = plots.at("figures");
  values["rule"] = rule;
  values["text"] = scene.text;
  return fill_page(map_page_html(), values);
}

namespace {

using nlohmann::json;
using rub::RubKind;
using rub::RubPoint;
using rub::StandingRub;

template <RubKind kind, class Value>
json of_leading(const RubPoint& point, Value value) {
  const StandingRub* leading = point.leading(kind);
  return leading ? map_number(value(*leading)) : json(nullptr);
}

double growth(const StandingRub& r) { return r.stability.growth; }
double pair_frequency(const StandingRub& r) { return r.stability.frequency * kHz; }
double force(const StandingRub& r) { return r.rub.normal_force; }
double whirl(const StandingRub& r) { return r.rub.whirl * kHz; }

struct RubFigure {
  const char *name, *unit, *meaning;
  bool word, is_signed;
  json (*value)(const RubPoint&);
};

const std::array kRubFigures = {
    RubFigure{kLinearAttractors, "", "what is stable by its eigenvalues, and so may coexist", true,
              false, [](const RubPoint& p) { return json(attractors_text(p.attractors())); }},
    RubFigure{kLinearGrowth, "1/s",
              "synchronous rub, of its least stable pair: below 0 it is stable", false, true,
              [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, growth); }},
    RubFigure{"linear: rub, frequency", "Hz",
              "synchronous rub, of that pair, seen from the turning frame", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, pair_frequency); }},
    RubFigure{"linear: rub, normal force", "N", "synchronous rub", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, force); }},
    RubFigure{"linear: whip, growth rate", "1/s",
              "backward whip that slips, load left out: below 0 it is stable", false, true,
              [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, growth); }},
    RubFigure{"linear: whip, whirl", "Hz", "backward whip, its speed", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, whirl); }},
    RubFigure{"linear: whip, normal force", "N", "backward whip", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, force); }},
    RubFigure{"linear: rolling, normal force", "N",
              "backward rolling at the spin's pace, load left out", false, false,
              [](const RubPoint& p) { return of_leading<RubKind::kRolling>(p, force); }},
    RubFigure{"linear: free orbit", "", "of the clearance, without contact", false, false,
              [](const RubPoint& p) {
                return p.orbit ? map_number(*p.orbit / p.clearance) : json(nullptr);
              }},
};

}  // namespace

json rub_figures() {
  json all = json::array();
  for (const RubFigure& f : kRubFigures) {
    all.push_back(map_figure(f.name, f.unit, f.meaning, f.word, f.is_signed));
  }
  return all;
}

std::vector<json> rub_values(const RubPoint& point) {
  std::vector<json> values;
  for (const RubFigure& f : kRubFigures) values.push_back(f.value(point));
  return values;
}

json figure_choices(const std::vector<std::string>& first) {
  constexpr std::array kWhich = {"first", "second", "third", "fourth"};
  json maps = json::array();
  for (std::size_t k = 0; k < first.size(); ++k) {
    maps.push_back({{"first", first[k]}, {"which", kWhich.at(k)}});
  }
  return maps;
}

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
