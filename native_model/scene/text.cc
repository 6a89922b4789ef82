#include "native_model/scene/text.h"

#include <array>
#include <boost/locale/utf.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

namespace rotorub::scene {

std::string number_text(double number, int digits) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, number);
  return buffer.data();
}

std::string unitless_speed_note(std::string_view where, double speed) {
  // Machines hardly ever turn at such a round number of rad/s.
  const double size = std::abs(speed);
  const bool reads_as_rpm = size >= 1000.0 && size <= 60000.0 &&
                            (std::fmod(size, 60.0) == 0.0 || std::fmod(size, 100.0) == 0.0);
  if (!reads_as_rpm) return {};
  const std::string plain = number_text(speed);
  return std::string(where) + " = " + plain + " has no unit, so it is read as rad/s (" +
         number_text(speed * 30.0 / std::numbers::pi, 5) + " rpm); if you mean rpm, write \"" +
         plain + " rpm\"";
}

std::string list_element(const std::string& list, std::size_t index) {
  return list + "[" + std::to_string(index) + "]";
}

std::string_view trimmed(std::string_view text) {
  constexpr const char* kSpace = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

namespace {

// Control characters, and characters that change the writing direction or end a line.
bool obeyed(std::uint32_t code) {
  return code < 0x20u || (code >= 0x7fu && code <= 0x9fu) || (code >= 0x200eu && code <= 0x200fu) ||
         (code >= 0x2028u && code <= 0x202eu) || (code >= 0x2066u && code <= 0x2069u);
}

std::string escaped(std::uint32_t code) {
  if (code == '\n') return "\\n";
  if (code == '\t') return "\\t";
  if (code == '\r') return "\\r";
  std::array<char, 12> text{};
  std::snprintf(text.data(), text.size(), code < 0x80u ? "\\x%02x" : "\\u%04x",
                static_cast<unsigned>(code));
  return text.data();
}

}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string result;
  for (const char *at = text.data(), *const end = at + text.size(); at != end;) {
    const char* const begin = at;
    const auto code = boost::locale::utf::utf_traits<char>::decode(at, end);
    const bool valid = boost::locale::utf::is_valid_codepoint(code);
    if (!valid) at = begin + 1;
    std::string shown(begin, at);
    if (!valid) {
      std::array<char, 8> hex{};
      std::snprintf(hex.data(), hex.size(), "\\x%02x", static_cast<unsigned char>(*begin));
      shown = hex.data();
    } else if (obeyed(code)) {
      shown = escaped(code);
    }
    if (result.size() + shown.size() > most) return result + "...";
    result += shown;
  }
  return result;
}

namespace {

struct OldWord {
  std::string_view word, today;
  bool removed = false;  // not renamed: `today` replaces it
};
constexpr OldWord kOldWords[] = {{"literal", "euler"},
                                 {"midpoint", "verlet", true},
                                 {"paper", "verlet", true},
                                 {"native-midpoint", "native-verlet", true},
                                 {"native-paper", "native-verlet", true}};

const OldWord* old_word_named(std::string_view word) {
  for (const OldWord& old : kOldWords) {
    if (word == old.word) return &old;
  }
  return nullptr;
}

}  // namespace

std::string_view current_word(std::string_view word) {
  const OldWord* old = old_word_named(word);
  return old ? old->today : word;
}

std::string old_word_note(std::string_view where, std::string_view old_word) {
  const OldWord* old = old_word_named(old_word);
  const std::string today = "\"" + std::string(current_word(old_word)) + "\"";
  return std::string(where) + ": \"" + std::string(old_word) + "\" " +
         (old && old->removed ? "was removed and runs " + today : "is called " + today + " now") +
         "; the word is accepted until version 0.4";
}

}  // namespace rotorub::scene
