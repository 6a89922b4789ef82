// Changes to a scene from the command line: "table.key=value".
//
//   contact.friction=0.2      run.end=100ms      force[0].amplitude=200    force.0.amplitude=200
// gravity={acceleration=[0,-9.81]}             controller=none (removes a table or a key)
// controller.sensors.velocity=none (the value, because it is a word of this key)
// A value that is not TOML is taken as a string: a bare word or a quantity with a unit. A new
// `kind` removes the keys of that table that belong only to other kinds. A new run.end removes
// later output_times of the file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

inline constexpr const char* kOverrideFile = "--set";  // replaces the file name in diagnostics

// The key of an override, "contact.friction" for "contact.friction = 0.2".
std::string override_key(const std::string& text);

// Applies the overrides to the tree, in order. Those that cannot be applied go to `diagnostics`.
// The reader checks later whether the key exists and the value fits.
void apply_overrides(TomlNode& root, std::span<const std::string> overrides,
                     std::vector<Diagnostic>& diagnostics);

}  // namespace rotorub::scene
