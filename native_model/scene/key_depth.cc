// Implements line_of_too_deep_key of toml_source.h.

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "native_model/scene/toml_source.h"

namespace rotorub::scene {
namespace {

// The position after the string or comment that begins at `at`.
std::size_t end_of_text(std::string_view text, std::size_t at) {
  const char mark = text[at];
  if (mark == '#') return std::min(text.find('\n', at), text.size());
  const std::string long_mark(3, mark);
  const bool is_long = text.substr(at, 3) == long_mark;
  for (std::size_t i = at + (is_long ? 3 : 1); i < text.size(); ++i) {
    if (mark == '"' && text[i] == '\\') {
      ++i;
    } else if (is_long ? text.substr(i, 3) == long_mark : text[i] == mark) {
      i += is_long ? 3 : 1;
      // Up to two quotes may directly precede the closing ones of a long string.
      for (int k = 0; is_long && k < 2 && i < text.size() && text[i] == mark; ++k) ++i;
      return i;
    } else if (!is_long && text[i] == '\n') {
      return i;  // unterminated: the parser stops here
    }
  }
  return text.size();
}

}  // namespace

int line_of_too_deep_key(std::string_view text) {
  std::vector<int> outer(1, 0);  // dots of the keys that lead to each open array or inline table
  // dots since the last delimiter; they belong to a key if `=` or a header's ] follows
  int run = 0;
  bool value = false;  // after an `=`, until the end of the statement
  int line = 1;
  int keys = 0;  // dots of the keys up to here
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    if (c == '"' || c == '\'' || c == '#') {
      const std::size_t end = end_of_text(text, i);
      for (; i < end; ++i) line += text[i] == '\n' ? 1 : 0;
      continue;
    }
    ++i;
    if (c == '.') {
      ++run;
      continue;
    }
    if (c == '=' || (c == ']' && !value)) {
      keys = outer.back() + run;
      if (keys > kDeepestKey) return line;
      value = value || c == '=';
    } else if (value && (c == '{' || c == '[')) {
      outer.push_back(keys);
    } else if (value && (c == '}' || c == ']')) {
      if (outer.size() > 1) outer.pop_back();
      keys = outer.back();
    } else if (c == ',') {
      keys = outer.back();
    } else if (c == '\n') {
      ++line;
      if (outer.size() == 1) value = false, keys = 0;
    } else {
      continue;
    }
    run = 0;
  }
  return run > kDeepestKey && !value ? line : 0;
}

}  // namespace rotorub::scene
