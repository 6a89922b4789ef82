// Nesting depth of the dotted keys of a TOML text.
#pragma once

#include <string_view>

namespace rotorub::scene {

// The tree that is read is traversed recursively, so that deeper keys would exhaust the stack.
inline constexpr int kDeepestKey = 1000;  // dots

// The first line with a key of more than kDeepestKey dots, including the dots of the keys around it
// (inline tables); 0 if there is none. Dots in values, strings and comments do not count.
int line_of_too_deep_key(std::string_view text);

}  // namespace rotorub::scene
