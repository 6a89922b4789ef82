#include "compare/base/json.h"

#include <cmath>

#include "compare/base/json_library.h"

template class nlohmann::basic_json<>;
template class nlohmann::basic_json<nlohmann::ordered_map>;

namespace rotorub {

using nlohmann::json;

std::string json_text(const json& value) {
  return value.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? json(*value) : json(nullptr);
}

json contact_mass_json(const std::optional<ContactMass>& mass) {
  if (!mass) return nullptr;
  return {{"kept", mass->kept},
          {"mesh", mass->mesh},
          {"kept_modes", mass->kept_modes},
          {"mesh_modes", mass->mesh_modes}};
}

}  // namespace rotorub
