// Words that scenes, options and studies took in the last release and that have another name now.
// They are accepted until 0.3, with a note.
#pragma once

#include <string>
#include <string_view>

namespace rotorub::scene {

// Today's name of `word`; a word that has none is its own.
std::string_view current_word(std::string_view word);

// "run.integrator: "paper" is called "midpoint" now; the old word is accepted until 0.3"
std::string old_word_note(std::string_view where, std::string_view old_word);

}  // namespace rotorub::scene
