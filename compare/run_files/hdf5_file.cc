#include "compare/run_files/hdf5_file.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "compare/figures/figure.h"
#include "compare/run_files/summary.h"
#include "native_model/trajectory/columns.h"

namespace rotorub::hdf5 {
namespace {

Column column_of(const ColumnMeaning& meaning, std::span<const double> numbers) {
  return {std::string(meaning.name), std::string(meaning.unit), std::string(meaning.meaning),
          numbers};
}

Table series_of(const Trajectory& t) {
  Table table{"series", {}};
  for (const rotorub::Column& c : t.series) {
    Column column{c.name, c.unit, std::string(series_column(c.name).meaning), c.values};
    if (contact_of_column(c.name).second == "mode") {
      for (const ContactMode mode : {ContactMode::kFree, ContactMode::kSlide, ContactMode::kStick})
        column.words.emplace_back(to_string(mode));
      column.which.assign(c.values.begin(), c.values.end());
    }
    table.columns.push_back(std::move(column));
  }
  return table;
}

// values: one list per column; the last column exists only with several contacts.
Table impacts_of(const Trajectory& t, std::array<std::vector<double>, 9>& values) {
  for (const Impact& i : t.impacts) {
    const double row[] = {
        i.t,           i.normal_impulse, i.friction_impulse, i.gap_rate_before, i.gap_rate_after,
        i.slip_before, i.slip_after,     i.energy_change,    i.contact + 1.0};
    for (std::size_t k = 0; k < values.size(); ++k) values[k].push_back(row[k]);
  }
  Table table{"impacts", {}};
  for (const ColumnMeaning& c : impact_columns(t.contacts > 1))
    table.columns.push_back(column_of(c, values[table.columns.size()]));
  return table;
}

Table events_of(const Trajectory& t, std::vector<double>& times, std::vector<double>& contacts) {
  std::vector<int> which;
  for (const Event& event : t.events) {
    times.push_back(event.t);
    contacts.push_back(event.contact + 1.0);
    which.push_back(static_cast<int>(event.kind));
  }
  Table table{"events", {column_of(event_columns()[0], times), column_of(event_columns()[1], {})}};
  for (const EventKind kind : {EventKind::kImpact, EventKind::kSlide, EventKind::kStick,
                               EventKind::kLiftOff, EventKind::kReverse}) {
    table.columns[1].words.emplace_back(to_string(kind));
  }
  table.columns[1].which = std::move(which);
  if (t.contacts > 1) table.columns.push_back(column_of(event_columns()[2], contacts));
  return table;
}

Table keyphasor_of(const Trajectory& t, std::array<std::vector<double>, 4>& values) {
  Table table{"keyphasor", {}};
  for (const KeyphasorPass& pass : t.keyphasor) {
    const double row[] = {pass.t, pass.x, pass.y, pass.spin_speed};
    for (std::size_t k = 0; k < values.size(); ++k) values[k].push_back(row[k]);
  }
  for (const ColumnMeaning& c : keyphasor_columns())
    table.columns.push_back(column_of(c, values[table.columns.size()]));
  return table;
}

void add_attributes(const nlohmann::json& object, const std::string& prefix,
                    std::vector<Attribute>& all) {
  for (const auto& [key, value] : object.items()) {
    if (is_timing(key) || value.is_null()) continue;
    if (value.is_object()) {
      add_attributes(value, prefix + key + ".", all);
    } else if (value.is_array()) {  // of objects, counted from 0 as in `contact[1].friction`
      for (std::size_t k = 0; k < value.size(); ++k) {
        add_attributes(value[k], fmt::format("{}{}[{}].", prefix, key, k), all);
      }
    } else if (value.is_string()) {
      all.push_back({prefix + key, value.get<std::string>()});
    } else if (value.is_number_integer()) {
      all.push_back({prefix + key, value.get<std::int64_t>()});
    } else {
      all.push_back({prefix + key, value.get<double>()});
    }
  }
}

}  // namespace

std::string run_file(ImageOf image_of, const scene::Scene& scene, const std::string& scene_text,
                     const Trajectory& t) {
  Content content;
  add_attributes(summary_json(scene, t), "", content.attributes);
  content.attributes.push_back({"scene_text", scene_text});
  std::array<std::vector<double>, 9> impacts;
  std::array<std::vector<double>, 4> passes;
  std::vector<double> times, contacts;
  content.tables = {series_of(t), impacts_of(t, impacts), events_of(t, times, contacts),
                    keyphasor_of(t, passes)};
  return image_of(content);
}

}  // namespace rotorub::hdf5
