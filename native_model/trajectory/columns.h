// Name, unit, meaning and sign of every column in the files of a run. The recorder takes its units
// from here; columns.json beside the data and the reference in compare/study/README.md are
// generated from it.
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
  // "torsion_<n>": numbered from 1; "control_<name>": named by the controller's law.
  std::string_view name;
  std::string_view unit;     // SI; "": none
  std::string_view meaning;  // includes the sign
  std::string_view present;  // when the column exists; "": always
};

std::span<const ColumnMeaning> series_columns();  // in the order of the file
// With several contacts the last column is the number of the contact.
std::span<const ColumnMeaning> impact_columns(bool several = true);
std::span<const ColumnMeaning> event_columns(bool several = true);
std::span<const ColumnMeaning> keyphasor_columns();

// Name of a column of one of several contacts, numbered from 0: "gap" stays "gap" for the first and
// becomes "contact2_gap" for the second. contact_of_column is the inverse.
std::string column_of_contact(std::size_t contact, std::string_view name);
std::pair<std::size_t, std::string_view> contact_of_column(std::string_view name);

// Meaning of a column of a series by the name in its header ("x_2"). A name that matches no row of
// the table is an output of a controller's law.
const ColumnMeaning& series_column(std::string_view name);
// Whether the column is a coordinate of one mode, of bending or torsion, or its rate.
bool is_modal(const ColumnMeaning& column);

// State of one contact at one instant.
struct ContactSnapshot {
  double normal_force = 0.0;    // N, of lasting contact, >= 0
  double friction_force = 0.0;  // N, on the rotor along e_t
  ContactMode mode = ContactMode::kFree;
  ActuatorState actuator{};
};
// State of the model at one instant. q, v: nq values, valid during the call.
struct Snapshot {
  double t = 0.0;  // s
  const double* q = nullptr;
  const double* v = nullptr;
  std::span<const ContactSnapshot> contacts{};  // one for each auxiliary bearing
  // The integrals of an event-driven run (integral_index() in native_model/event/smooth_system.h),
  // valid as long as q and v; null for a fixed-step run.
  const double* integrals = nullptr;
};

// The empty columns that a run of the model has.
std::vector<Column> series_of(const Model& model);
// Appends a row. time: as requested; now.t may differ from it by round-off.
void put_row(const Model& model, double time, const Snapshot& now, std::vector<Column>& columns);

}  // namespace rotorub
