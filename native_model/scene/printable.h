// Text that a user wrote, as it may stand in a message on a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rotorub::scene {

inline constexpr std::size_t kQuotedLength = 60;  // of a value quoted in a message, bytes

// On one line, without anything that a terminal obeys: control characters, those that turn the
// direction of writing, and bytes that are no UTF-8 are given as \n, \t, \x1b, \u202e. Longer than
// `most` bytes: cut there, between characters, and ended with "...".
std::string printable(std::string_view text, std::size_t most = kQuotedLength);

}  // namespace rotorub::scene
