// What every result as JSON is made with.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "native_model/rotor/mode_truncation.h"

namespace rotorub {

// As text on several lines, with its line break. Bytes that are no UTF-8, as of a file's name, are
// replaced: a result is not lost by its name.
std::string json_text(const nlohmann::json& value);

// Null for none, and for what is not finite: JSON has no word for it.
nlohmann::json number_or_null(const std::optional<double>& value);

// {"kept", "mesh": kg, "kept_modes", "mesh_modes"}; null for none.
nlohmann::json contact_mass_json(const std::optional<ContactMass>& mass);

}  // namespace rotorub
