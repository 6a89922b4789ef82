#include "native_model/scene/old_words.h"

#include <array>
#include <utility>

namespace rotorub::scene {

std::string_view current_word(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 3> kRenamed{
      {{"paper", "midpoint"}, {"literal", "euler"}, {"native-paper", "native-midpoint"}}};
  for (const auto& [old_word, today] : kRenamed) {
    if (word == old_word) return today;
  }
  return word;
}

std::string old_word_note(std::string_view where, std::string_view old_word) {
  return std::string(where) + ": \"" + std::string(old_word) + "\" is called \"" +
         std::string(current_word(old_word)) + "\" now; the old word is accepted until 0.3";
}

}  // namespace rotorub::scene
