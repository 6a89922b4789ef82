// Pieces of the text of scenes and of messages about them.
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

}  // namespace rotorub::scene
