// The scene's schema (native_model/scene/schema.h) as JSON Schema, draft 7, for editors: what
// stands where, of which type, between which bounds, and what it means. Whether the values make a
// machine `rotorub` alone can say.
#pragma once

#include <string>

namespace rotorub {

std::string scene_schema();

}  // namespace rotorub
