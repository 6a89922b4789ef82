// What stands in the files of a run: name, unit, meaning and sign of every column. The recorder
// takes its units from here, columns.json beside the data is made of it, and so is the reference in
// compare/study/README.md.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "native_model/model/actuation.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct ColumnMeaning {
  // "torsion_<n>": numbered from 1; "control_<name>": as the controller's law calls it.
  std::string_view name;
  std::string_view unit;     // SI; "": none
  std::string_view meaning;  // with its sign
  std::string_view present;  // where it stands; "": always
};

std::span<const ColumnMeaning> series_columns();  // in the order of the file
// Where there are several contacts the last tells which.
std::span<const ColumnMeaning> impact_columns(bool several = true);
std::span<const ColumnMeaning> event_columns(bool several = true);
std::span<const ColumnMeaning> keyphasor_columns();

// The column of one of several contacts, from 0: that of the first as it is, "gap" of the second
// "contact2_gap".
std::string column_of_contact(std::size_t contact, std::string_view name);
std::pair<std::size_t, std::string_view> contact_of_column(std::string_view name);

// Of a column of a series by the name in its header ("x_2"). Every name has one: what no other row
// names is a law's own output.
const ColumnMeaning& series_column(std::string_view name);

// All that is known at one instant; q, v point to nq values, valid during the call.
struct ContactSnapshot {
  double normal_force = 0.0;    // N, of persistent contact, >= 0
  double friction_force = 0.0;  // N, on the rotor along e_t
  Mode mode = Mode::kFree;
  ActuatorState actuator{};
};
struct Snapshot : ContactSnapshot {  // its own are those of the first contact
  double t = 0.0;
  const double* q = nullptr;
  const double* v = nullptr;
  std::span<const ContactSnapshot> others{};  // of the further contacts, in their order
  const ContactSnapshot& at(std::size_t contact) const {
    return contact == 0 ? *this : others[contact - 1];
  }
};

// The columns that a run of the model has, empty; what they are: columns.h.
std::vector<Column> series_of(const Model& model);
// A row; time: as asked for, which `now` is but for round-off.
void put_row(const Model& model, double time, const Snapshot& now, std::vector<Column>& columns);

}  // namespace rotorub
