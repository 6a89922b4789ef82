#include "native_model/trajectory/columns.h"

#include <cassert>

namespace rotorub {
namespace {

constexpr std::string_view kModal = "modal coordinate, each mode scaled to 1 at the contact";

const ColumnMeaning kSeries[] = {
    {"t", "s", "time, exactly as asked for", ""},
    {"rotor_x", "m", "rotor centre at the contact, fixed frame, from the middle of the bearing", ""},
    {"rotor_y", "m", "the same along y; the spin turns x to y", ""},
    {"rotor_vx", "m/s", "its velocity along x; at an impact, that after it", ""},
    {"rotor_vy", "m/s", "its velocity along y", ""},
    {"stator_x", "m", "centre of the ring, from the same middle; contact.offset for a fixed one", ""},
    {"stator_y", "m", "the same along y", ""},
    {"stator_vx", "m/s", "its velocity along x", ""},
    {"stator_vy", "m/s", "its velocity along y", ""},
    {"spin_angle", "rad", "angle of the rotor's spin, from x to y positive, without torsion", ""},
    {"spin_speed", "rad/s", "its speed", ""},
    {"gap", "m", "clearance less the distance of the centres; positive: free, 0: touching, negative: penetration", ""},
    {"gap_rate", "m/s", "its rate; negative: closing; 0 where the centres coincide", ""},
    {"slip", "m/s", "gdot_T, speed of the rotor's surface over the ring's along e_t = e_z x e_r, e_r from the ring's "
     "centre to the rotor's; positive for forward spin without whirl", ""},
    {"normal_force", "N", "of lasting contact, never negative; impacts are in impacts.csv", ""},
    {"friction_force", "N", "on the rotor along e_t; sliding: -friction normal_force sign(slip)", ""},
    {"mode", "", "of the contact: free, slide or stick", ""},
    {"x_<n>", "m", kModal, ""},
    {"y_<n>", "m", "the same in the plane of y", ""},
    {"vx_<n>", "m/s", "rate of that coordinate along x", ""},
    {"vy_<n>", "m/s", "rate of that coordinate along y", ""},
    {"torsion_<n>", "rad", "coordinate of a torsion mode, beyond the spin angle", "torsion"},
    {"torsion_speed_<n>", "rad/s", "its rate", "torsion"},
    {"control_x", "N", "force of the actuator on the ring along x, as acts", "an actuator that is commanded, or magnets"},
    {"control_y", "N", "the same along y", "an actuator that is commanded, or magnets"},
    {"current_<n>", "A", "current of the actuator's first and second axis, beyond the bias", "magnets"},
    {"control_<name>", "", "what the controller's law shows of itself, in the law's own unit", "a law with outputs"},
    {"ring_angle", "rad", "angle of the ring's own spin, positive as the rotor's", "a ring that turns"},
    {"ring_speed", "rad/s", "its speed", "a ring that turns"},
    {"motor_torque", "N m", "on the rotor, positive along the spin", "a drive"},
    {"bearing_current_x", "A", "control current of the magnetic bearing's own feedback along x", "feedback"},
    {"bearing_current_y", "A", "the same along y", "feedback"},
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
};

const ColumnMeaning kEvents[] = {
    {"t", "s", "time of the change", ""},
    {"event", "", "impact, slide, stick (the mode from here on), lift_off, or reverse: the slip changes its sign "
     "without sticking", ""},
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
std::span<const ColumnMeaning> impact_columns() { return kImpacts; }
std::span<const ColumnMeaning> event_columns() { return kEvents; }

const ColumnMeaning& series_column(std::string_view name) {
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
