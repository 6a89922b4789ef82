// Changes to a scene from the command line: "table.key=value".
//
//   contact.friction=0.2      run.end=100ms      force[0].amplitude=200    force.0.amplitude=200
//   gravity={acceleration=[0,-9.81]}             controller=none (takes a part or a key away)
//
// The value is TOML, or else a bare word or a quantity with a unit, taken as a string. A new `kind`
// takes away the keys that belong to the other kinds of that table alone; a new run.end takes away
// the output_times of the file beyond it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "native_model/scene/toml_source.h"

namespace rotorub::scene {

inline constexpr const char* kOverrideFile = "--set";  // stands for the file in diagnostics

// "contact.friction" of "contact.friction = 0.2".
std::string override_key(const std::string& text);

// Applies them to the tree, in order. What cannot be applied goes to `diagnostics`; whether the key
// exists and the value fits is found out by the reader.
void apply_overrides(TomlNode& root, std::span<const std::string> overrides,
                     std::vector<Diagnostic>& diagnostics);

}  // namespace rotorub::scene
