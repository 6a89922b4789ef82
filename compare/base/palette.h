// Tones of outcomes, and their colours on a terminal: a second cue beside their words, never the
// only one.
#pragma once

#include <string>
#include <string_view>

namespace rotorub {

enum class Tone { kPlain, kGood, kPart, kBad };

class Palette {
 public:
  // Without colours every text stays as it is.
  explicit Palette(bool colours = false) : colours_(colours) {}
  // text in its tone; no column wider on the screen.
  std::string paint(Tone tone, std::string_view text) const;
  // text with its first `word` in that tone; as it is where the word is absent.
  std::string paint_first(Tone tone, std::string text, std::string_view word) const;

 private:
  bool colours_;
};

}  // namespace rotorub
