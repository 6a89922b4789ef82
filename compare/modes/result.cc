#include "compare/modes/result.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/modes/levitation_text.h"
#include "compare/modes/periodic_rubs_text.h"
#include "compare/modes/response_text.h"
#include "compare/modes/summary_text.h"

namespace rotorub {
namespace {

using nlohmann::json;
using result::column_adder, result::Data, result::Item, result::line, result::number, result::Part;
using result::Role, result::Section, result::Sentence, result::Table;
using rub::RubPoint, rub::StandingRub;

json text_or_null(const std::string& text) { return text.empty() ? json(nullptr) : json(text); }

// The ranges as pairs, with null for an end at infinity.
template <class Ranges>
json ranges_json(const Ranges& ranges) {
  json all = json::array();
  for (const auto& [from, to] : ranges) all.push_back({from, number_or_null(to)});
  return all;
}

// ---------------------------------------------------------------- whirl of the free rotor
// The list {"frequency", "damping_ratio"}, for people with the name of each mode. On the terminal
// only the first table has headings.
template <class NameOf>
Table whirl_table(const std::string& place, const std::vector<WhirlMode>& modes,
                  const NameOf& name_of, bool headed = false) {
  constexpr double kRoundOff = 1e-9;  // damping ratio of an undamped mode
  Table table{.place = place + "/#/{column}"};
  const auto add = column_adder(table, modes);
  add({.width = -14, .title = "whirl"}, [&](auto& m) { return Item{.text = name_of(m)}; });
  add({.key = "frequency", .width = 14, .title = "rad/s"}, [](auto& m) {
    return Item{m.frequency, fmt::format("{:.7g}", std::abs(m.frequency))};
  });
  add({.width = 14, .title = "Hz"}, [](auto& m) { return number(std::abs(m.frequency), 7, kHz); });
  add({.key = "damping_ratio", .width = 16, .title = "damping ratio"},
      [](auto& m) { return number(m.damping_ratio, 4); });
  for (result::Column& column : table.columns) {
    if (headed) column.heading = column.title;
  }
  add({.seen = result::kPage}, [&](auto& m) {
    return m.damping_ratio < -kRoundOff ? Item{.text = "grows", .tone = Tone::kBad} : Item{};
  });
  return table;
}

// The response at a contact, in JSON null without it.
Part response_part(const RotorAnalysis& analysis, std::size_t at, std::size_t bearing) {
  const auto place = std::ranges::find(analysis.contacts, bearing, &ContactPlace::bearing);
  if (place == analysis.contacts.end()) return Data{"response", nullptr};
  return response_section(*place, analysis.responses[at], analysis.spectra[at].speed);
}

// The results at one speed, without its rubs.
Section speed_section(const RotorAnalysis& analysis, std::size_t at) {
  const auto& [speed, modes] = analysis.spectra[at];
  const auto name_of = [speed = speed](const WhirlMode& mode) { return sense_of(mode, speed); };
  const std::string at_speed = "at " + speed_text(speed);
  Sentence above = line("\n" + at_speed);
  above.seen = result::kTerminal;
  Section section{
      "speeds/#",
      {Data{"speed", speed}, Data{"rub", nullptr}, std::move(above),
       Sentence{.text = "Whirl " + at_speed, .seen = result::kPage, .role = Role::kHeading},
       whirl_table("modes", modes, name_of, true)}};
  if (!analysis.levitations.empty() && has_poles(analysis.levitations[at]))
    section.add(
        {line("  This table leaves out integrators, filters, amplifiers and sampling. The "
              "poles below include them.")});
  const bool several = analysis.rubs.size() > 1;
  section.add(
      {Section{"", {response_part(analysis, at, 0)}, several ? result::kJson : result::kAll}});
  for (std::size_t k = 0; several && k < analysis.rubs.size(); ++k) {
    const RubAnalyses& rubs = analysis.rubs[k];
    section.add({Section{"contacts/#",
                         {Data{"name", rubs.contact}, response_part(analysis, at, k),
                          Data{"rub", nullptr}, Data{"rub_refused", text_or_null(rubs.refused)}}}});
  }
  section.add({Data{"notes", json::array()}, Data{"levitation", nullptr}});
  if (analysis.responses.empty()) return section;
  for (const std::string& note : analysis.responses[at].notes())
    section.add({Sentence{.text = note, .lead = "  note: ", .indent = 2, .place = "notes/#"}});
  if (has_loop(analysis.levitations[at]))
    section.add({levitation_section(speed, analysis.levitations[at])});
  return section;
}

std::vector<Part> torsion_parts(const RotorAnalysis& analysis) {
  std::vector<Part> parts{
      whirl_table("torsion", analysis.torsion, [](const WhirlMode&) { return "torsion"; })};
  if (!analysis.torsion.empty())
    parts.insert(parts.begin(),
                 line(fmt::format("\ntorsion, elastic modes{}",
                                  analysis.motor_is_held ? ", with the motor's end held" : ""),
                      Role::kHeading));
  return parts;
}

// The number of critical speeds that the terminal lists: those up to a few times the fastest speed
// of the analysis and the next one, and at least the first five.
std::size_t listed(const RotorAnalysis& analysis) {
  constexpr double kFew = 3.0;
  constexpr std::size_t kFirst = 5;
  double fastest = 0.0;
  for (const WhirlSpectrum& s : analysis.spectra) fastest = std::max(fastest, std::abs(s.speed));
  const auto next = std::ranges::find_if(analysis.critical_speeds,
                                         [&](double speed) { return std::abs(speed) > fastest; });
  std::size_t count = next == analysis.critical_speeds.end() ? 0 : 1;
  count += static_cast<std::size_t>(next - analysis.critical_speeds.begin());
  while (count < analysis.critical_speeds.size() &&
         std::abs(analysis.critical_speeds[count]) <= kFew * fastest) {
    ++count;
  }
  return std::max(count, std::min(kFirst, analysis.critical_speeds.size()));
}

// The critical speeds that unbalance excites; with isotropic planes it cannot drive backward whirl.
std::vector<Part> critical_parts(const RotorAnalysis& analysis) {
  Table table{
      .place = "critical/#/{column}", .columns = {{"speed"}, {"whirl"}}, .seen = result::kNotPage};
  const std::size_t count = listed(analysis);
  for (std::size_t k = 0; k < analysis.critical_speeds.size(); ++k) {
    const double speed = analysis.critical_speeds[k];
    const std::string whirl = to_string(analysis.critical_senses[k]);
    const auto seen = k < count ? result::kAll : result::kJson;
    const bool beyond = analysis.table_end > 0.0 && speed > analysis.table_end;
    table.rows.push_back(
        {.items = {{speed, speed_text(speed) + ", "},
                   {whirl, whirl + (beyond ? " (beyond the bearings' tables, so their last values "
                                             "are used)"
                                           : "")}},
         .seen = seen});
  }
  Table on_page{.seen = result::kPage};
  const auto add = column_adder(on_page, analysis.critical_speeds);
  add({.heading = "rpm", .width = 14}, [](double speed) { return number(speed, 7, kRpm); });
  add({.heading = "Hz", .width = 14}, [](double speed) { return number(speed, 7, kHz); });
  add({.heading = "rad/s", .width = 14}, [](double speed) { return number(speed, 7); });
  on_page.columns.push_back({.heading = "whirl"});
  for (std::size_t k = 0; k < table.rows.size(); ++k)
    on_page.rows[k].items.push_back(table.rows[k].items[1]);
  std::vector<Part> parts{
      Data{"critical_speeds", analysis.critical_speeds},
      line(fmt::format("\ncritical speeds that unbalance excites, undamped, up to {} rpm",
                       grouped(analysis.critical_bound * kRpm)),
           Role::kHeading),
      table, on_page};
  if (table.rows.empty()) parts.emplace_back(line("  none"));
  if (const std::size_t left = table.rows.size() - count; left > 0) {
    Sentence rest = line(fmt::format("  and {} higher critical speed{}, which --json prints", left,
                                     left > 1 ? "s" : ""));
    rest.seen = result::kTerminal;
    parts.emplace_back(std::move(rest));
  }
  return parts;
}

// Where the closed loop of magnetic bearings is unstable or unknown at a speed, this replaces the
// stability of the whirl, which leaves out parts of the controls.
std::vector<Part> stability_lines(const RotorAnalysis& analysis) {
  std::vector<std::string> sentences;
  bool has_control = false;
  for (std::size_t k = 0; k < analysis.levitations.size(); ++k) {
    if (!has_loop(analysis.levitations[k])) continue;
    has_control = true;
    const std::string text = instability_text(analysis.spectra[k].speed, analysis.levitations[k]);
    if (!text.empty() && (sentences.empty() || sentences.back() != text)) sentences.push_back(text);
  }
  if (sentences.empty()) {
    const std::string text = stability_text(analysis);
    sentences.push_back(
        has_control ? "Whirl without integrators, filters, amplifiers and sampling: " + text +
                          ". The poles include them."
                    : text);
  }
  std::vector<Part> parts{line("")};
  for (const std::string& sentence : sentences) parts.push_back(Sentence{.text = sentence});
  return parts;
}

std::vector<Part> stability_parts(const RotorAnalysis& analysis) {
  std::vector<Part> parts{
      Data{"stability_threshold", number_or_null(analysis.stability_threshold())},
      Data{"stability_bound", number_or_null(analysis.stability_bound)},
      Data{"unstable_ranges", ranges_json(analysis.unstable)}};
  for (Part& part : stability_lines(analysis)) parts.push_back(std::move(part));
  return parts;
}

std::vector<Part> contact_mass_parts(const std::optional<ContactMass>& mass) {
  const Data data{"contact_mass", contact_mass_json(mass)};
  if (!mass) return {data};
  return {data, line("\neffective mass at the contact", Role::kHeading),
          Sentence{.text = fmt::format(
                       "{:.4g} kg with the {} modes kept, {:.4g} kg with all {} of the mesh{}",
                       mass->kept, mass->kept_modes, mass->mesh, mass->mesh_modes,
                       mass->truncated() ? "; impacts are computed with the modes kept" : ""),
                   .lead = "  "}};
}

// ---------------------------------------------------------------- mode shapes
std::vector<double> list(const Eigen::VectorXd& values) { return {values.begin(), values.end()}; }

json plane_json(const PlaneShapes& plane) {
  json modes = json::array();
  for (Eigen::Index j = 0; j < plane.frequency.size(); ++j) {
    modes.push_back({{"frequency", plane.frequency[j]},
                     {"shape", list(plane.shape.col(j))},
                     {"at_stations", list(plane.at_stations.col(j))}});
  }
  return modes;
}

// 0 instead of a value that is written as 0.0000, so that it has no sign.
double without_round_off(double value) { return std::abs(value) < 5e-5 ? 0.0 : value; }

// The table divides a mode by this: 1, or the largest deflection if the mode has nearly a node at
// the contact.
double table_scale(const Eigen::VectorXd& shape) {
  constexpr double kNearNode = 10.0;  // largest deflection over the deflection at the contact
  Eigen::Index peak = 0;
  const double largest = shape.cwiseAbs().maxCoeff(&peak);
  return largest > kNearNode ? shape[peak] : 1.0;
}

// One column per mode: its frequency at rest, then its value at each station. In JSON the stations
// at the place, if there is one.
std::vector<Part> plane_parts(const std::string& title, const std::string& place,
                              const std::vector<Station>& stations, const PlaneShapes& plane) {
  constexpr Eigen::Index kColumns = 6;
  Table table{.place = place};
  const auto add = column_adder(table, stations);
  add({.key = "kind", .seen = result::kJson}, [](auto& s) { return Item{to_string(s.kind)}; });
  add({"name", "station", -20}, [](auto& s) { return Item{s.name}; });
  add({"z", "z / mm", 10}, [](auto& s) { return number(s.z, 5, kMilli); });
  for (Eigen::Index j = 0; j < plane.frequency.size(); ++j) {
    const Eigen::VectorXd shown = plane.at_stations.col(j) / table_scale(plane.shape.col(j));
    column_adder(table, shown)(
        {"", fmt::format("{:.5g} Hz", plane.frequency[j] * kHz), 13,
         j < kColumns ? result::kPeople : result::kPage},
        [](double value) { return Item{.text = fmt::format("{:.4f}", without_round_off(value))}; });
  }
  std::vector<Part> parts{
      line("\nmode shapes at rest, scaled to 1 at the contact (to a peak of 1 if the contact is "
           "near a node), " +
               title,
           Role::kHeading),
      table};
  const Eigen::Index left = plane.frequency.size() - kColumns;
  if (left > 0) {
    Sentence rest = line(fmt::format("  and {} higher modes, which --json prints", left));
    rest.seen = result::kTerminal;
    parts.emplace_back(std::move(rest));
  }
  return parts;
}

std::vector<Part> shapes_parts(const std::optional<ModeShapes>& shapes) {
  if (!shapes)
    return {Data{"mode_shapes", nullptr}, line("\nmode shapes: unknown, because the scene gives "
                                               "modes without a shaft; each mode is 1 at "
                                               "the contact")};
  const std::string stations = "stations/#/{column}";
  Section section{"mode_shapes",
                  {Data{"z", list(shapes->z)}, Data{"same_planes", shapes->same_planes},
                   Data{"x", plane_json(shapes->x)}, Data{"y", plane_json(shapes->y)}}};
  if (shapes->same_planes) {
    section.add(plane_parts("planes x and y alike", stations, shapes->stations, shapes->x));
  } else {
    section.add(plane_parts("plane x", stations, shapes->stations, shapes->x));
    section.add(plane_parts("plane y", "", shapes->stations, shapes->y));
  }
  return {section};
}

// ---------------------------------------------------------------- lasting rubs
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
      parts.emplace_back(line(fmt::format("\nlasting rubs: {}", rubs.refused)));
  }
  if (same_refusal)
    parts.emplace_back(line(fmt::format("\nlasting rubs: {}", analysis.rubs.front().refused)));
  const auto is_refused = [](const RubAnalyses& rubs) { return !rubs.refused.empty(); };
  if (analysis.periodic_rubs) {
    parts.emplace_back(periodic_rubs_result(*analysis.periodic_rubs));
  } else if (std::ranges::any_of(analysis.rubs, is_refused)) {
    Sentence hint = line("  --periodic finds the periodic rub to which a run settles");
    hint.seen = result::kTerminal;
    parts.emplace_back(std::move(hint));
  }
  return parts;
}

}  // namespace

Section modes_result(const std::string& name, const RotorAnalysis& analysis) {
  Sentence head = line(fmt::format("{}: whirl of the free rotor", name));
  head.seen = result::kTerminal;
  Section all{.parts = {std::move(head)}};
  all.add(summary_parts(analysis));
  for (std::size_t k = 0; k < analysis.spectra.size(); ++k) all.add({speed_section(analysis, k)});
  all.add(torsion_parts(analysis));
  all.add(critical_parts(analysis));
  all.add(stability_parts(analysis));
  all.add(contact_mass_parts(analysis.contact_mass));
  all.add(shapes_parts(analysis.shapes));
  all.add({Section{"", rubs_parts(analysis), result::kAll, "Lasting rubs", "rubs"}});
  return all;
}

std::string stability_text(const RotorAnalysis& analysis) {
  if (!analysis.unstable.empty()) {
    std::vector<std::string> ranges;
    for (const auto& [from, to] : analysis.unstable) {
      ranges.push_back(std::isinf(to)
                           ? "above " + speed_text(from)
                           : fmt::format("from {} to {} rpm ({} to {} rad/s)", grouped(from * kRpm),
                                         grouped(to * kRpm), grouped(from), grouped(to)));
    }
    return fmt::format("unstable {}", fmt::join(ranges, " and "));
  }
  if (std::isinf(analysis.stability_bound)) return "stable at all speeds";
  return "stable up to " + speed_text(analysis.stability_bound);
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
