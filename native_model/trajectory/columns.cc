#include "native_model/trajectory/columns.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

#include "native_model/contact/most_contacts.h"
#include "native_model/model/dynamics.h"

namespace rotorub {
namespace {

constexpr std::string_view kContactColumn = "contact", kPrefix = "contact", kMagnets = "bearing",
                           kFurtherMagnets = "bearing<k>_<column>";
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
     "ring's centre to the rotor's; positive for forward spin without whirl",
     ""},
    {"normal_force", "N",
     "of lasting contact, never negative; impacts are in impacts.csv; `event`: at a sample or a "
     "switch, that after it",
     ""},
    {"friction_force", "N", "on the rotor along e_t; sliding: -friction normal_force sign(slip)",
     ""},
    {"mode", "", "of the contact: free, slide or stick", ""},
    {"x_<n>", "m", kModal, ""},
    {"y_<n>", "m", "the same in the plane of y", ""},
    {"vx_<n>", "m/s", "rate of that coordinate along x", ""},
    {"vy_<n>", "m/s", "rate of that coordinate along y", ""},
    {"torsion_<n>", "rad", "coordinate of a torsion mode, beyond the spin angle", "torsion"},
    {"torsion_speed_<n>", "rad/s", "its rate", "torsion"},
    {"control_x", "N",
     "force of the actuator on the ring along x, as acts; `event`: at a sample or a switch, that "
     "after it",
     "an actuator that is commanded, or magnets"},
    {"control_y", "N", "the same along y", "an actuator that is commanded, or magnets"},
    {"current_<n>", "A", "current of the actuator's first and second axis, beyond the bias",
     "magnets"},
    {"control_<name>", "", "what the controller's law shows of itself, in the law's own unit",
     "a law with outputs"},
    {"ring_angle", "rad", "angle of the ring's own spin, positive as the rotor's",
     "a ring that turns"},
    {"ring_speed", "rad/s", "its speed", "a ring that turns"},
    {"housing_x", "m",
     "of the housing that carries the ring, from where it is at rest without load", "a mount"},
    {"housing_y", "m", "the same along y", "a mount"},
    {"housing_vx", "m/s", "its velocity along x", "a mount"},
    {"housing_vy", "m/s", "the same along y", "a mount"},
    {"motor_torque", "N m", "on the rotor, positive along the spin", "a drive"},
    {"bearing_current_x", "A", "control current of the magnetic bearing's own feedback along x",
     "feedback"},
    {"bearing_current_y", "A", "the same along y", "feedback"},
    {kFurtherMagnets, "A",
     "of the k-th magnetic bearing what the column of that name is of the first: "
     "bearing2_current_x",
     "several magnetic bearings"},
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
    {"energy_change", "J",
     "of the whole system, by this contact: over the rows of one t the sum is the system's, never "
     "positive; an episode of MuJoCo's soft contacts (coulomb, cone, cone-coulomb) may gain (about "
     "1e-4 J), as may an impact that takes time",
     ""},
    {kContactColumn, "",
     "number of the contact, from 1; an impact in which several take part is a row of each",
     "several contacts"},
};

const ColumnMeaning kEvents[] = {
    {"t", "s", "time of the change", ""},
    {"event", "",
     "impact, slide, stick (the mode from here on), lift_off, or reverse: the slip changes its "
     "sign without sticking",
     ""},
    {kContactColumn, "", "number of the contact, from 1", "several contacts"},
};

const ColumnMeaning kKeyphasor[] = {
    {"t", "s", "time at which the mark on the shaft passes: spin_angle is a multiple of 2 pi", ""},
    {"rotor_x", "m", "as in the series, at the first contact", ""},
    {"rotor_y", "m", "the same", ""},
    {"spin_speed", "rad/s", "as in the series; negative: the mark comes from the other side", ""},
};

constexpr std::string_view kNumber = "<n>", kName = "<name>";

// "torsion_speed_2" matches torsion_speed_<n>.
bool is_numbered(std::string_view name, std::string_view pattern) {
  const std::string_view stem = pattern.substr(0, pattern.size() - kNumber.size());
  if (!name.starts_with(stem) || name.size() == stem.size()) return false;
  return name.find_first_not_of("0123456789", stem.size()) == std::string_view::npos;
}

// An instant, and the time for which it was requested.
struct Row {
  const Model& m;
  double time;
  const Snapshot& now;
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
  both("rotor_x", "rotor_y", [k](const Row& r) { return rotor_point(r.m, r.now.q, k); });
  both("rotor_vx", "rotor_vy", [k](const Row& r) { return rotor_point(r.m, r.now.v, k); });
  both("stator_x", "stator_y", [k](const Row& r) { return ring_centre(r.m, r.now.q, k); });
  both("stator_vx", "stator_vy", [k](const Row& r) { return stator_point(r.m, r.now.v, k); });
  if (k == 0) {
    visit(k, Title{"spin_angle"}, [](const Row& r) { return spin_angle(r.m, r.now.t, r.now.q); });
    visit(k, Title{"spin_speed"}, [](const Row& r) { return spin_speed(r.m, r.now.v); });
  }
  const auto point = [k](const Row& r) { return contact_point(r.m, r.now.q, r.now.v, k); };
  visit(k, Title{"gap"}, [&](const Row& r) { return point(r).gap; });
  visit(k, Title{"gap_rate"}, [&](const Row& r) { return point(r).gap_rate; });
  visit(k, Title{"slip"}, [&](const Row& r) { return point(r).slip; });
  visit(k, Title{"normal_force"}, [k](const Row& r) { return r.now.at(k).normal_force; });
  visit(k, Title{"friction_force"}, [k](const Row& r) { return r.now.at(k).friction_force; });
  visit(k, Title{"mode"}, [k](const Row& r) { return static_cast<double>(r.now.at(k).mode); });
  if (k == 0) for_each_coordinate(m, visit);

  const AuxiliaryBearing& bearing = m.auxiliary[k];
  if (bearing.moves() && (bearing.commanded() || bearing.magnets)) {
    both("control_x", "control_y", [k](const Row& r) { return r.now.at(k).actuator.force; });
  }
  for (int axis = 0; bearing.magnets && axis < 2; ++axis) {
    visit(k, Title{"current", axis + 1},
          [&](const Row& r) { return r.now.at(k).actuator.current[axis]; });
  }
  if (bearing.controller) {
    std::size_t i = 0;
    for (const Controller::Output& output : bearing.controller->outputs()) {
      visit(k, Title{"", 0, &output}, [&](const Row& r) {
        std::array<double, kMostOutputs> values = r.now.at(k).actuator.outputs;
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
  const Row row{m, time, now};
  auto column = columns.begin();
  for_each_column(m, [&](std::size_t, const Title&, const auto& value) {
    (column++)->values.push_back(value(row));
  });
  assert(column == columns.end());
}

}  // namespace rotorub
