// Tones of outcomes and their colours on a terminal. A colour supports the words and never replaces
// them.
#pragma once

#include <string>
#include <string_view>

namespace rotorub {

enum class Tone { kPlain, kGood, kPart, kBad };

class Palette {
 public:
  // Without colours all text stays unchanged.
  explicit Palette(bool colours = false) : colours_(colours) {}
  // The text in its tone, with the same width on the screen.
  std::string paint(Tone tone, std::string_view text) const;
  // The text with the first `word` in that tone; unchanged if it does not contain the word.
  std::string paint_first(Tone tone, std::string text, std::string_view word) const;

 private:
  bool colours_;
};

}  // namespace rotorub
