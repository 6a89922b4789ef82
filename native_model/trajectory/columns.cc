#include "native_model/trajectory/columns.h"

#include <algorithm>
#include <cassert>
#include <charconv>

#include "native_model/contact/most_contacts.h"

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

}  // namespace rotorub
