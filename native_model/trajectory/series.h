// The series of a run: its columns, and a row of an instant.
#pragma once

#include <span>
#include <vector>

#include "native_model/system/actuation.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

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
