#include "compare/report/linear_maps.h"

#include <fmt/format.h>

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
  json columns(count, json::array());
  for (std::size_t i = 0; i < first["values"].size(); ++i) {
    for (std::size_t j = 0; j < second["values"].size(); ++j) {
      const Point* here = point(i, j);
      for (std::size_t k = 0; k < count; ++k)
        columns[k].push_back(here ? figures[k].value(*here) : json(nullptr));
    }
  }
  return {{"kind", "grid"},
          {"keys", {first, second}},
          {"figures", figures_json(figures)},
          {"columns", columns}};
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
    {"linear: attractors", "", "what is stable by its eigenvalues, and so may coexist", true, false,
     [](const RubPoint& p) { return json(attractors_text(p.attractors())); }},
    {"linear: rub, growth rate", "1/s",
     "synchronous rub, of its least stable pair: below 0 it is stable", false, true,
     [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, growth); }},
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

// -------------------------------------------------------------------- stabilising feedback
constexpr MapFigure<FeedbackPoint> kFeedbackFigures[] = {
    {"rub, growth rate", "1/s", "of its least stable pair: below 0 it is stable", false, true,
     [](const FeedbackPoint& p) { return p.forced ? shown(p.forced->growth) : json(nullptr); }},
    {"rub, normal force", "N", "of the forced rub", false, false,
     [](const FeedbackPoint& p) { return shown(p.normal_force); }},
    {"rub, frequency", "Hz", "of that pair, seen from the turning frame", false, false,
     [](const FeedbackPoint& p) {
       return p.forced ? shown(kHz * p.forced->frequency) : json(nullptr);
     }},
    {"beside it", "", "what is stable beside the forced rub: the start decides", true, false,
     [](const FeedbackPoint& p) { return json(p.whip ? "whip or rolling" : "nothing"); }},
};

// A page of one set of maps. command: prints the figures.
std::string map_page(const scene::Scene& scene, const PageHead& head, const result::Section& found,
                     const char* kind, const char* command, json plots) {
  return laid_out_page(
      head, found, kind, {{"maps", {std::move(plots)}}, {"texts", {scene.text}}},
      fmt::format("`rotorub modes --{} --json` prints the figures in SI units.", command));
}

}  // namespace

json rub_figures() { return figures_json(kRubFigures); }

std::vector<json> rub_values(const RubPoint& point) {
  std::vector<json> values;
  for (const auto& f : kRubFigures) values.push_back(f.value(point));
  return values;
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
  return map_page(scene, {scene.name, "lasting rubs", "Which rubs last, and where?"},
                  rub_map_picture(scene.name, map), "rub_map", "rub-map", rub_map_plots(map));
}

std::string feedback_map_page(const scene::Scene& scene, const FeedbackMap& map) {
  return map_page(scene, {scene.name, "cross-coupled feedback", "Which feedback calms the rub?"},
                  feedback_map_table(scene.name, map), "feedback_map", "feedback-map",
                  feedback_map_plots(map));
}

}  // namespace rotorub
