// Text of numbers, paths and words, for scenes and messages about them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rotorub::scene {

// The number in the format "%g", with `digits` significant digits.
std::string number_text(double number, int digits = 6);

// The path of a list element, counted from 0: "force[1]".
std::string list_element(const std::string& list, std::size_t index);

// The text without surrounding spaces, tabs and line ends.
std::string_view trimmed(std::string_view text);

// "--speed = 3600 has no unit, so it is read as rad/s (34377 rpm); if you mean rpm, write "3600
// rpm"" for a speed that looks like a number of rpm; else empty.
std::string unitless_speed_note(std::string_view where, double speed);

inline constexpr std::size_t kQuotedLength = 60;  // bytes, of a value quoted in a message

// Makes a user's text safe for a message: it stays on one line, and everything that a terminal
// would interpret is escaped as \n, \t, \x1b or \u202e. This concerns control characters,
// characters that change the writing direction, and bytes that are not UTF-8. Text longer than
// `most` bytes is cut between characters and ends with "...".
std::string printable(std::string_view text, std::size_t most = kQuotedLength);

// The present name for a word of earlier releases that scenes, options and studies accept until
// version 0.4 with a note, or the replacement of a removed one such as `midpoint`. Any other word
// is returned unchanged.
std::string_view current_word(std::string_view word);

// "run.integrator: "midpoint" was removed and runs "verlet"; the word is accepted until version
// 0.4", or a note that the word has been renamed.
std::string old_word_note(std::string_view where, std::string_view old_word);

}  // namespace rotorub::scene
