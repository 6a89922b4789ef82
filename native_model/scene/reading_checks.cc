// The cross-checks of a scene in their order, and the functions that they share.

#include <algorithm>
#include <functional>

#include "native_model/scene/reading.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {

bool Reading::sound(std::initializer_list<std::string_view> keys) const {
  return std::all_of(keys.begin(), keys.end(),
                     [this](std::string_view key) { return record_->sound(place(key)); });
}

std::string Reading::full(std::string_view key) const {
  return (key.starts_with('.') ? at : std::string()) + std::string(key);
}

std::string Reading::place(std::string_view key) const { return record_->place(full(key), index); }

void Reading::fail(std::string_view key, std::string reason) const {
  diagnostics_.push_back(record_->diagnostic(place(key), std::move(reason)));
}

void Reading::missing(std::string_view key, const std::string& why) const {
  fail(key, "missing: expected " + find_key(place(key))->expected() + why);
}

void Reading::needs(std::string_view key, const std::string& other, const std::string& why) const {
  const bool table = other.starts_with('[');
  if (given(key) && !given(table ? other.substr(1, other.size() - 2) : other))
    fail(key, "needs " + full(other) + why);
}

void Reading::excludes(std::string_view key, std::string_view other, const std::string& why) const {
  if (given(key) && given(other))
    fail(key, "cannot be given together with " + full(other) + why + "; remove one of them");
}

void Reading::station(const std::string& path, double z) const {
  if (!scene.rotor.geometry || !sound({path, "rotor.length"})) return;
  const double length = scene.rotor.geometry->length;
  if (z > length) {
    fail(path, "is not on the shaft: expected a place from 0 to rotor.length = " +
                   number_text(length) + " m, got " + number_text(z) + " m");
  }
}

void Reading::list_length(std::string_view key, std::optional<std::size_t> length,
                          const std::string& of) const {
  if (!length || !given(key) || !sound({key})) return;
  const std::size_t got = record_->length(place(key));
  if (got == *length) return;
  fail(key, "expected " + std::to_string(*length) + " value(s), one for each " + of + ", got " +
                std::to_string(got));
}

bool Reading::ascending(const std::string& path, const std::vector<double>& list) const {
  const bool ascends =
      std::adjacent_find(list.begin(), list.end(), std::greater_equal<>()) == list.end();
  if (!ascends) fail(path, "must be strictly ascending");
  return ascends;
}

void Reading::abscissae(const std::string& path, const std::vector<double>& list,
                        const char* two) const {
  if (list.size() < 2) fail(path, std::string("expected ") + two + " or more");
  ascending(path, list);
}

void Reading::voltage(const std::string& path) const {
  needs(path + ".voltage_limit", path + ".inductance", ": inductance di/dt = u - resistance i");
  for (const char* key : {".inductance", ".resistance"}) {
    needs(path + key, path + ".voltage_limit", ": without a limit it has no effect");
  }
}

std::optional<std::size_t> Reading::bending_modes() const {
  if (scene.rotor.modal && given("rotor.modal.mass") && sound({"rotor.modal.mass"})) {
    return scene.rotor.modal->mass.size();
  }
  if (scene.rotor.geometry && scene.rotor.geometry->modes && sound({"rotor.modes"})) {
    return static_cast<std::size_t>(*scene.rotor.geometry->modes);
  }
  return std::nullopt;
}

std::optional<std::size_t> Reading::torsion_modes() const {
  if (!scene.rotor.torsion) return std::nullopt;
  const Torsion& torsion = *scene.rotor.torsion;
  if (given("rotor.torsion.inertia") && sound({"rotor.torsion.inertia"})) {
    return torsion.inertia.size();
  }
  if (torsion.modes > 0) return static_cast<std::size_t>(torsion.modes);
  return std::nullopt;
}

void Reading::check() {
  check_rotor(*this);
  check_run(*this);
  check_loads(*this);
  check_start(*this);
  for (index = 0; index < scene.auxiliary.size(); ++index) {
    check_ring(*this);
    check_actuator(*this);
    check_contact(*this);
    check_control(*this);
  }
  check_rules(*this);
}

}  // namespace rotorub::scene
