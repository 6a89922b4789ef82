// How deep the dotted keys of a TOML text lead.
#pragma once

#include <string_view>

namespace rotorub::scene {

// What is read stands as a tree, followed by calls within calls: deeper keys exhaust the stack.
inline constexpr int kDeepestKey = 1000;  // dots

// The first line with a key of more than kDeepestKey dots, those of the keys around it (inline
// tables) counted in; 0: none. Dots of values, strings and comments do not count.
int line_of_too_deep_key(std::string_view text);

}  // namespace rotorub::scene
