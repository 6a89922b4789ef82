// Checks for combinations of keys that contradict each other, and defaults that depend on others.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "native_model/scene/record.h"
#include "native_model/scene/scene.h"

namespace rotorub::scene {

// Shared by the cross-checks: reports faults, and holds the checks that several parts need.
struct Checker {
  const Scene& scene;
  const Record& record;
  std::vector<Diagnostic>& diagnostics;
  // The auxiliary bearing of keys such as "contact", "stator.mass" and "controller.kind".
  std::size_t index = 0;

  const AuxiliaryBearing& bearing() const { return scene.auxiliary[index]; }
  // The full path of such a key, for instance "contact[1].stator.mass" below [[contact]].
  std::string place(std::string_view key) const { return record.place(key, index); }
  bool given(std::string_view key) const { return record.given(place(key)); }
  bool sound(std::initializer_list<std::string> keys) const {
    return std::all_of(keys.begin(), keys.end(),
                       [this](const std::string& key) { return record.sound({place(key)}); });
  }
  void fail(const std::string& key, std::string reason) const {
    diagnostics.push_back(record.diagnostic(place(key), std::move(reason)));
  }
  // Reports a station beyond the end of the shaft.
  void station(const std::string& path, double z) const;
  // Reports a given list at `path` that does not have `length` values, one for each `of`.
  void list_length(const std::string& path, const std::vector<double>& list, std::size_t length,
                   const std::string& of) const;
  // Reports a list that is not strictly ascending, whether it was given or not.
  void ascending(const std::string& path, const std::vector<double>& list) const;
  // Number of bending (torsion) modes. Empty if the scene does not state it, as with max_frequency.
  std::optional<std::size_t> bending_modes() const;
  std::optional<std::size_t> torsion_modes() const;
};

void check_run(const Checker& check);    // [run]
void check_rotor(const Checker& check);  // [rotor] and its tables
void check_loads(const Checker& check);  // [drive], [[force]], [base], magnetic bearings
void check_base(const Checker& check);   // [base]
void check_magnetic_bearings(const Checker& check);
void check_start(const Checker& check);         // [initial], [gravity], [mujoco]
void check_ring(const Checker& check);          // [stator] of one bearing and the tables below it
void check_actuator(const Checker& check);      // [actuator] of one bearing
void check_contact(const Checker& check);       // [contact] of one bearing and its laws
void check_gap_at_start(const Checker& check);  // refuses a rotor that starts outside its ring
void check_control(const Checker& check);  // [controller] of one bearing and the tables below it

// Adds every contradiction to `diagnostics`, except for keys that are already known to be faulty.
void validate(const Scene& scene, const Record& record, std::vector<Diagnostic>& diagnostics);

// Fills in values that follow from other keys: G from nu, lists of the modal form up to their
// length, the damping of torsion, output_times in ascending order. Call it only if the scene has no
// diagnostics.
void complete(Scene& scene, const Record& record);

}  // namespace rotorub::scene
