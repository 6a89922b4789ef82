#include "native_model/trajectory/columns.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

#include "native_model/contact/contact_list.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

constexpr std::string_view kContactColumn = "contact", kPrefix = "contact", kMagnets = "bearing",
                           kFurtherMagnets = "bearing<k>_<column>";
// Parts that a scene must have for a column to be present.
constexpr std::string_view kActuated = "a commanded actuator, or magnets",
                           kTurning = "a ring that turns", kMount = "a mount",
                           kSeveralContacts = "several contacts";

const ColumnMeaning kSeries[] = {
    {"t", "s", "time of the row", ""},
    {"rotor_x", "m", "rotor's centre at the contact, from the middle of the bearing", ""},
    {"rotor_y", "m", "rotor's centre at the contact, from the middle of the bearing", ""},
    {"rotor_vx", "m/s", "velocity of the rotor's centre", ""},
    {"rotor_vy", "m/s", "velocity of the rotor's centre", ""},
    {"stator_x", "m", "ring's centre, from the same origin; contact.offset if fixed", ""},
    {"stator_y", "m", "ring's centre, from the same origin; contact.offset if fixed", ""},
    {"stator_vx", "m/s", "velocity of the ring's centre", ""},
    {"stator_vy", "m/s", "velocity of the ring's centre", ""},
    {"spin_angle", "rad", "rotor's spin without torsion, positive from x to y", ""},
    {"spin_speed", "rad/s", "rate of spin_angle", ""},
    {"gap", "m", "clearance minus distance of the centres; negative: penetration", ""},
    {"gap_rate", "m/s", "rate of the gap; negative: closing; 0 if the centres coincide", ""},
    {"slip", "m/s",
     "speed of the rotor's surface relative to the ring's along e_t = e_z x e_r; e_r points from "
     "the ring's centre to the rotor's",
     ""},
    {"normal_force", "N", "normal force of lasting contact, without impacts", ""},
    {"friction_force", "N",
     "friction on the rotor along e_t; in sliding -friction normal_force sign(slip)", ""},
    {"mode", "", "state of the contact: free, slide or stick", ""},
    {"x_<n>", "m", "modal coordinate; each mode is scaled to 1 at the contact", ""},
    {"y_<n>", "m", "modal coordinate; each mode is scaled to 1 at the contact", ""},
    {"vx_<n>", "m/s", "rate of the modal coordinate", ""},
    {"vy_<n>", "m/s", "rate of the modal coordinate", ""},
    {"torsion_<n>", "rad", "coordinate of a torsion mode, not part of spin_angle", "torsion"},
    {"torsion_speed_<n>", "rad/s", "rate of that coordinate", "torsion"},
    {"control_x", "N", "actual force of the actuator on the ring", kActuated},
    {"control_y", "N", "actual force of the actuator on the ring", kActuated},
    {"current_<n>", "A", "current of the actuator's axis 1 or 2, without the bias", "magnets"},
    {"control_<name>", "", "output of the controller's law, in the law's own unit",
     "a law with outputs"},
    {"ring_angle", "rad", "angle of the ring's own spin, positive as the rotor's", kTurning},
    {"ring_speed", "rad/s", "rate of ring_angle", kTurning},
    {"housing_x", "m", "centre of the ring's housing; 0 at rest without load", kMount},
    {"housing_y", "m", "centre of the ring's housing; 0 at rest without load", kMount},
    {"housing_vx", "m/s", "velocity of the housing", kMount},
    {"housing_vy", "m/s", "velocity of the housing", kMount},
    {"motor_torque", "N m", "torque on the rotor, positive along the spin", "a drive"},
    {"bearing_current_x", "A", "control current of the magnetic bearing's feedback", "feedback"},
    {"bearing_current_y", "A", "control current of the magnetic bearing's feedback", "feedback"},
    {kFurtherMagnets, "A", "column of the k-th magnetic bearing, as bearing2_current_x",
     "several magnetic bearings"},
    {"contact<k>_<column>", "", "column of the k-th contact, as contact2_gap", kSeveralContacts},
};

const ColumnMeaning kImpacts[] = {
    {"t", "s", "time of the impact; of a soft contact, start of the episode", ""},
    {"normal_impulse", "N s", "normal impulse on the rotor", ""},
    {"friction_impulse", "N s", "friction impulse on the rotor along e_t", ""},
    {"gap_rate_before", "m/s",
     "gap rate before the impact; the figures count only impacts below -1e-4 m/s", ""},
    {"gap_rate_after", "m/s", "gap rate after the impact; positive: opening", ""},
    {"slip_before", "m/s", "slip before the impact", ""},
    {"slip_after", "m/s", "slip after the impact", ""},
    {"energy_change", "J",
     "change of energy; the sum over one t is positive only with soft contacts (about 1e-4 J) and "
     "impacts of finite duration",
     ""},
    {kContactColumn, "", "number of the contact, from 1", kSeveralContacts},
};

const ColumnMeaning kEvents[] = {
    {"t", "s", "time of the change", ""},
    {"event", "",
     "impact; slide or stick: the state from here on; lift_off; reverse: the slip changes sign "
     "without sticking",
     ""},
    {kContactColumn, "", "number of the contact, from 1", kSeveralContacts},
};

const ColumnMeaning kKeyphasor[] = {
    {"t", "s", "time at which spin_angle is a multiple of 2 pi", ""},
    {"rotor_x", "m", "as in series.csv, at the first contact", ""},
    {"rotor_y", "m", "as in series.csv, at the first contact", ""},
    {"spin_speed", "rad/s", "as in series.csv", ""},
};

constexpr std::string_view kNumber = "<n>", kName = "<name>";

// "torsion_speed_2" matches torsion_speed_<n>.
bool is_numbered(std::string_view name, std::string_view pattern) {
  const std::string_view stem = pattern.substr(0, pattern.size() - kNumber.size());
  if (!name.starts_with(stem) || name.size() == stem.size()) return false;
  return name.find_first_not_of("0123456789", stem.size()) == std::string_view::npos;
}

// The place of one contact at an instant.
struct Place {
  Eigen::Vector2d rotor, rotor_rate, ring, ring_rate;  // m, m/s, of the centres
  double gap, gap_rate, slip;                          // m, m/s
};

// An instant, and the time for which it was requested.
struct Row {
  const Model& m;
  double time;
  const Snapshot& now;
  const Place* places;  // one for each contact
};

struct Title {
  const char* name;
  int number = 0;                           // from 1: "<name>_<number>"
  const Controller::Output* own = nullptr;  // output of the controller's law; it has no other name
  std::size_t magnets = 0;                  // number of the magnetic bearing, from 0
};

// The modal coordinates.
template <class Visit>
void for_each_coordinate(const Model& m, const Visit& visit) {
  const Layout& l = m.layout;
  const auto block = [&](const char* name, int at, int count, const double* Snapshot::*from) {
    for (int i = 0; i < count; ++i) {
      visit(0, Title{name, i + 1}, [=](const Row& r) { return (r.now.*from)[at + i]; });
    }
  };
  block("x", l.x(), l.modes, &Snapshot::q);
  block("y", l.y(), l.modes, &Snapshot::q);
  block("vx", l.x(), l.modes, &Snapshot::v);
  block("vy", l.y(), l.modes, &Snapshot::v);
  block("torsion", l.theta(), l.torsion, &Snapshot::q);
  block("torsion_speed", l.theta(), l.torsion, &Snapshot::v);
}

// Calls visit(k, title, value) for each column of the k-th contact and its ring; value(row) returns
// the number.
template <class Visit>
void for_each_column_of(const Model& m, std::size_t k, const Visit& visit) {
  const auto both = [&](const char* x, const char* y, const auto& value) {
    visit(k, Title{x}, [&](const Row& r) { return value(r).x(); });
    visit(k, Title{y}, [&](const Row& r) { return value(r).y(); });
  };
  both("rotor_x", "rotor_y", [k](const Row& r) { return r.places[k].rotor; });
  both("rotor_vx", "rotor_vy", [k](const Row& r) { return r.places[k].rotor_rate; });
  both("stator_x", "stator_y", [k](const Row& r) { return r.places[k].ring; });
  both("stator_vx", "stator_vy", [k](const Row& r) { return r.places[k].ring_rate; });
  if (k == 0) {
    visit(k, Title{"spin_angle"}, [](const Row& r) { return spin_angle(r.m, r.now.t, r.now.q); });
    visit(k, Title{"spin_speed"}, [](const Row& r) { return spin_speed(r.m, r.now.v); });
  }
  visit(k, Title{"gap"}, [k](const Row& r) { return r.places[k].gap; });
  visit(k, Title{"gap_rate"}, [k](const Row& r) { return r.places[k].gap_rate; });
  visit(k, Title{"slip"}, [k](const Row& r) { return r.places[k].slip; });
  visit(k, Title{"normal_force"}, [k](const Row& r) { return r.now.contacts[k].normal_force; });
  visit(k, Title{"friction_force"}, [k](const Row& r) { return r.now.contacts[k].friction_force; });
  visit(k, Title{"mode"},
        [k](const Row& r) { return static_cast<double>(r.now.contacts[k].mode); });
  if (k == 0) for_each_coordinate(m, visit);

  const AuxiliaryBearing& bearing = m.auxiliary[k];
  if (bearing.moves() && (bearing.commanded() || bearing.magnets)) {
    both("control_x", "control_y", [k](const Row& r) { return r.now.contacts[k].actuator.force; });
  }
  for (int axis = 0; bearing.magnets && axis < 2; ++axis) {
    visit(k, Title{"current", axis + 1},
          [&](const Row& r) { return r.now.contacts[k].actuator.current[axis]; });
  }
  if (bearing.controller) {
    std::size_t i = 0;
    for (const Controller::Output& output : bearing.controller->outputs()) {
      visit(k, Title{"", 0, &output}, [&](const Row& r) {
        std::array<double, kMostOutputs> values = r.now.contacts[k].actuator.outputs;
        if (!bearing.loop) control_outputs(r.m, r.now.t, r.now.q, r.now.v, values.data(), k);
        return values[i];
      });
      ++i;
    }
  }
  if (bearing.turns()) {
    visit(k, Title{"ring_angle"}, [&](const Row& r) { return r.now.q[bearing.ring_angle]; });
    visit(k, Title{"ring_speed"}, [&](const Row& r) { return r.now.v[bearing.ring_angle]; });
  }
  if (bearing.housing != kAbsent) {
    both("housing_x", "housing_y", [&](const Row& r) -> Eigen::Vector2d {
      return {r.now.q[bearing.housing], r.now.q[bearing.housing + 1]};
    });
    both("housing_vx", "housing_vy", [&](const Row& r) -> Eigen::Vector2d {
      return {r.now.v[bearing.housing], r.now.v[bearing.housing + 1]};
    });
  }
}

// Visits the columns of a run in the order of the file.
template <class Visit>
void for_each_column(const Model& m, const Visit& visit) {
  visit(0, Title{"t"}, [](const Row& r) { return r.time; });
  for_each_column_of(m, 0, visit);
  if (m.drive) {
    visit(0, Title{"motor_torque"},
          [](const Row& r) { return motor_torque(r.m, r.time, r.now.q, r.now.v); });
  }
  for (const StationFeedback& bearing : m.feedbacks) {
    if (!bearing.controlled) continue;
    const auto current = [&](const Row& r) {
      return bearing_current(r.m, bearing, r.time, r.now.q, r.now.v);
    };
    const auto title = [&](const char* name) { return Title{name, 0, nullptr, bearing.number}; };
    visit(0, title("bearing_current_x"), [&](const Row& r) { return current(r).x(); });
    visit(0, title("bearing_current_y"), [&](const Row& r) { return current(r).y(); });
  }
  for (std::size_t k = 1; k < m.auxiliary.size(); ++k) for_each_column_of(m, k, visit);
}

}  // namespace

std::span<const ColumnMeaning> series_columns() { return kSeries; }
std::span<const ColumnMeaning> impact_columns(bool several) {
  return std::span(kImpacts).first(std::size(kImpacts) - (several ? 0 : 1));
}
std::span<const ColumnMeaning> event_columns(bool several) {
  return std::span(kEvents).first(std::size(kEvents) - (several ? 0 : 1));
}

std::span<const ColumnMeaning> keyphasor_columns() { return kKeyphasor; }

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

bool is_modal(const ColumnMeaning& column) {
  return column.name.ends_with("_<n>") && column.name != "current_<n>";
}

const ColumnMeaning& series_column(std::string_view full_name) {
  const std::string_view name = contact_of_column(full_name).second;
  const ColumnMeaning* own = nullptr;
  const bool further = name.starts_with(kMagnets) &&  // "bearing2_current_x": one digit
                       name.substr(std::min(kMagnets.size() + 1, name.size())).starts_with('_');
  for (const ColumnMeaning& column : kSeries) {
    if (column.name == name || (further && column.name == kFurtherMagnets)) return column;
    if (column.name.ends_with(kNumber) && is_numbered(name, column.name)) return column;
    if (column.name.ends_with(kName)) own = &column;
  }
  assert(own);
  return *own;
}

std::vector<Column> series_of(const Model& model) {
  std::vector<Column> all;
  for_each_column(model, [&](std::size_t contact, const Title& title, const auto&) {
    if (title.own) {
      all.push_back({column_of_contact(contact, "control_" + std::string(title.own->name)),
                     std::string(title.own->unit),
                     {}});
      return;
    }
    std::string name = column_of_contact(contact, title.name);
    if (title.number > 0) name += "_" + std::to_string(title.number);
    if (title.magnets > 0) name.insert(kMagnets.size(), std::to_string(title.magnets + 1));
    const std::string_view unit = series_column(name).unit;
    all.push_back({std::move(name), std::string(unit), {}});
  });
  return all;
}

void put_row(const Model& m, double time, const Snapshot& now, std::vector<Column>& columns) {
  std::array<Place, kMaxContacts> places;
  for (std::size_t k = 0; k < m.auxiliary.size(); ++k) {
    const ContactPoint p = contact_point(m, now.q, now.v, k);
    places[k] = {rotor_point(m, now.q, k),
                 rotor_point(m, now.v, k),
                 ring_centre(m, now.q, k),
                 stator_point(m, now.v, k),
                 p.gap,
                 p.gap_rate,
                 p.slip};
  }
  const Row row{m, time, now, places.data()};
  auto column = columns.begin();
  for_each_column(m, [&](std::size_t, const Title&, const auto& value) {
    (column++)->values.push_back(value(row));
  });
  assert(column == columns.end());
}

}  // namespace rotorub
