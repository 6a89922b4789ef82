// Helpers for results as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "native_model/rotor/mode_truncation.h"

namespace rotorub {

// As text on several lines, ending with a line break. Invalid UTF-8, for example in a file name, is
// replaced, so that the result is not lost.
std::string json_text(const nlohmann::json& value);

// null if the value is missing or not finite, because JSON cannot express it.
nlohmann::json number_or_null(const std::optional<double>& value);

// {"kept", "mesh": kg, "kept_modes", "mesh_modes"}; null if empty.
nlohmann::json contact_mass_json(const std::optional<ContactMass>& mass);

}  // namespace rotorub
