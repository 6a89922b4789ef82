// What single keys cannot show: combinations that contradict each other, and the defaults that
// depend on other keys.
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

// Shared by the cross-checks: where a fault is reported, and checks that several parts need.
struct Checker {
  const Scene& scene;
  const Record& record;
  std::vector<Diagnostic>& diagnostics;
  // The auxiliary bearing whose keys "contact", "stator.mass", "controller.kind" mean below.
  std::size_t index = 0;

  const AuxiliaryBearing& bearing() const { return scene.auxiliary[index]; }
  // Where such a key stands: "contact[1].stator.mass" below [[contact]].
  std::string place(std::string_view key) const { return record.place(key, index); }
  bool given(std::string_view key) const { return record.given(place(key)); }
  bool sound(std::initializer_list<std::string> keys) const {
    return std::all_of(keys.begin(), keys.end(),
                       [this](const std::string& key) { return record.sound({place(key)}); });
  }
  void fail(const std::string& key, std::string reason) const {
    diagnostics.push_back(record.diagnostic(place(key), std::move(reason)));
  }
  // "out of the shaft" for a station beyond the length.
  void station(const std::string& path, double z) const;
  // A list at `path`, if it is given, has `length` values; `of` says what counts them.
  void list_length(const std::string& path, const std::vector<double>& list, std::size_t length,
                   const std::string& of) const;
  // A list, whether it is given or not, rises from value to value.
  void ascending(const std::string& path, const std::vector<double>& list) const;
  // How many bending (torsion) modes there are, where the scene says so: not with max_frequency.
  std::optional<std::size_t> bending_modes() const;
  std::optional<std::size_t> torsion_modes() const;
};

void check_run(const Checker& check);           // [run]
void check_rotor(const Checker& check);         // [rotor] and its tables
void check_loads(const Checker& check);         // [drive], [[force]], magnetic bearings
void check_base(const Checker& check);          // [base]
void check_start(const Checker& check);         // [initial], [gravity], [mujoco]
void check_ring(const Checker& check);          // [stator] of one bearing and the tables below
void check_actuator(const Checker& check);      // its [actuator]
void check_contact(const Checker& check);       // its [contact] and the laws of it
void check_gap_at_start(const Checker& check);  // the rotor is in its ring
void check_control(const Checker& check);       // its [controller] and the tables below

// Adds every contradiction to `diagnostics`. Keys that are already known to be faulty are left out.
void validate(const Scene& scene, const Record& record, std::vector<Diagnostic>& diagnostics);

// Fills in what follows from other keys: G from nu, lists of the modal form to their length, the
// damping of torsion, output_times in order. Only for a scene without diagnostics.
void complete(Scene& scene, const Record& record);

}  // namespace rotorub::scene
