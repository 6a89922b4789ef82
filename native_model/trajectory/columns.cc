#include "native_model/trajectory/columns.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

#include "native_model/contact/most_contacts.h"
#include "native_model/dynamics/dynamics.h"

namespace rotorub {

namespace {

constexpr std::string_view kContactColumn = "contact", kPrefix = "contact";
constexpr std::string_view kModal = "modal coordinate, each mode scaled to 1 at the contact";

const ColumnMeaning kSeries[] = {
    {"t", "s", "time, exactly as asked for", ""},
    {"rotor_x", "m", "rotor centre at the contact, fixed frame, from the middle of the bearing",
     ""},
    {"rotor_y", "m", "the same along y; the spin turns x to y", ""},
    {"rotor_vx", "m/s", "its velocity along x; at an impact, that after it", ""},
    {"rotor_vy", "m/s", "its velocity along y", ""},
    {"stator_x", "m", "centre of the ring, from the same middle; contact.offset for a fixed one",
     ""},
    {"stator_y", "m", "the same along y", ""},
    {"stator_vx", "m/s", "its velocity along x", ""},
    {"stator_vy", "m/s", "its velocity along y", ""},
    {"spin_angle", "rad", "angle of the rotor's spin, from x to y positive, without torsion", ""},
    {"spin_speed", "rad/s", "its speed", ""},
    {"gap", "m",
     "clearance less the distance of the centres; positive: free, 0: touching, negative: "
     "penetration",
     ""},
    {"gap_rate", "m/s", "its rate; negative: closing; 0 where the centres coincide", ""},
    {"slip", "m/s",
     "gdot_T, speed of the rotor's surface over the ring's along e_t = e_z x e_r, e_r from the "
     "ring's "
     "centre to the rotor's; positive for forward spin without whirl",
     ""},
    {"normal_force", "N", "of lasting contact, never negative; impacts are in impacts.csv", ""},
    {"friction_force", "N", "on the rotor along e_t; sliding: -friction normal_force sign(slip)",
     ""},
    {"mode", "", "of the contact: free, slide or stick", ""},
    {"x_<n>", "m", kModal, ""},
    {"y_<n>", "m", "the same in the plane of y", ""},
    {"vx_<n>", "m/s", "rate of that coordinate along x", ""},
    {"vy_<n>", "m/s", "rate of that coordinate along y", ""},
    {"torsion_<n>", "rad", "coordinate of a torsion mode, beyond the spin angle", "torsion"},
    {"torsion_speed_<n>", "rad/s", "its rate", "torsion"},
    {"control_x", "N", "force of the actuator on the ring along x, as acts",
     "an actuator that is commanded, or magnets"},
    {"control_y", "N", "the same along y", "an actuator that is commanded, or magnets"},
    {"current_<n>", "A", "current of the actuator's first and second axis, beyond the bias",
     "magnets"},
    {"control_<name>", "", "what the controller's law shows of itself, in the law's own unit",
     "a law with outputs"},
    {"ring_angle", "rad", "angle of the ring's own spin, positive as the rotor's",
     "a ring that turns"},
    {"ring_speed", "rad/s", "its speed", "a ring that turns"},
    {"motor_torque", "N m", "on the rotor, positive along the spin", "a drive"},
    {"bearing_current_x", "A", "control current of the magnetic bearing's own feedback along x",
     "feedback"},
    {"bearing_current_y", "A", "the same along y", "feedback"},
    {"contact<k>_<column>", "",
     "of the k-th contact what the column of that name is of the first: contact2_gap",
     "several contacts"},
};

const ColumnMeaning kImpacts[] = {
    {"t", "s", "time of the impact; soft contact: onset of the episode", ""},
    {"normal_impulse", "N s", "on the rotor, away from the ring; never negative", ""},
    {"friction_impulse", "N s", "on the rotor along e_t", ""},
    {"gap_rate_before", "m/s", "negative: closing; an impact counts below -1e-4 m/s", ""},
    {"gap_rate_after", "m/s", "positive: leaving", ""},
    {"slip_before", "m/s", "as slip in the series", ""},
    {"slip_after", "m/s", "as slip in the series", ""},
    {"energy_change", "J", "of the whole system, never positive", ""},
    {kContactColumn, "",
     "number of the contact, from 1; an impact in which several take part is a row of each",
     "several contacts"},
};

const ColumnMeaning kEvents[] = {
    {"t", "s", "time of the change", ""},
    {"event", "",
     "impact, slide, stick (the mode from here on), lift_off, or reverse: the slip changes its "
     "sign "
     "without sticking",
     ""},
    {kContactColumn, "", "number of the contact, from 1", "several contacts"},
};

constexpr std::string_view kNumber = "<n>", kName = "<name>";

// "torsion_speed_2" is torsion_speed_<n>.
bool is_numbered(std::string_view name, std::string_view pattern) {
  const std::string_view stem = pattern.substr(0, pattern.size() - kNumber.size());
  if (!name.starts_with(stem) || name.size() == stem.size()) return false;
  return name.find_first_not_of("0123456789", stem.size()) == std::string_view::npos;
}

}  // namespace

std::span<const ColumnMeaning> series_columns() { return kSeries; }
std::span<const ColumnMeaning> impact_columns(bool several) {
  return std::span(kImpacts).first(std::size(kImpacts) - (several ? 0 : 1));
}
std::span<const ColumnMeaning> event_columns(bool several) {
  return std::span(kEvents).first(std::size(kEvents) - (several ? 0 : 1));
}

std::string column_of_contact(std::size_t contact, std::string_view name) {
  if (contact == 0) return std::string(name);
  return std::string(kPrefix) + std::to_string(contact + 1) + "_" + std::string(name);
}

std::pair<std::size_t, std::string_view> contact_of_column(std::string_view name) {
  if (!name.starts_with(kPrefix)) return {0, name};
  const std::string_view rest = name.substr(kPrefix.size());
  const std::size_t digits = std::min(rest.find_first_not_of("0123456789"), rest.size());
  std::size_t number = 0;
  std::from_chars(rest.data(), rest.data() + digits, number);
  if (number < 2 || number > kMaxContacts || !rest.substr(digits).starts_with('_'))
    return {0, name};
  return {number - 1, rest.substr(digits + 1)};
}

const ColumnMeaning& series_column(std::string_view full_name) {
  const std::string_view name = contact_of_column(full_name).second;
  const ColumnMeaning* own = nullptr;
  for (const ColumnMeaning& column : kSeries) {
    if (column.name == name) return column;
    if (column.name.ends_with(kNumber) && is_numbered(name, column.name)) return column;
    if (column.name.ends_with(kName)) own = &column;
  }
  assert(own);
  return *own;
}

namespace {

using Place = std::vector<Column>::iterator;

bool has_actuator_columns(const AuxiliaryBearing& at) {
  return at.moves() && (at.commanded() || at.magnets);
}

// What moves the ring of the k-th bearing, and its spin.
void put_ring(const Model& m, std::size_t k, const Snapshot& now, Place& column) {
  const ContactSnapshot& at = now.at(k);
  const AuxiliaryBearing& bearing = m.auxiliary[k];
  const auto put = [&column](double value) { (column++)->values.push_back(value); };
  if (has_actuator_columns(bearing)) {
    put(at.actuator.force.x());
    put(at.actuator.force.y());
  }
  if (bearing.magnets) {
    put(at.actuator.current.x());
    put(at.actuator.current.y());
  }
  if (bearing.controller && !bearing.controller->outputs().empty()) {
    std::array<double, kMostOutputs> values = at.actuator.outputs;
    if (!bearing.loop) control_outputs(m, now.t, now.q, now.v, values.data(), k);
    for (std::size_t i = 0; i < bearing.controller->outputs().size(); ++i) put(values[i]);
  }
  if (!bearing.turns()) return;
  put(now.q[bearing.ring_angle]);
  put(now.v[bearing.ring_angle]);
}

// The columns of another contact than the first.
void put_further(const Model& m, std::size_t k, const Snapshot& now, Place& column) {
  const ContactSnapshot& at = now.at(k);
  const ContactPoint p = contact_point(m, now.q, now.v, k);
  const Eigen::Vector2d r = rotor_point(m, now.q, k), rv = rotor_point(m, now.v, k);
  const Eigen::Vector2d f = ring_centre(m, now.q, k), fv = stator_point(m, now.v, k);
  for (double value :
       {r.x(), r.y(), rv.x(), rv.y(), f.x(), f.y(), fv.x(), fv.y(), p.gap, p.gap_rate, p.slip,
        at.normal_force, at.friction_force, static_cast<double>(at.mode)}) {
    (column++)->values.push_back(value);
  }
  put_ring(m, k, now, column);
}

}  // namespace

std::vector<Column> series_of(const Model& model) {
  const Layout& l = model.layout;
  std::vector<Column> c;
  const auto add = [&c](const std::string& name) {
    c.push_back({name, std::string(series_column(name).unit), {}});
  };
  const auto numbered = [&](const std::string& name, int count) {
    for (int k = 1; k <= count; ++k) add(name + "_" + std::to_string(k));
  };
  // What moves the ring of the k-th bearing, and its spin.
  const auto add_ring = [&](std::size_t k) {
    const AuxiliaryBearing& at = model.auxiliary[k];
    const auto of = [k](const char* name) { return column_of_contact(k, name); };
    if (has_actuator_columns(at)) {
      add(of("control_x"));
      add(of("control_y"));
    }
    numbered(of("current"), at.magnets ? 2 : 0);
    if (at.controller) {
      for (const Controller::Output& out : at.controller->outputs()) {
        c.push_back({of("control_") + std::string(out.name), std::string(out.unit), {}});
      }
    }
    if (!at.turns()) return;
    add(of("ring_angle"));
    add(of("ring_speed"));
  };
  for (const char* name : {"t", "rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x",
                           "stator_y", "stator_vx", "stator_vy", "spin_angle", "spin_speed", "gap",
                           "gap_rate", "slip", "normal_force", "friction_force", "mode"}) {
    add(name);
  }
  for (const char* name : {"x", "y", "vx", "vy"}) numbered(name, l.modes);
  numbered("torsion", l.torsion);
  numbered("torsion_speed", l.torsion);
  add_ring(0);
  if (model.drive) add("motor_torque");
  if (model.feedback) {
    add("bearing_current_x");
    add("bearing_current_y");
  }
  for (std::size_t k = 1; k < model.auxiliary.size(); ++k) {
    for (const char* name :
         {"rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x", "stator_y", "stator_vx",
          "stator_vy", "gap", "gap_rate", "slip", "normal_force", "friction_force", "mode"}) {
      add(column_of_contact(k, name));
    }
    add_ring(k);
  }
  return c;
}

void put_row(const Model& m, double time, const Snapshot& now, std::vector<Column>& columns) {
  const Layout& l = m.layout;
  const ContactPoint p = contact_point(m, now.q, now.v);
  const Eigen::Vector2d r = rotor_point(m, now.q), rv = rotor_point(m, now.v);
  const Eigen::Vector2d f = ring_centre(m, now.q), fv = stator_point(m, now.v);
  Place column = columns.begin();
  const auto put = [&column](double value) { (column++)->values.push_back(value); };
  for (double value : {time, r.x(), r.y(), rv.x(), rv.y(), f.x(), f.y(), fv.x(), fv.y(),
                       spin_angle(m, now.t, now.q), spin_speed(m, now.v), p.gap, p.gap_rate, p.slip,
                       now.normal_force, now.friction_force, static_cast<double>(now.mode)}) {
    put(value);
  }
  const auto block = [&](const double* from, int at, int count) {
    for (int k = 0; k < count; ++k) put(from[at + k]);
  };
  block(now.q, l.x(), 2 * l.modes);
  block(now.v, l.x(), 2 * l.modes);
  block(now.q, l.theta(), l.torsion);
  block(now.v, l.theta(), l.torsion);
  put_ring(m, 0, now, column);
  if (m.drive) put(motor_torque(m, time, now.q, now.v));
  if (m.feedback) {
    for (const double current : bearing_current(m, time, now.q, now.v)) put(current);
  }
  for (std::size_t k = 1; k < m.auxiliary.size(); ++k) put_further(m, k, now, column);
  assert(column == columns.end());
}

}  // namespace rotorub
