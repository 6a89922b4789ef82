// The scene's schema (native_model/scene/schema.h) as JSON Schema, draft 7, for editors: the keys
// of each table with their types, bounds and meanings. Only `rotorub` itself can check whether the
// values make a valid machine.
#pragma once

#include <string>

namespace rotorub {

std::string scene_schema();

}  // namespace rotorub
