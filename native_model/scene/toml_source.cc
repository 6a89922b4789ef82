#include "native_model/scene/toml_source.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <tuple>

// toml++ 3.3.0 asserts on bad input, [[[a]]] for one, and would end the program: off, here only.
// Header only and in this file alone, so that no other copy of it is linked.
#define TOML_ASSERT(expr) static_cast<void>(0)
#define TOML_HEADER_ONLY 1
#define TOML_EXCEPTIONS 0
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

namespace rotorub::scene {
namespace {

constexpr std::ptrdiff_t kDeepestKey =
    1000;                              // dots in a line of keys: deeper trees exhaust the stack
constexpr int kMostSyntaxErrors = 20;  // then the reading stops

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

TomlNode converted(const toml::node& node, const std::string& file);

// The library sorts by name; the file's order is restored from the positions.
void convert_entries(const toml::table& table, const std::string& file, TomlNode& result) {
  std::vector<std::tuple<unsigned, unsigned, std::string, const toml::node*>> order;
  for (const auto& [key, value] : table) {
    const toml::source_position at = key.source().begin;
    order.emplace_back(at.line, at.column, std::string(key.str()), &value);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [line, column, name, value] : order) {
    result.entries.emplace_back(name, converted(*value, file));
    // A value is reported where its key stands; an array of tables has no position of its own.
    TomlNode& entry = result.entries.back().second;
    if (entry.kind != TomlNode::Kind::kTable || entry.line == 0)
      entry.line = static_cast<int>(line);
  }
}

TomlNode converted(const toml::node& node, const std::string& file) {
  TomlNode result;
  result.file = file;
  result.line = line_of(node);
  if (const auto* table = node.as_table()) {
    convert_entries(*table, file, result);
  } else if (const auto* array = node.as_array()) {
    result.kind = TomlNode::Kind::kArray;
    for (const toml::node& item : *array) result.items.push_back(converted(item, file));
  } else if (const auto* text = node.as_string()) {
    result.kind = TomlNode::Kind::kString;
    result.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    result.kind = TomlNode::Kind::kInteger;
    result.integer = integer->get();
  } else if (const auto* number = node.as_floating_point()) {
    result.kind = TomlNode::Kind::kFloat;
    result.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    result.kind = TomlNode::Kind::kBoolean;
    result.boolean = boolean->get();
  } else {
    result.kind = TomlNode::Kind::kDate;
  }
  return result;
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines(1);
  for (char c : text) {
    lines.back() += c;
    if (c == '\n') lines.emplace_back();
  }
  return lines;
}

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

// "table.key" of the line at `index` if it looks like `key = value`, else nothing.
std::optional<std::string> assignment_key(const std::vector<std::string>& lines,
                                          std::size_t index) {
  const std::string& line = lines[index];
  const std::size_t equals = line.find('=');
  const std::string key = trimmed(std::string_view(line).substr(0, equals));
  const bool bare = std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.';
  });
  if (equals == std::string::npos || key.empty() || !bare) return std::nullopt;
  for (std::size_t i = index; i-- > 0;) {
    const std::string header = trimmed(lines[i]);
    if (header.empty() || header.front() != '[') continue;
    const std::size_t begin = header.find_first_not_of("[ ");
    const std::size_t end = header.find(']');
    if (begin == std::string::npos || end == std::string::npos || end < begin) break;
    return trimmed(std::string_view(header).substr(begin, end - begin)) + "." + key;
  }
  return key;
}

// `0.5 mm` without quotes is the commonest slip in a scene.
bool looks_like_bare_unit(std::string_view line) {
  const std::string value = trimmed(line.substr(line.find('=') + 1));
  return !value.empty() && std::isdigit(static_cast<unsigned char>(value.front())) &&
         std::any_of(value.begin(), value.end(), [](unsigned char c) { return std::isalpha(c); });
}

}  // namespace

TomlNode* TomlNode::find(std::string_view key) {
  for (auto& [name, value] : entries) {
    if (name == key) return &value;
  }
  return nullptr;
}

const TomlNode* TomlNode::find(std::string_view key) const {
  return const_cast<TomlNode*>(this)->find(key);
}

std::string_view kind_name(TomlNode::Kind kind) {
  switch (kind) {
    case TomlNode::Kind::kTable:
      return "a table";
    case TomlNode::Kind::kArray:
      return "an array";
    case TomlNode::Kind::kString:
      return "a string";
    case TomlNode::Kind::kInteger:
      return "a whole number";
    case TomlNode::Kind::kFloat:
      return "a number";
    case TomlNode::Kind::kBoolean:
      return "a boolean";
    case TomlNode::Kind::kDate:
      return "a date or time";
  }
  return "nothing";
}

TomlDocument parse_toml(std::string_view text, const std::string& file,
                        std::vector<Diagnostic>& diagnostics) {
  std::vector<std::string> lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (std::count(lines[i].begin(), lines[i].end(), '.') > kDeepestKey) {
      diagnostics.push_back({file, static_cast<int>(i) + 1, {}, "more than 1000 dots in one line"});
      return {};
    }
  }

  // A faulty line is blanked and the rest read again, so that one slip does not hide the others.
  std::size_t last_fault = 0;
  for (int attempt = 0; attempt < kMostSyntaxErrors; ++attempt) {
    std::string remaining;
    for (const std::string& line : lines) remaining += line;
    const toml::parse_result parsed = toml::parse(remaining, file);
    if (parsed) return {converted(parsed.table(), file), attempt == 0};

    const std::size_t fault =
        std::min<std::size_t>(parsed.error().source().begin.line, lines.size());
    const std::optional<std::string> key =
        fault > 0 ? assignment_key(lines, fault - 1) : std::nullopt;
    std::string reason = "TOML: " + std::string(parsed.error().description());
    if (key && looks_like_bare_unit(lines[fault - 1])) {
      reason += "; a value with a unit stands in quotes, as in \"0.5 mm\"";
    }
    diagnostics.push_back({file, static_cast<int>(fault), key.value_or(""), reason});
    if (!key || fault <= last_fault) break;
    last_fault = fault;
    lines[fault - 1] = "\n";
  }
  return {};
}

}  // namespace rotorub::scene
