#include "compare/modes/rub_map_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/units.h"
#include "compare/modes/result.h"
#include "compare/modes/rub_analysis.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

using nlohmann::json;

// Indexed by the bits of the set (rub::Attractor). Rolling, which is possible nearly everywhere, is
// marked by a capital letter.
constexpr std::array<char, 16> kLetters = {'-', '.', 'r', 'b', 'w', 'v', 'x', 'a',
                                           'o', 'O', 'R', 'B', 'W', 'V', 'X', 'A'};

nlohmann::json rows_of(const Eigen::MatrixXd& matrix) {
  nlohmann::json rows = nlohmann::json::array();
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    const Eigen::VectorXd row = matrix.row(i);
    rows.push_back(std::vector<double>(row.data(), row.data() + row.size()));
  }
  return rows;
}

// Hz instead of rad/s, as on the pages.
double axis_scale(const MapAxis& axis) { return axis.unit == "rad/s" ? kHz : 1.0; }
std::string axis_title(const MapAxis& axis) {
  if (axis.unit.empty()) return axis.key;
  return fmt::format("{} / {}", axis.key, axis.unit == "rad/s" ? "Hz" : axis.unit);
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

}  // namespace

json rub_map_json(const RubKeyMap& map) {
  json points = json::array();
  for (const auto& point : map.points)
    points.push_back(point ? result::json_of(rub_point_result(*point)) : json(nullptr));
  if (map.of_speed_and_friction())
    return {{"speeds", map.across.values}, {"frictions", map.up.values}, {"points", points}};
  const auto axis = [](const MapAxis& of) -> json {
    return {{"key", of.key}, {"unit", of.unit}, {"values", of.values}};
  };
  return {{"across", axis(map.across)}, {"up", axis(map.up)}, {"points", points}};
}

std::string rub_map_picture(const std::string& name, const RubKeyMap& map) {
  std::string text = fmt::format("{}: which rubs are stable, by their eigenvalues\n\n", name);
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
  for (unsigned k = 0; k < met.size(); ++k) {
    if (met[k] == 0) continue;
    text += fmt::format("  {}  {:<60}{:>6.1f} %\n", kLetters[k], attractors_text(k),
                        100.0 * met[k] / static_cast<double>(map.points.size()));
  }
  if (!map.refused.empty()) text += "\n" + wrapped("", "Blank: refused, " + map.refused);
  return text + "\n" +
         wrapped("", fmt::format("{}Stable means: against small disturbances that keep the "
                                 "contact; a bounce may lead elsewhere.",
                                 common ? "Horizontally: the spin speed, which is held; the "
                                          "frequencies of the loads keep their ratio to it. "
                                        : "The spin is held. "));
}

nlohmann::json state_space_json(const scene::Scene& scene, const LinearPlant& plant) {
  return {{"speed", scene.rotor.speed},
          {"states", state_names(plant)},
          {"inputs", {"control_x", "control_y"}},
          {"outputs", {"rotor_x", "rotor_y", "stator_x", "stator_y"}},
          {"A", rows_of(plant.a)},
          {"B", rows_of(plant.b)},
          {"C", rows_of(plant.c)}};
}

nlohmann::json feedback_map_json(const rub::FeedbackMap& map) {
  nlohmann::json growth = nlohmann::json::array(), stable = growth, force = growth, rule = growth;
  for (std::size_t i = 0; i < map.speeds.size(); ++i) {
    nlohmann::json g = nlohmann::json::array(), s = g, f = g;
    for (std::size_t j = 0; j < map.feedbacks.size(); ++j) {
      const rub::FeedbackPoint& p = map.at(i, j);
      g.push_back(p.forced ? nlohmann::json(p.forced->growth) : nlohmann::json());
      s.push_back(p.forced && p.forced->stable);
      f.push_back(p.normal_force ? nlohmann::json(*p.normal_force) : nlohmann::json());
    }
    growth.push_back(g);
    stable.push_back(s);
    force.push_back(f);
  }
  for (const auto& k : map.rule())
    rule.push_back(k ? nlohmann::json(k->point->feedback) : nlohmann::json());
  return {{"speeds", map.speeds}, {"feedbacks", map.feedbacks}, {"growth", growth},
          {"stable", stable},     {"normal_force", force},      {"rule", rule}};
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

std::string feedback_map_table(const std::string& name, const rub::FeedbackMap& map) {
  std::string text = fmt::format(
      "{}: cross-coupled feedback k, by the eigenvalues of the forced rub\n\n"
      "   speed         k   stable from      to      decay     force\n"
      "      Hz     N s/m         N s/m   N s/m        1/s         N\n",
      scene::printable(name));
  const auto rule = map.rule();
  for (std::size_t i = 0; i < map.speeds.size(); ++i) {
    text += fmt::format("{:>8}", short_number(kHz * map.speeds[i]));
    if (!rule[i]) {
      text += "      none   no forced rub is stable\n";
      continue;
    }
    const rub::FeedbackPoint& p = *rule[i]->point;
    text += fmt::format("{:>10}{:>14}{:>8}{:>11}{:>10}{}\n", short_number(p.feedback),
                        short_number(rule[i]->from), short_number(rule[i]->to),
                        short_number(-p.forced->growth), short_number(*p.normal_force),
                        p.whip ? "  beside a whip" : "");
  }
  const std::string keys = feedback_keys(map);
  if (!keys.empty()) text += "\nIn [controller]:\n" + keys;
  return text;
}

}  // namespace rotorub
