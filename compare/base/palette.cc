#include "compare/base/palette.h"

#include <fmt/format.h>

namespace rotorub {
namespace {

// ECMA-48, select graphic rendition: bold, and one of the eight basic colours, which every terminal
// knows and its user can configure.
const char* start(Tone tone) {
  switch (tone) {
    case Tone::kGood:
      return "\033[1;32m";
    case Tone::kPart:
      return "\033[1;33m";
    case Tone::kBad:
      return "\033[1;31m";
    case Tone::kPlain:
      break;
  }
  return "";
}

}  // namespace

std::string Palette::paint(Tone tone, std::string_view text) const {
  if (!colours_ || tone == Tone::kPlain) return std::string(text);
  return fmt::format("{}{}\033[0m", start(tone), text);
}

std::string Palette::paint_first(Tone tone, std::string text, std::string_view word) const {
  const std::size_t at = text.find(word);
  if (at != std::string::npos) text.replace(at, word.size(), paint(tone, word));
  return text;
}

}  // namespace rotorub
