// Numbers, paths and words in the text of scenes and of messages about them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace rotorub::scene {

// The number as "%g" writes it, to so many significant digits.
std::string number_text(double number, int digits = 6);

// An element of a list, counted from 0: "force[1]".
std::string list_element(const std::string& list, std::size_t index);

// Without the spaces and tabs around it.
std::string_view trimmed(std::string_view text);

// "--speed = 3600 has no unit, so it is read as rad/s (34377 rpm); if you mean rpm, write "3600
// rpm"" for a speed in rad/s that reads as rpm on a name plate; else empty.
std::string unitless_speed_note(std::string_view where, double speed);

inline constexpr std::size_t kQuotedLength = 60;  // of a value quoted in a message, bytes

// Text that a user wrote, as it may stand in a message: on one line, without anything that a
// terminal obeys: control characters, those that turn the direction of writing, and bytes that are
// no UTF-8 are given as \n, \t, \x1b, \u202e. Longer than `most` bytes: cut there, between
// characters, and ended with "...".
std::string printable(std::string_view text, std::size_t most = kQuotedLength);

// What a word stands for that scenes, options and studies took in earlier releases, accepted until
// version 0.4 with a note: today's name, or what runs in the place of `midpoint`. Any other word
// stands for itself.
std::string_view current_word(std::string_view word);

// "run.integrator: "midpoint" was removed and runs "verlet"; the word is accepted until version
// 0.4", or that it has another name now.
std::string old_word_note(std::string_view where, std::string_view old_word);

}  // namespace rotorub::scene
