#include "native_model/scene/toml_source.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <optional>
#include <sstream>
#include <tuple>

#include "native_model/scene/printable.h"

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
    1000;  // dots in a line of keys: deeper trees exhaust the stack
// Stands for a value that could not be read, while the rest is.
constexpr std::string_view kFaultyMark = "\x01 faulty";
constexpr std::string_view kFaultyText = "\"\\u0001 faulty\"";
constexpr std::size_t kLongestDescription = 200;  // bytes of what the library says
constexpr int kMostSyntaxErrors = 20;  // then the reading stops

int line_of(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

// `mended`: a string may be the mark of a faulty value.
TomlNode converted(const toml::node& node, FileName file, bool mended);

// The library sorts by name; the file's order is restored from the positions.
void convert_entries(const toml::table& table, FileName file, bool mended,
                     TomlNode& result) {
  std::vector<std::tuple<unsigned, unsigned, std::string, const toml::node*>> order;
  for (const auto& [key, value] : table) {
    const toml::source_position at = key.source().begin;
    order.emplace_back(at.line, at.column, std::string(key.str()), &value);
  }
  std::sort(order.begin(), order.end());
  for (const auto& [line, column, name, value] : order) {
    result.entries.emplace_back(name, converted(*value, file, mended));
    // A value is reported where its key stands; an array of tables has no position of its own.
    TomlNode& entry = result.entries.back().second;
    if (entry.kind != TomlNode::Kind::kTable || entry.line == 0)
      entry.line = static_cast<int>(line);
  }
}

TomlNode converted(const toml::node& node, FileName file, bool mended) {
  TomlNode result;
  result.file = file;
  result.line = line_of(node);
  if (const auto* table = node.as_table()) {
    convert_entries(*table, file, mended, result);
  } else if (const auto* array = node.as_array()) {
    result.kind = TomlNode::Kind::kArray;
    for (const toml::node& item : *array) result.items.push_back(converted(item, file, mended));
  } else if (const auto* text = node.as_string()) {
    const bool faulty = mended && text->get() == kFaultyMark;
    result.kind = faulty ? TomlNode::Kind::kFaulty : TomlNode::Kind::kString;
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

std::string trimmed_line(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1));
}

bool is_header(const std::string& line) { return trimmed_line(line).starts_with('['); }

std::string header_path(const std::string& line) {
  const std::string header = trimmed_line(line);
  const std::size_t begin = header.find_first_not_of("[ ");
  const std::size_t end = header.find(']');
  return begin < end && end != std::string::npos ? trimmed_line(header.substr(begin, end - begin)) : "";
}

// The key of a line `key = value`; empty if it is none.
std::string assigned_key(const std::string& line) {
  const std::size_t equals = line.find('=');
  const std::string key = trimmed_line(std::string_view(line).substr(0, equals));
  const bool bare = std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-' || c == '.';
  });
  return equals != std::string::npos && bare ? key : std::string();
}

// "force[1].on" for a line `on = ...` below the second [[force]].
std::string dotted_key(const std::vector<std::string>& lines, std::size_t index) {
  const std::string key = assigned_key(lines[index]);
  std::string path;
  std::size_t same = 0;  // headers equal to the one that the line stands below
  bool list = false;
  for (std::size_t i = index; i-- > 0;) {
    if (!is_header(lines[i])) continue;
    if (path.empty()) {
      path = header_path(lines[i]);
      list = trimmed_line(lines[i]).starts_with("[[");
    } else if (header_path(lines[i]) == path) {
      ++same;
    }
  }
  if (path.empty()) return key;
  return path + (list ? "[" + std::to_string(same) + "]." : ".") + key;
}

// The commonest slips: 0.5 mm and linear without quotes.
std::string hint(std::string_view line) {
  const std::string value = trimmed_line(line.substr(line.find('=') + 1));
  const bool letters =
      std::any_of(value.begin(), value.end(), [](unsigned char c) { return std::isalpha(c); });
  if (!letters || value.find_first_of("\"'[{") != std::string::npos) return {};
  return std::isdigit(static_cast<unsigned char>(value.front()))
             ? "; a value with a unit stands in quotes, as in \"0.5 mm\""
             : "; a word stands in quotes";
}

// Takes the fault in the line at `index` out of `lines` and says where it was. False: not possible.
bool mend(std::vector<std::string>& lines, std::size_t index, bool duplicate,
          Diagnostic& diagnostic) {
  std::string& line = lines[index];
  if (const std::string key = assigned_key(line); !key.empty()) {
    diagnostic.key = dotted_key(lines, index);
    if (!duplicate) diagnostic.reason += hint(line);
    line = duplicate ? "\n" : key + " = " + std::string(kFaultyText) + "\n";
    return true;
  }
  if (!duplicate || !is_header(line)) return false;
  diagnostic.key = header_path(line);
  std::size_t last = index;
  do {
    lines[last] = "\n";
  } while (++last < lines.size() && !is_header(lines[last]));
  return true;
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
    case TomlNode::Kind::kFaulty:
      return "a faulty value";
  }
  return "nothing";
}

std::optional<TomlNode> parse_toml(std::string_view text, const std::string& file,
                                   std::vector<Diagnostic>& diagnostics) {
  std::vector<std::string> lines = lines_of(text);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (std::count(lines[i].begin(), lines[i].end(), '.') > kDeepestKey) {
      diagnostics.push_back({file, static_cast<int>(i) + 1, {}, "more than 1000 dots in one line"});
      return std::nullopt;
    }
  }
  for (int attempt = 0; attempt < kMostSyntaxErrors; ++attempt) {
    std::string remaining;
    for (const std::string& line : lines) remaining += line;
    const toml::parse_result parsed = toml::parse(remaining, file);
    if (parsed) {
      TomlNode root = converted(parsed.table(), file, attempt > 0);
      root.line = 0;  // the file as a whole
      return root;
    }

    // "Error while parsing key-value pair: what": the line says the rest.
    std::string description(parsed.error().description());
    if (const std::size_t colon = description.find(": "); description.starts_with("Error while")) {
      description.erase(0, colon == std::string::npos ? 0 : colon + 2);
    }
    const std::size_t fault =
        std::clamp<std::size_t>(parsed.error().source().begin.line, 1, lines.size());
    const bool duplicate = description.find("redefine") != std::string::npos;
    description = printable(description, kLongestDescription);
    Diagnostic diagnostic{
        file, static_cast<int>(fault), {}, (duplicate ? "given twice: " : "TOML: ") + description};
    const std::string before = lines[fault - 1];
    const bool mended = mend(lines, fault - 1, duplicate, diagnostic) && lines[fault - 1] != before;
    diagnostics.push_back(std::move(diagnostic));
    if (!mended) break;
  }
  return std::nullopt;
}

}  // namespace rotorub::scene
