#include "compare/modes/rub_result.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/modes/answers.h"
#include "compare/modes/periodic_rubs_text.h"
#include "compare/modes/whirl_tables.h"

namespace rotorub {
namespace {

using nlohmann::json;
using result::column_adder, result::Data, result::Item, result::line, result::number, result::Part;
using result::Role, result::Section, result::Sentence, result::Table;
using rub::RubPoint, rub::StandingRub;

// A number, or the values of the scene's friction table.
json friction_json(const FrictionLaw& law) {
  if (law.is_constant()) return law.coefficient;
  return {{"static", law.sticking()},
          {"kinetic", law.coefficient},
          {"stribeck_speed", law.stribeck_speed},
          {"viscous", law.viscous}};
}

Item stable_item(const rub::Stability& stability, const std::string& more = "") {
  return {stability.stable, (stability.stable ? "  stable" : "  unstable") + more,
          stability.stable ? Tone::kGood : Tone::kBad};
}

// Marks the rows of rubs whose whirl is faster than the modes kept.
void mark_above_modes(Table& table, const auto& rubs, const RubAnalysis& analysis) {
  for (std::size_t k = 0; k < rubs.size(); ++k) {
    if (analysis.is_above_modes(rubs[k].rub.whirl)) table.rows[k].lead = "* ";
  }
}

// A sentence on the marked rubs, without a full stop; empty if none is marked.
std::string above_modes_note(const RubAnalysis& analysis) {
  std::vector<double> whirls;
  const auto look_at = [&](const auto& rubs) {
    for (const auto& r : rubs) {
      if (analysis.is_above_modes(r.rub.whirl)) whirls.push_back(r.rub.whirl);
    }
  };
  look_at(analysis.point.rubs);
  look_at(analysis.rolling);
  if (whirls.empty()) return "";
  const double highest = whirls.front() < 0.0 ? analysis.band->backward : analysis.band->forward;
  const bool several = whirls.size() > 1;
  return fmt::format(
      "the whirl{0} of the rub{0} marked * {1} faster than the highest mode kept ({2} rad/s, {3} "
      "Hz), so {4} not reliable; raise rotor.modes and compare",
      several ? "s" : "", several ? "are" : "is", grouped(highest), grouped(highest * kHz),
      several ? "their forces are" : "its force is");
}

Table rubs_table(const std::vector<StandingRub>& rubs) {
  Table table{.place = "rubs/#/{column}"};
  const auto add = column_adder(table, rubs);
  add({"kind", "rub", -12}, [](auto& r) { return Item{rub::to_string(r.rub.kind)}; });
  // On a page in Hz.
  const auto add_speed = [&](const char* key, const char* in_si, const char* in_hz, int width,
                             const auto& speed) {
    add({key, in_si, width, result::kNotPage}, [&](auto& r) { return Item{speed(r)}; });
    add({"", in_hz, width, result::kPage},
        [&](auto& r) { return Item{.text = short_number(speed(r) * kHz)}; });
  };
  add_speed("whirl", "whirl rad/s", "whirl / Hz", 13, [](auto& r) { return r.rub.whirl; });
  add({"normal_force", "force / N", 12}, [](auto& r) { return Item{r.rub.normal_force}; });
  add({"friction", "friction/normal", 17}, [](auto& r) { return number(r.rub.friction, 4); });
  add({"growth_rate", "growth 1/s", 12}, [](auto& r) { return number(r.stability.growth, 4); });
  add_speed("frequency", "oscillates at rad/s", "oscillates at / Hz", 21,
            [](auto& r) { return r.stability.frequency; });
  add({"stable"}, [](auto& r) {
    return stable_item(r.stability, r.rub.ring_speed == 0.0
                                        ? ""
                                        : fmt::format(", ring at {:.6g} rad/s", r.rub.ring_speed));
  });
  add({.key = "slip", .seen = result::kJson}, [](auto& r) { return Item{r.rub.slip}; });
  add({.key = "ring_speed", .seen = result::kJson}, [](auto& r) { return Item{r.rub.ring_speed}; });
  return table;
}

std::string orbit_text(const RubPoint& point) {
  if (!point.orbit) return "free orbit: not a circle, because the loads have several frequencies";
  const double share = *point.orbit / point.clearance;
  std::string text = fmt::format("free orbit: {:.4g} clearances", share);
  if (!(share < 1.0)) return text + ", so contact is unavoidable";
  return text + (point.free.stable
                     ? ", stable"
                     : fmt::format(", unstable (grows at {:.4g} 1/s)", point.free.growth));
}

std::string rolling_text(const RubPoint& point) {
  std::vector<std::string> ranges;
  for (const auto& [from, to] : point.rolling_ranges) {
    ranges.push_back(std::isfinite(to) ? fmt::format("{:.7g} to {:.7g}", from, to)
                                       : fmt::format("above {:.7g}", from));
  }
  if (ranges.empty()) return "Friction is too low for backward rolling at any speed.";
  return fmt::format("Friction can sustain backward rolling at whirl speeds of {} rad/s.",
                     fmt::join(ranges, ", "));
}

// All of a point but its rubs, which stand above.
std::vector<Part> point_parts(const RubPoint& point) {
  std::vector<Part> parts{Data{"speed", point.speed},
                          Data{"friction", friction_json(point.friction)},
                          Data{"free_orbit", number_or_null(point.orbit)},
                          Data{"free_growth_rate", number_or_null(point.free.growth)},
                          Data{"rolling_ranges", ranges_json(point.rolling_ranges)},
                          Data{"attractors", attractor_names(point.attractors())},
                          Sentence{.text = orbit_text(point), .lead = "  "},
                          Sentence{.text = rolling_text(point), .lead = "  "},
                          line("  attractors: " + attractors_text(point.attractors()))};
  if (point.rubs.empty()) parts.insert(parts.begin(), line("  none"));
  return parts;
}

// The same rubs with the spin free, and the rolling that the motor sustains.
std::vector<Part> driven_parts(const RubAnalysis& analysis) {
  if (analysis.driven.empty() && analysis.rolling.empty()) return {};
  std::vector<StandingRub> rubs = analysis.point.rubs;
  rubs.resize(analysis.driven.size());
  for (std::size_t k = 0; k < rubs.size(); ++k) rubs[k].stability = analysis.driven[k];
  Table driven = rubs_table(rubs);
  mark_above_modes(driven, rubs, analysis);
  driven.place = "driven/#/{column}";
  for (result::Column& column : driven.columns) {
    column.title = std::exchange(column.heading, "");
    if (column.key != "growth_rate" && column.key != "frequency" && column.key != "stable")
      column.key.clear();
  }
  Table rolling{.place = "driven_rolling/#/{column}"};
  const auto add = column_adder(rolling, analysis.rolling);
  add({"speed", "spin rad/s", 12}, [](auto& r) { return number(r.speed, 6); });
  add({"whirl", "whirl rad/s", 13}, [](auto& r) { return Item{r.rub.whirl}; });
  add({"normal_force", "force / N", 12}, [](auto& r) { return Item{r.rub.normal_force}; });
  add({"friction", "friction/normal", 17}, [](auto& r) { return number(r.rub.friction, 4); });
  add({"torque", "torque / Nm", 12}, [](auto& r) { return Item{r.torque}; });
  add({"growth_rate", "growth 1/s", 12}, [](auto& r) { return number(r.stability.growth, 4); });
  add({"frequency", "oscillates at rad/s", 21},
      [](auto& r) { return Item{r.stability.frequency}; });
  add({"stable"}, [](auto& r) { return stable_item(r.stability); });
  mark_above_modes(rolling, analysis.rolling, analysis);
  // Without rows, an empty list in JSON alone.
  rolling.seen = analysis.rolling.empty() ? result::kJson : result::kAll;
  std::vector<Part> parts;
  if (!analysis.driven.empty())
    parts.emplace_back(
        line("\nthe same with torsion and a spin speed that is free to change", Role::kHeading));
  parts.emplace_back(driven);
  if (!analysis.rolling.empty())
    parts.emplace_back(
        line("\nbackward rolling at a speed that the motor sustains", Role::kHeading));
  parts.emplace_back(rolling);
  return parts;
}

// Why there are no lasting rubs.
Sentence refusal(const std::string& reason) {
  return {.text = reason, .lead = "lasting rubs: ", .indent = 2};
}

}  // namespace

// The lasting rubs of every contact, below the place of each speed.
std::vector<Part> rubs_parts(const RotorAnalysis& analysis) {
  if (analysis.rubs.empty()) return {};
  std::vector<Part> parts{Data{"rub_refused", text_or_null(analysis.rubs.front().refused)}};
  // A reason that applies to every contact is given once.
  const bool same_refusal = !analysis.rubs.front().refused.empty() &&
                            std::ranges::all_of(analysis.rubs, [&](const RubAnalyses& rubs) {
                              return rubs.refused == analysis.rubs.front().refused;
                            });
  for (std::size_t k = 0; k < analysis.rubs.size(); ++k) {
    const RubAnalyses& rubs = analysis.rubs[k];
    const bool several = !rubs.contact.empty();
    if (several && !same_refusal)
      parts.emplace_back(
          line(fmt::format("\ncontact \"{}\", the others open", rubs.contact), Role::kHeading));
    for (std::size_t at = 0; at < rubs.at.size(); ++at) {
      Section rub = rub_result(rubs.at[at]);
      if (several && k == 0) {
        // The first contact also stands at the place of a single one.
        parts.emplace_back(Section{fmt::format("speeds/{}/rub", at), rub.parts, result::kJson});
      }
      rub.place = several ? fmt::format("speeds/{}/contacts/{}/rub", at, k)
                          : fmt::format("speeds/{}/rub", at);
      parts.insert(parts.end(), {line(""), std::move(rub)});
    }
    if (!rubs.refused.empty() && !same_refusal)
      parts.insert(parts.end(), {line(""), refusal(rubs.refused)});
  }
  if (same_refusal) parts.insert(parts.end(), {line(""), refusal(analysis.rubs.front().refused)});
  const auto is_refused = [](const RubAnalyses& rubs) { return !rubs.refused.empty(); };
  if (analysis.periodic_rubs) {
    parts.emplace_back(periodic_rubs_result(*analysis.periodic_rubs));
  } else if (std::ranges::any_of(analysis.rubs, is_refused)) {
    parts.emplace_back(
        Sentence{.text = "  --periodic finds the periodic rub to which a run settles",
                 .wraps = false,
                 .seen = result::kTerminal});
  }
  return parts;
}

Section rub_point_result(const RubPoint& point) {
  Section section{.parts = {rubs_table(point.rubs)}};
  section.add(point_parts(point));
  return section;
}

Section rub_result(const RubAnalysis& analysis) {
  const RubPoint& point = analysis.point;
  const FrictionLaw& mu = point.friction;
  const auto name_of = [&](const WhirlMode& mode) { return sense_of(mode, point.speed); };
  Table ring = whirl_table("ring", analysis.ring, name_of),
        joined = whirl_table("joined", analysis.joined, name_of);
  ring.lead = joined.lead = "    ";
  Table rubs = rubs_table(point.rubs);
  mark_above_modes(rubs, point.rubs, analysis);
  Section section{.parts = {line(fmt::format("whirl of rotor and ring at {}, with the modes kept",
                                             speed_text(point.speed)),
                                 Role::kHeading)}};
  if (!analysis.ring.empty()) section.add({line("  ring alone", Role::kCaption)});
  section.add(
      {ring, line("  joined, the rotor's centre fixed to the ring's", Role::kCaption), joined});
  if (analysis.joined.empty()) section.add({line("    nothing can move")});
  section.add(
      {line(
           fmt::format("\nlasting rubs at {} with a friction of {:g}{}", speed_text(point.speed),
                       mu.sticking(),
                       mu.is_constant()
                           ? ""
                           : fmt::format(" at rest, then {:g} {:+g} exp(-(v / {:g})^2) {:+g} v",
                                         mu.coefficient, mu.excess, mu.stribeck_speed, mu.viscous)),
           Role::kHeading),
       std::move(rubs), Data{"left_out", text_or_null(analysis.left_out)},
       Data{"notes", json::array()}});
  if (const std::string note = above_modes_note(analysis); !note.empty())
    section.add({Sentence{.text = note, .lead = "  note: ", .indent = 2, .place = "notes/#"}});
  if (!analysis.left_out.empty())
    section.add({Sentence{.text = analysis.left_out, .lead = "  left out: "}});
  section.add(point_parts(point));
  section.add(driven_parts(analysis));
  return section;
}

}  // namespace rotorub
