#include "compare/modes/rub_map_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/plot_points.h"
#include "compare/base/units.h"
#include "compare/modes/rub_analysis.h"
#include "compare/modes/rub_result.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

using nlohmann::json;
using result::Section, result::Sentence, result::Table;
using rub::RubKind, rub::RubPoint, rub::StandingRub;

// Indexed by the bits of the set (rub::Attractor). Rolling, which is possible nearly everywhere, is
// marked by a capital letter.
constexpr std::array<char, 16> kLetters = {'-', '.', 'r', 'b', 'w', 'v', 'x', 'a',
                                           'o', 'O', 'R', 'B', 'W', 'V', 'X', 'A'};

json rows_of(const Eigen::MatrixXd& matrix) {
  json rows = json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::VectorXd row = matrix.row(i);
    rows.push_back(std::vector<double>(row.data(), row.data() + row.size()));
  }
  return rows;
}

double axis_scale(const MapAxis& axis) { return shown_unit(axis.unit).per_si; }
std::string axis_title(const MapAxis& axis) {
  return name_and_unit(axis.key, shown_unit(axis.unit).name);
}

std::vector<std::string> state_names(const LinearPlant& plant) {
  const std::size_t modes = (plant.coordinates.size() - 2) / 2;
  std::vector<std::string> names;
  for (const char* rate : {"", "v"}) {
    for (const char* plane : {"x", "y"}) {
      for (std::size_t k = 1; k <= modes; ++k)
        names.push_back(fmt::format("{}{}_{}", rate, plane, k));
    }
    for (const char* plane : {"x", "y"}) names.push_back(fmt::format("stator_{}{}", rate, plane));
  }
  names.insert(names.end(), plant.memory_names.begin(), plant.memory_names.end());
  return names;
}

// A figure at each speed, in rows, and at each feedback.
json feedback_rows(const rub::FeedbackMap& map, json (*figure)(const rub::FeedbackPoint&)) {
  json rows = json::array();
  for (std::size_t i = 0; i < map.speeds.size(); ++i) {
    json& row = rows.emplace_back(json::array());
    for (std::size_t j = 0; j < map.feedbacks.size(); ++j) row.push_back(figure(map.at(i, j)));
  }
  return rows;
}

json feedback_map_json(const rub::FeedbackMap& map) {
  using Point = rub::FeedbackPoint;
  json rule = json::array();
  for (const auto& k : map.rule()) rule.push_back(k ? json(k->point->feedback) : json());
  return {{"speeds", map.speeds},
          {"feedbacks", map.feedbacks},
          {"growth",
           feedback_rows(
               map, [](const Point& p) { return p.forced ? json(p.forced->growth) : json(); })},
          {"stable",
           feedback_rows(map, [](const Point& p) { return json(p.forced && p.forced->stable); })},
          {"frequency",
           feedback_rows(
               map, [](const Point& p) { return p.forced ? json(p.forced->frequency) : json(); })},
          {"normal_force",
           feedback_rows(map, [](const Point& p) { return number_or_null(p.normal_force); })},
          {"whip", feedback_rows(map, [](const Point& p) { return json(p.whip); })},
          {"rule", rule}};
}

template <RubKind kind, class Value>
json of_leading(const RubPoint& point, Value value) {
  const StandingRub* leading = point.leading(kind);
  return leading ? number_or_null(value(*leading)) : json();
}

double growth(const StandingRub& r) { return r.stability.growth; }
double pair_frequency(const StandingRub& r) { return r.stability.frequency; }
double force(const StandingRub& r) { return r.rub.normal_force; }
double whirl(const StandingRub& r) { return r.rub.whirl; }

struct RubFigure {
  const char* name;
  json (*value)(const RubPoint&);
};
constexpr RubFigure kRubFigures[] = {
    {"attractors", [](const RubPoint& p) { return json(attractors_text(p.attractors())); }},
    {"rub_growth", [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, growth); }},
    {"rub_frequency",
     [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, pair_frequency); }},
    {"rub_force", [](const RubPoint& p) { return of_leading<RubKind::kForced>(p, force); }},
    {"whip_growth", [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, growth); }},
    {"whip_whirl", [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, whirl); }},
    {"whip_force", [](const RubPoint& p) { return of_leading<RubKind::kWhip>(p, force); }},
    {"rolling_force", [](const RubPoint& p) { return of_leading<RubKind::kRolling>(p, force); }},
    {"free_orbit",
     [](const RubPoint& p) { return p.orbit ? number_or_null(*p.orbit / p.clearance) : json(); }},
};

}  // namespace

json rub_map_json(const RubKeyMap& map) {
  json points = json::array();
  for (const auto& point : map.points)
    points.push_back(point ? result::json_of(rub_point_result(*point)) : json(nullptr));
  if (map.of_speed_and_friction())
    return {{"speeds", map.across.values}, {"frictions", map.up.values}, {"points", points}};
  return {{"across", axis_json(map.across)}, {"up", axis_json(map.up)}, {"points", points}};
}

json rub_columns(const std::vector<std::optional<RubPoint>>& points) {
  json columns = json::object();
  for (const RubFigure& figure : kRubFigures) {
    columns[figure.name] = list_of(points, [&](const std::optional<RubPoint>& point) {
      return point ? figure.value(*point) : json();
    });
  }
  return columns;
}

Section rub_map_picture(const std::string& name, const RubKeyMap& map) {
  std::string text;
  std::array<int, 16> met{};
  const std::size_t columns = map.across.values.size();
  const bool common = map.of_speed_and_friction();
  if (!common) text += fmt::format("{}\n", axis_title(map.up));
  for (std::size_t u = map.up.values.size(); u-- > 0;) {
    text += fmt::format("{:>9.4g} |", map.up.values[u] * axis_scale(map.up));
    for (std::size_t a = 0; a < columns; ++a) {
      const auto& point = map.at(a, u);
      if (point) ++met[point->attractors()];
      text += point ? kLetters[point->attractors()] : ' ';
    }
    text += "\n";
  }
  const auto end = [&](double value) {
    return fmt::format("{:.4g}{}", value * axis_scale(map.across), common ? " Hz" : "");
  };
  const std::string low = end(map.across.values.front()), high = end(map.across.values.back());
  const std::size_t wide = std::max(columns, low.size() + high.size() + 2);
  text += fmt::format("{:>10}+{}\n{:>11}{}{:>{}}\n", common ? "friction " : "",
                      std::string(columns, '-'), "", low, high, wide - low.size());
  text += common ? "\n" : fmt::format("{:>11}{}\n\n", "", axis_title(map.across));
  Table legend{"",
               {{.width = -5, .seen = result::kTerminal},
                {.width = -60, .title = "stable together"},
                {.width = 8, .title = "share of the map"}}};
  for (unsigned k = 0; k < met.size(); ++k) {
    if (met[k] == 0) continue;
    const double share = 100.0 * met[k] / static_cast<double>(map.points.size());
    legend.rows.push_back({.items = {{.text = std::string(1, kLetters[k])},
                                     {.text = attractors_text(k)},
                                     {.text = fmt::format("{:.1f} %", share)}}});
  }
  Section all{.parts = {result::line(name + ": which rubs are stable, by their eigenvalues",
                                     result::Role::kCaption),
                        Sentence{},
                        Sentence{.text = text, .wraps = false, .seen = result::kTerminal}, legend}};
  if (!map.refused.empty())
    all.add({Sentence{}, Sentence{.text = "Blank: refused, " + map.refused}});
  all.add({Sentence{},
           Sentence{.text = fmt::format("{}Stable means: against small disturbances that keep the "
                                        "contact; a bounce may lead elsewhere.",
                                        common ? "Horizontally: the spin speed, which is held; the "
                                                 "frequencies of the loads keep their ratio to it. "
                                               : "The spin is held. "),
                    .seen = result::kTerminal}});
  return all;
}

json state_space_json(const scene::Scene& scene, const LinearPlant& plant) {
  return {{"speed", scene.rotor.speed},
          {"states", state_names(plant)},
          {"inputs", {"control_x", "control_y"}},
          {"outputs", {"rotor_x", "rotor_y", "stator_x", "stator_y"}},
          {"A", rows_of(plant.a)},
          {"B", rows_of(plant.b)},
          {"C", rows_of(plant.c)}};
}

json state_space_json(const scene::Scene& scene, const MagneticPlant& plant) {
  std::vector<std::string> states, inputs, outputs;
  const auto modes = static_cast<std::size_t>(plant.a.rows()) / 4;
  for (const char* name : {"x", "y", "vx", "vy"}) {
    for (std::size_t k = 1; k <= modes; ++k) states.push_back(fmt::format("{}_{}", name, k));
  }
  for (const std::size_t k : plant.bearings) {
    const std::string bearing = k == 0 ? "bearing" : fmt::format("bearing{}", k + 1);
    for (const char* axis : {"x", "y"}) {
      inputs.push_back(fmt::format("{}_current_{}", bearing, axis));
      outputs.push_back(fmt::format("{}_sensor_{}", bearing, axis));
    }
  }
  return {{"speed", scene.rotor.speed}, {"states", states},      {"inputs", inputs},
          {"outputs", outputs},         {"A", rows_of(plant.a)}, {"B", rows_of(plant.b)},
          {"C", rows_of(plant.c)}};
}

std::string feedback_keys(const rub::FeedbackMap& map) {
  std::string feedback, speed;
  for (const auto& choice : map.rule()) {
    if (!choice) continue;
    feedback +=
        fmt::format("{}{}", feedback.empty() ? "" : ", ", short_number(choice->point->feedback));
    speed += fmt::format("{}\"{} Hz\"", speed.empty() ? "" : ", ",
                         short_number(kHz * choice->point->speed));
  }
  if (feedback.empty()) return {};
  return fmt::format("feedback = [{}]\nfeedback_speed = [{}]\n", feedback, speed);
}

Section feedback_map_result(const std::string& name, const rub::FeedbackMap& map) {
  Table table{"",
              {{.heading = "Hz", .width = 8, .title = "speed / Hz"},
               {.heading = "N s/m", .width = 10, .title = "k / N s/m"},
               {.heading = "N s/m", .width = 14, .title = "stable from / N s/m"},
               {.heading = "N s/m", .width = 8, .title = "to / N s/m"},
               {.heading = "1/s", .width = 11, .title = "decay / 1/s"},
               {.heading = "N", .width = 10, .title = "normal force / N"},
               {}},
              {},
              ""};
  const auto rule = map.rule();
  for (std::size_t i = 0; i < map.speeds.size(); ++i) {
    const std::string speed = short_number(kHz * map.speeds[i]);
    if (!rule[i]) {
      table.rows.push_back(
          {.items = {{.text = speed}, {.text = "none"}, {.text = "   no forced rub is stable"}}});
      continue;
    }
    const rub::FeedbackPoint& p = *rule[i]->point;
    table.rows.push_back({.items = {{.text = speed},
                                    {p.feedback},
                                    {rule[i]->from},
                                    {rule[i]->to},
                                    {-p.forced->growth},
                                    {*p.normal_force},
                                    {.text = p.whip ? "  beside a whip" : ""}}});
  }
  Section all{
      .parts = {result::Data{"feedback_map", feedback_map_json(map)},
                result::line(fmt::format("{}: cross-coupled feedback k, by the eigenvalues "
                                         "of the forced rub",
                                         scene::printable(name)),
                             result::Role::kCaption),
                Sentence{},
                Sentence{.text = "   speed         k   stable from      to      decay     force",
                         .wraps = false,
                         .seen = result::kTerminal},
                table}};
  const std::string keys = feedback_keys(map);
  if (!keys.empty()) all.add({Sentence{}, result::line("In [controller]:"), result::line(keys)});
  return all;
}

}  // namespace rotorub
