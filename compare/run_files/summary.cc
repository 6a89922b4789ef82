#include "compare/run_files/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "compare/base/columns.h"
#include "compare/base/format.h"
#include "compare/base/json.h"
#include "compare/base/units.h"
#include "compare/base/version.h"
#include "compare/figures/figure.h"
#include "compare/metrics/above_modes.h"
#include "compare/run_files/doubts.h"
#include "native_model/rotor/mode_truncation.h"
#include "native_model/scene/reader.h"
#include "native_model/scene/text.h"

namespace rotorub {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

// At the end of the run, not a mean as a metric would be.
constexpr const char* kRingSpeed = "ring_speed";

// Keys besides the metrics. compare/study/README.md says in which runs contact_mass and above_modes
// are null and contacts is absent.
constexpr ColumnMeaning kSummaryKeys[] = {
    {"program", "", "rotorub", ""},
    {"version", "", "version of the program", ""},
    {"mujoco_version", "", "version of MuJoCo", ""},
    {"scene", "", "name of the scene", ""},
    {"scene_hash", "", "of the scene's text with its overrides", ""},
    {"engine", "", "native or mujoco", ""},
    {"integrator", "", "integrator of the engine", ""},
    {"contact_model", "", "rigid, coulomb, cone or cone-coulomb", ""},
    {"contact_mass.kept", "kg", "effective mass at the contact with the modes kept", ""},
    {"contact_mass.mesh", "kg", "the same with all modes of the mesh", ""},
    {"contact_mass.kept_modes", "", "number of modes", ""},
    {"contact_mass.mesh_modes", "", "number of modes", ""},
    {"above_modes.highest_forward", "rad/s", "fastest whirl of the modes kept", ""},
    {"above_modes.highest_backward", "rad/s", "fastest whirl of the modes kept", ""},
    {"above_modes.contact_share", "",
     "share of the contact time or friction work with faster whirl", ""},
    {"above_modes.friction_share", "",
     "share of the contact time or friction work with faster whirl", ""},
    {"above_modes.fastest_whirl", "rad/s", "fastest whirl in contact, forward positive", ""},
    {kRingSpeed, "rad/s", "the ring's own spin speed at the end", "a ring that turns"},
    {"contacts[].name", "", "name of the contact", ""},
    {"contacts[].first_touch", "s", "for this contact", ""},
    {"contacts[].whirl_time", "s", "for this contact", ""},
    {"contacts[].contact_time", "s", "its time in contact, counted as in contact_fraction", ""},
    {"contacts[].impulse_total", "N s", "for this contact", ""},
    {"contacts[].friction_impulse", "N s", "for this contact", ""},
    {"contacts[].friction_work", "J", "for this contact", ""},
    {"contacts[].least_gap", "m", "for this contact", ""},
    {"contacts[].max_penetration", "m", "for this contact", ""},
    {"contacts[].impacts", "", "for this contact", ""},
    {"contacts[].forward_passes", "", "for this contact", ""},
    {"contacts[].backward_passes", "", "for this contact", ""},
    {"status", "",
     "ok, diverged, no_solution, ambiguous, step_too_large, out_of_range, controller_failed or "
     "interrupted",
     ""},
    {"message", "", "why the status is not ok", ""},
    {"warnings", "", "probable mistakes, or a failed energy balance", ""},
};

// One entry per contact if there are several.
json contacts_json(const scene::Scene& scene, const Trajectory& trajectory) {
  json all = json::array();
  for (std::size_t k = 0; k < trajectory.statistics.contacts.size(); ++k) {
    const ContactStatistics& s = trajectory.statistics.contacts[k];
    const auto impacts = std::count_if(
        trajectory.impacts.begin(), trajectory.impacts.end(),
        [k](const Impact& i) { return static_cast<std::size_t>(i.contact) == k && counts(i); });
    all.push_back({{"name", scene.name_of(k)},
                   {"first_touch", s.first_touch < 0.0 ? json() : json(s.first_touch)},
                   {"contact_time", s.contact_time},
                   {"impulse_total", s.impulse_total},
                   {"friction_impulse", s.friction_impulse},
                   {"friction_work", s.friction_work},
                   {"impacts", impacts},
                   {"least_gap", s.least_gap},
                   {"max_penetration", s.max_penetration},
                   {"forward_passes", s.passes.forward()},
                   {"backward_passes", s.passes.backward()},
                   {"whirl_time", s.passes.time()}});
  }
  return all;
}

// null in modal form or without a contact.
json above_modes_json(const std::optional<AboveModes>& above) {
  if (!above) return nullptr;
  return {{"highest_forward", above->band.forward},
          {"highest_backward", above->band.backward},
          {"contact_share", above->contact_share},
          {"friction_share", above->friction_share},
          {"fastest_whirl", above->fastest}};
}

// mass, above, warnings: contact_mass, above_modes and doubts of the run, whose eigenproblems take
// a while.
json written(const scene::Scene& scene, const Trajectory& trajectory,
             const std::optional<ContactMass>& mass, const std::optional<AboveModes>& above,
             const std::vector<std::string>& warnings) {
  json all = run_numbers_json(scene, trajectory);
  all.update({{"program", "rotorub"},
              {"version", program_version()},
              {"mujoco_version", mujoco_version()},
              {"scene", scene.name},
              {"scene_hash", scene::scene_hash(scene)},
              {"engine", trajectory.engine},
              {"integrator", trajectory.integrator},
              {"contact_model", trajectory.contact_model},
              {"contact_mass", contact_mass_json(mass)},
              {"above_modes", above_modes_json(above)},
              {"status", to_string(trajectory.status)},
              {"message", trajectory.message},
              {"warnings", warnings}});
  if (trajectory.contacts > 1) all["contacts"] = contacts_json(scene, trajectory);
  return all;
}

// The run and how it ended.
std::vector<result::Part> opening(const scene::Scene& scene, const Trajectory& t) {
  const std::string step = t.step > 0.0 ? "step " + time_text(t.step) : "adaptive steps";
  // In both units, because 3600 without a unit is read as rad/s, whatever the user meant.
  const double speed = scene.rotor.speed;
  const Tone tone = t.status == Status::kOk ? Tone::kGood : Tone::kBad;
  return {
      result::Table{.columns = std::vector<result::Column>(2),
                    .rows = {{.items = {{scene::printable(scene.name) + ": "},
                                        {to_string(t.status), "", tone}}}},
                    .lead = ""},
      result::line(fmt::format("  {} {}, contact {}, {}, {} of {} simulated", t.engine,
                               t.integrator, t.contact_model, step, time_text(t.end),
                               time_text(scene.run.end))),
      result::line(fmt::format("  rotor at {} rad/s, {} rpm{}", short_number(speed),
                               short_number(speed * kRpm), scene.drive ? " at its start" : ""))};
}

result::Table figures_table(const Metrics& m, const Trajectory& t) {
  result::Table table{.columns = {{"", "", -29}, {"", "", 9}}};
  const auto add = [&](const std::string& label, const std::string& value) {
    table.rows.push_back({.items = {{label}, {value}}});
  };
  if (m.first_touch) add("first touch, ms", short_number(kMilli * *m.first_touch));
  // Without a contact, the figures of contact are 0, and their rows are left out.
  for (const Figure& f : figures()) {
    const double value = f.value(m);
    if (has_figure(m, f) && (m.first_touch || value != 0.0)) {
      add(figure_label(f), figure_value(f, value));
    }
  }
  add("settles to", to_string(m.settled.attractor));
  add("steps", fmt::format("{}", t.steps));
  add("computing time per step, µs", short_number(m.us_per_step));
  return table;
}

// The figures of each of several contacts; the JSON has more of them.
std::vector<result::Part> contacts_table(const scene::Scene& scene, const Trajectory& t) {
  if (t.contacts < 2) return {};
  const json all = contacts_json(scene, t);
  result::Table table;
  const auto add = result::column_adder(table, all);
  add({.heading = "contact", .width = -14},
      [](const json& c) { return result::Item{scene::printable(c["name"].get<std::string>())}; });
  const auto number = [&](const char* heading, const auto& value) {
    const int width = static_cast<int>(std::string_view(heading).size()) + 3;
    add({.heading = heading, .width = width}, [&](const json& c) {
      const json found = value(c);
      return result::Item{.text = found.is_null() ? "-" : short_number(found.get<double>())};
    });
  };
  number("first touch, ms", [](const json& c) {
    return c["first_touch"].is_null() ? json() : json(kMilli * c["first_touch"].get<double>());
  });
  number("mean force, N", [&](const json& c) {
    if (c["first_touch"].is_null()) return json();
    return json(c["impulse_total"].get<double>() / (t.end - c["first_touch"].get<double>()));
  });
  number("impulse, N s", [](const json& c) { return c["impulse_total"]; });
  number("impacts", [](const json& c) { return c["impacts"]; });
  return {result::line("\nat each contact", result::Role::kCaption), table};
}

// Notes if the omitted modes affect the effective mass of rigid impacts, or if the whirl is faster
// than the modes can follow. touched: whether the rotor touches the ring in the run.
std::vector<result::Part> mode_notes(const std::optional<ContactMass>& mass,
                                     const std::optional<AboveModes>& above, bool touched) {
  std::vector<result::Part> notes;
  const auto add = [&](std::string text) {
    notes.emplace_back(result::Sentence{std::move(text), "  note: ", 2});
  };
  if (mass && mass->truncated() && touched) {
    add(fmt::format(
        "the effective mass at the contact is {} kg with {} of the shaft's modes, and {} kg with "
        "all "
        "{} of its mesh, so sizes and numbers of impacts depend on rotor.modes; the mean force "
        "hardly does",
        short_number(mass->kept), mass->kept_modes, short_number(mass->mesh), mass->mesh_modes));
  }
  if (above && above->matters()) {
    add(fmt::format(
        "in {} of the time in contact, with {} of the friction work, the whirl is faster than the "
        "highest mode kept ({} Hz), up to {} Hz. The modes kept cannot bend as fast as that; keep "
        "higher modes (rotor.modes), or read the figures as results for the modes kept",
        percent_text(std::round(1e3 * above->contact_share) / 1e3),
        percent_text(std::round(1e3 * above->friction_share) / 1e3),
        short_number(kHz * (above->fastest > 0.0 ? above->band.forward : above->band.backward)),
        short_number(kHz * above->fastest)));
  }
  return notes;
}

}  // namespace

json run_numbers_json(const scene::Scene& scene, const Trajectory& trajectory) {
  const Metrics m = metrics(trajectory, contact_facts(scene));
  json all = metrics_json(m);
  for (const Figure& f : figures()) {
    if (!has_figure(m, f)) all[f.key] = nullptr;
  }
  // rad/s, at the end of the run, for a ring that turns.
  if (trajectory.has(kRingSpeed) && trajectory.rows() > 0) {
    all[kRingSpeed] = trajectory.column(kRingSpeed).back();
  }
  return all;
}

json summary_json(const scene::Scene& scene, const Trajectory& trajectory) {
  return written(scene, trajectory, contact_mass(scene), above_modes(scene, trajectory),
                 doubts(scene, trajectory));
}

std::string rub_answer(const Metrics& m, std::optional<double> cut) {
  if (!m.first_touch && cut)
    return fmt::format("no contact up to {} ms, where the run stopped",
                       short_number(kMilli * *cut));
  if (!m.first_touch) {
    if (!m.least_gap) return "no, rotor and ring do not touch";
    return fmt::format("no, the rotor stays {} µm clear of the ring",
                       short_number(kMicro * *m.least_gap));
  }
  std::string text = fmt::format("yes, from {} ms", short_number(kMilli * *m.first_touch));
  if (m.hard_impacts > 0)
    text += fmt::format(": {} hard impact{}", m.hard_impacts, m.hard_impacts > 1 ? "s" : "");
  const Attractor last = m.settled.attractor;
  if (last == Attractor::kNoContact) {
    text += ", without contact at the end";
  } else if (last != Attractor::kUnknown) {
    text += fmt::format(", {} in the last fifth of the run", described(m.settled));
  }
  return text + fmt::format("; mean normal force {} N", short_number(m.mean_force));
}

result::Section run_result(const scene::Scene& scene, const Trajectory& t) {
  const std::vector<ContactFacts> contacts = contact_facts(scene);
  const Metrics m = metrics(t, contacts);
  const std::optional<ContactMass> mass = contact_mass(scene);
  const std::optional<AboveModes> above = above_modes(scene, t);
  const std::vector<std::string> warnings = doubts(scene, t);
  result::Section told{.parts = {result::Data{"", written(scene, t, mass, above, warnings)}}};
  told.add(opening(scene, t));
  if (!t.message.empty()) told.add({result::Sentence{t.message, "  "}});
  for (const std::string& doubt : warnings) told.add({result::Sentence{doubt, "  warning: "}});
  if (!contacts.empty()) {
    const auto cut = t.status == Status::kOk ? std::optional<double>() : t.end;
    told.add({result::Sentence{rub_answer(m, cut), "  rubs: "}});
  }
  told.add({figures_table(m, t)});
  told.add(contacts_table(scene, t));
  told.add(mode_notes(mass, above, m.first_touch.has_value()));
  return told;
}

std::span<const ColumnMeaning> summary_keys() {
  static const std::vector<ColumnMeaning> keys = [] {
    std::vector<ColumnMeaning> all(std::begin(kSummaryKeys), std::end(kSummaryKeys));
    std::copy_if(metric_keys().begin(), metric_keys().end(), std::back_inserter(all),
                 [](const ColumnMeaning& k) { return k.name != kRingSpeed; });
    for (const Figure& f : figures()) {
      const auto key =
          std::find_if(all.begin(), all.end(), [&](const auto& k) { return k.name == f.key; });
      if (f.by_step) key->present = "a fixed step";
    }
    return all;
  }();
  return keys;
}

ordered_json run_columns_json(const Trajectory& trajectory) {
  std::vector<ColumnMeaning> series;
  for (const Column& c : trajectory.series)
    series.push_back({c.name, c.unit, series_column(c.name).meaning, ""});
  return {{"series.csv", columns_json(series)},
          {"impacts.csv", columns_json(impact_columns(trajectory.contacts > 1))},
          {"events.csv", columns_json(event_columns(trajectory.contacts > 1))},
          {"keyphasor.csv", columns_json(keyphasor_columns())},
          {"summary.json", columns_json(summary_keys())}};
}

}  // namespace rotorub
