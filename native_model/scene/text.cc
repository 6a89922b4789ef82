#include "native_model/scene/text.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace rotorub::scene {

std::string number_text(double number, int digits) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, number);
  return buffer.data();
}

std::string list_element(const std::string& list, std::size_t index) {
  return list + "[" + std::to_string(index) + "]";
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t bytes = 0;  // 0: no UTF-8
};

// The first character of a text that is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) {
    return i < text.size() ? static_cast<std::uint32_t>(static_cast<unsigned char>(text[i])) : 0u;
  };
  const std::uint32_t lead = byte(0);
  if (lead < 0x80u) return {lead, 1};
  // Bits of the lead byte, and the lowest code that needs so many bytes.
  struct Length {
    std::size_t bytes;
    std::uint32_t mark, mask, least;
  };
  for (const Length& l : {Length{2, 0xc0u, 0xe0u, 0x80u}, Length{3, 0xe0u, 0xf0u, 0x800u},
                          Length{4, 0xf0u, 0xf8u, 0x10000u}}) {
    if ((lead & l.mask) != l.mark) continue;
    std::uint32_t code = lead & ~l.mask;
    for (std::size_t i = 1; i < l.bytes; ++i) {
      if ((byte(i) & 0xc0u) != 0x80u) return {};
      code = (code << 6u) | (byte(i) & 0x3fu);
    }
    const bool surrogate = code >= 0xd800u && code <= 0xdfffu;
    return code < l.least || code > 0x10ffffu || surrogate ? Character{} : Character{code, l.bytes};
  }
  return {};
}

// Controls, and the marks that turn the direction of writing or end a line.
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
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t bytes = std::max<std::size_t>(c.bytes, 1);
    std::string shown(text.substr(0, bytes));
    if (c.bytes == 0) {
      std::array<char, 8> hex{};
      std::snprintf(hex.data(), hex.size(), "\\x%02x", static_cast<unsigned char>(text.front()));
      shown = hex.data();
    } else if (obeyed(c.code)) {
      shown = escaped(c.code);
    }
    if (result.size() + shown.size() > most) return result + "...";
    result += shown;
    text.remove_prefix(bytes);
  }
  return result;
}

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
