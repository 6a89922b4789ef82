#include "compare/base/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace rotorub {

std::string short_number(double value) {
  if (value == 0.0) return "0";
  const double size = std::abs(value);
  if (!std::isfinite(value)) return value > 0.0 ? "∞" : value < 0.0 ? "-∞" : "–";
  if (size >= 1e6 || size < 1e-3) return fmt::format("{:.2e}", value);
  if (value == std::round(value)) return fmt::format("{:.0f}", value);
  // Four significant digits, without an exponent.
  const int decimals = std::max(0, 3 - static_cast<int>(std::floor(std::log10(size))));
  return fmt::format("{:.{}f}", value, decimals);
}

std::string percent_text(double share) { return fmt::format("{:.6g} %", 100.0 * share); }

std::string time_text(double seconds) {
  if (seconds == 0.0) return "0 s";
  if (std::abs(seconds) < 1e-3) return fmt::format("{:.6g} µs", 1e6 * seconds);
  if (std::abs(seconds) < 0.1) return fmt::format("{:.6g} ms", 1e3 * seconds);
  return fmt::format("{:.6g} s", seconds);
}

std::string key_in_words(std::string_view key) {
  std::string words;
  for (std::size_t k = 0; k < key.size(); ++k) {
    if (key[k] == '[') {
      const std::size_t end = key.find(']', k);
      words += fmt::format(" {}", std::stoi(std::string(key.substr(k + 1, end - k - 1))) + 1);
      k = end;
    } else {
      words += key[k] == '.' || key[k] == '_' ? ' ' : key[k];
    }
  }
  return words;
}

ShownUnit usual_unit(double value, std::string_view unit) {
  const double size = std::abs(value);
  const std::string name(unit);
  if ((name == "m" || name == "s") && size > 0.0 && size < 0.1)
    return size < 1e-4 ? ShownUnit{"µ" + name, kMicro} : ShownUnit{"m" + name, kMilli};
  if (name.starts_with('N') && size >= 1e4) return {"k" + name, 1.0 / kMilli};
  return shown_unit(unit);
}

std::string usual_text(double value, std::string_view unit) {
  const ShownUnit shown = usual_unit(value, unit);
  return fmt::format("{:.4g}{}{}", shown.per_si * value, shown.name.empty() ? "" : " ", shown.name);
}

namespace {
// Columns of UTF-8 text on a terminal: one for each character, "µ" included.
std::size_t columns_of(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0u) != 0x80u; }));
}
}  // namespace

std::string wrapped(const std::string& lead, const std::string& sentence,
                    std::optional<std::size_t> indent) {
  const std::size_t margin = indent.value_or(columns_of(lead));
  std::string out = lead;
  std::size_t column = columns_of(lead);
  bool after_word = false;
  for (std::size_t at = 0; at < sentence.size();) {
    std::size_t end = std::min(sentence.find_first_of(" \n", at), sentence.size());
    if (sentence.compare(end, 2, " %") == 0)
      end += std::min(sentence.find_first_of(" \n", end + 1), sentence.size()) - end;
    const std::size_t word = columns_of(std::string_view(sentence).substr(at, end - at));
    if (end > at) {
      if (column > margin && column + (after_word ? 1 : 0) + word > kTerminalWidth) {
        out.erase(out.find_last_not_of(' ') + 1);
        out += "\n" + std::string(margin, ' ');
        column = margin;
        after_word = false;
      }
      if (after_word) out += ' ';
      column += word + (after_word ? 1 : 0);
      out.append(sentence, at, end - at);
      after_word = true;
    }
    at = end + 1;
  }
  return out + "\n";
}

}  // namespace rotorub
