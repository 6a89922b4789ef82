// The reference of the scene's tables and keys, from the schema.
#pragma once

#include <string>

namespace rotorub::scene {

// Markdown: a section for every table with its keys, units, ranges, defaults and meanings. Stands
// in mjcf/README.md between the marks below; a test holds the two together.
std::string reference_markdown();

inline constexpr const char* kReferenceBegin = "<!-- reference: begin (from the schema) -->\n";
inline constexpr const char* kReferenceEnd = "<!-- reference: end -->\n";

}  // namespace rotorub::scene
