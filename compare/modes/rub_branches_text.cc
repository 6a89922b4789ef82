#include "compare/modes/rub_branches_text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/units.h"

namespace rotorub {
namespace {

using nlohmann::ordered_json, nlohmann::json;
using periodic::PointKind;
using result::Item, result::line, result::number, result::Role;

ordered_json point_json(const RubOnBranch& at, const std::vector<std::string>& contacts) {
  const periodic::ContactFigures& f = at.rub.figures[at.rub.contact];
  const std::string& contact = contacts[at.rub.contact];
  const bool is_named = at.point != PointKind::kRegular;
  return {{"value", at.value},
          {"point", is_named ? ordered_json(to_string(at.point)) : ordered_json(nullptr)},
          {"kind", at.rub.kind},
          {"stable", at.rub.settled.motion.stable},
          {"multiplier", at.rub.largest_multiplier()},
          {"period", at.rub.settled.motion.period},
          {"whirl", f.whirl},
          {"mean_force", f.mean_force},
          {"largest_force", f.largest_force},
          {"largest_impulse", f.largest_impulse},
          {"impacts", f.impacts},
          {"contact_share", f.contact_share},
          {"stuck_share", f.stuck_share},
          {"amplitude", f.amplitude},
          {"contact", contact.empty() ? ordered_json(nullptr) : ordered_json(contact)}};
}

// Branches are counted from 1, as in the table.
json origin_json(const RubBranch& branch) {
  if (!branch.origin) return nullptr;
  return {{"branch", branch.origin->branch + 1}, {"value", branch.origin->value}};
}

json branches_json(const RubBranches& all) {
  json branches = json::array();
  for (const RubBranch& branch : all.branches) {
    json points = json::array();
    for (const RubOnBranch& at : branch.points)
      points.push_back(json(point_json(at, all.contacts)));
    branches.push_back({{"up", all.up ? json(branch.up) : json(nullptr)},
                        {"from", branch.from},
                        {"starts", branch.starts},
                        {"origin", origin_json(branch)},
                        {"order", branch.points.front().rub.settled.order},
                        {"ends", {branch.first_end, branch.last_end}},
                        {"points", points}});
  }
  return branches;
}

// A row of the table for people.
struct NamedPoint {
  const RubOnBranch* at;
  std::string point;
};

// The ends of a branch and its named points.
std::vector<NamedPoint> rows_of(const RubBranch& branch) {
  std::vector<NamedPoint> rows;
  for (std::size_t k = 0; k < branch.points.size(); ++k) {
    const RubOnBranch& at = branch.points[k];
    const bool is_named = at.point != PointKind::kRegular;
    const bool is_end = k == 0 || k + 1 == branch.points.size();
    if (is_named || is_end) rows.push_back({&at, is_named ? to_string(at.point) : "end"});
  }
  return rows;
}

// The value of a point. A branch ends next to an end of the range, which is meant.
double shown_value(const MapAxis& axis, double value) {
  constexpr double kBeside = 1e-4;  // of the range
  const auto [low, high] = std::ranges::minmax(axis.values);
  for (const double end : {low, high}) {
    if (std::abs(value - end) <= kBeside * (high - low)) return end;
  }
  return value;
}

result::Table branch_table(const RubBranches& all, const RubBranch& branch) {
  result::Table table;
  const std::vector<NamedPoint> rows = rows_of(branch);
  const auto add = column_adder(table, rows);
  const ShownUnit unit = shown_unit(all.across.unit);
  const auto main = [](const NamedPoint& r) -> const periodic::ContactFigures& {
    return r.at->rub.figures[r.at->rub.contact];
  };
  const std::string key = name_and_unit(all.across.key, unit.name);
  add({.heading = key, .width = std::max(12, static_cast<int>(key.size()) + 2)},
      [&](auto& r) { return number(shown_value(all.across, r.at->value), 7, unit.per_si); });
  add({.heading = "  point", .width = -18}, [](auto& r) { return Item{.text = "  " + r.point}; });
  add({.heading = "periodic rub", .width = -19},
      [](auto& r) { return Item{.text = r.at->rub.kind}; });
  add({.heading = "force / N", .width = 11},
      [&](auto& r) { return number(main(r).mean_force, 6); });
  add({.heading = "multiplier", .width = 12},
      [](auto& r) { return number(r.at->rub.largest_multiplier(), 5); });
  add({}, [](auto& r) {
    return Item{.text = r.at->rub.settled.motion.stable ? "  stable" : "  unstable"};
  });
  table.seen = result::kPeople;
  return table;
}

// "rotor.speed = 50 Hz"
std::string value_text(const MapAxis& axis, double value) {
  const ShownUnit unit = shown_unit(axis.unit);
  return fmt::format("{} = {:.6g}{}{}", axis.key, value * unit.per_si, unit.name.empty() ? "" : " ",
                     unit.name);
}

std::string title_of(const RubBranches& all, const RubBranch& branch, std::size_t number) {
  std::string text = fmt::format("branch {}", number);
  if (all.up) text += ", " + value_text(*all.up, branch.up);
  const int order = branch.points.front().rub.settled.order;
  if (order > 1) text += fmt::format(", sub-harmonic 1/{}", order);
  if (branch.origin) {
    text += fmt::format(", from the period doubling of branch {} at {}", branch.origin->branch + 1,
                        value_text(all.across, branch.origin->value));
  }
  return text;
}

}  // namespace

result::Section rub_branches_result(const std::string& name, const RubBranches& all) {
  result::Section section{
      .parts = {line(fmt::format("{}: branches of periodic rubs over {}", name, all.across.key),
                     Role::kHeading)}};
  for (std::size_t k = 0; k < all.branches.size(); ++k) {
    const RubBranch& branch = all.branches[k];
    section.add({line("\n" + title_of(all, branch, k + 1), Role::kCaption),
                 branch_table(all, branch),
                 result::Sentence{
                     .text = fmt::format("start: {}; ends: {}; {}", fmt::join(branch.starts, ", "),
                                         branch.first_end, branch.last_end),
                     .lead = "    "}});
  }
  if (all.branches.empty()) section.add({line("  none")});
  json without = json::array();
  for (const UnsettledValue& at : all.without) {
    without.push_back({{"value", at.value},
                       {"up", all.up ? json(at.up) : json(nullptr)},
                       {"start", at.start},
                       {"reason", at.why}});
  }
  if (!all.without.empty()) section.add({line("\nstarts without a periodic rub", Role::kCaption)});
  for (const UnsettledValue& at : all.without) {
    std::string where = value_text(all.across, at.value);
    if (all.up) where += ", " + value_text(*all.up, at.up);
    section.add({result::Sentence{.text = fmt::format("{}, from {}: {}", where, at.start, at.why),
                                  .lead = "  "}});
  }
  if (!all.sampling.empty()) section.add({result::Sentence{.text = all.sampling, .lead = "  "}});
  section.add(
      {result::Data{"rub_branches",
                    {{"across", axis_json(all.across)},
                     {"up", all.up ? axis_json(*all.up) : json(nullptr)},
                     {"branches", branches_json(all)},
                     {"without", without},
                     {"sampling", all.sampling.empty() ? json(nullptr) : json(all.sampling)}}}});
  return section;
}

std::string rub_branches_csv(const RubBranches& all) {
  std::string text = "branch,";
  if (all.up) text += all.up->key + ",";
  text += all.across.key;
  bool has_head = false;
  for (std::size_t k = 0; k < all.branches.size(); ++k) {
    for (const RubOnBranch& at : all.branches[k].points) {
      const ordered_json point = point_json(at, all.contacts);
      if (!std::exchange(has_head, true)) {
        for (const auto& [key, value] : point.items())
          if (key != "value") text += "," + key;
        text += "\n";
      }
      text += fmt::format("{},", k + 1);
      if (all.up) text += fmt::format("{},", all.branches[k].up);
      for (bool first = true; const auto& [key, value] : point.items()) {
        if (!std::exchange(first, false)) text += ",";
        if (value.is_number_float()) {
          text += fmt::format("{}", value.get<double>());
        } else if (!value.is_null()) {
          text += value.is_string() ? value.get<std::string>() : value.dump();
        }
      }
      text += "\n";
    }
  }
  return text + (has_head ? "" : "\n");
}

}  // namespace rotorub
