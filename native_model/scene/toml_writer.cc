// Implements write_toml of toml_source.h.

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <string>
#include <string_view>

#include "native_model/scene/toml_source.h"

namespace rotorub::scene {
namespace {

using Kind = TomlNode::Kind;

std::string in_quotes(std::string_view text) {
  std::string result = "\"";
  for (char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20 || byte == 0x7f) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04X", static_cast<unsigned>(byte));
      result += escape.data();
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string key_text(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-';
  });
  return bare ? std::string(key) : in_quotes(key);
}

// The shortest text that reads back as the same double.
std::string float_text(double number) {
  std::array<char, 40> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
  const std::string text(buffer.data(), end);
  const bool whole = text.find_first_of(".en") == std::string::npos;  // n: inf and nan
  return whole ? text + ".0" : text;
}

std::string value_text(const TomlNode& node) {
  switch (node.kind) {
    case Kind::kString:
      return in_quotes(node.text);
    case Kind::kInteger:
      return std::to_string(node.integer);
    case Kind::kFloat:
      return float_text(node.number);
    case Kind::kBoolean:
      return node.boolean ? "true" : "false";
    case Kind::kDate:
    case Kind::kFaulty:
      return in_quotes(node.text);
    case Kind::kArray: {
      std::string text = "[";
      for (const TomlNode& item : node.items) {
        if (text.size() > 1) text += ", ";
        text += value_text(item);
      }
      return text + "]";
    }
    case Kind::kTable: {
      std::string text = "{";
      for (const auto& [key, value] : node.entries) {
        text += (text.size() > 1 ? ", " : " ") + key_text(key) + " = " + value_text(value);
      }
      return text + " }";
    }
  }
  return {};
}

bool is_table_list(const TomlNode& node) {
  return node.kind == Kind::kArray && !node.items.empty() &&
         std::all_of(node.items.begin(), node.items.end(),
                     [](const TomlNode& item) { return item.kind == Kind::kTable; });
}

void write_table(const TomlNode& table, const std::string& path, std::string& text) {
  // Plain values come first, because after a sub-table's header they would belong to that table.
  for (const auto& [key, value] : table.entries) {
    if (value.kind != Kind::kTable && !is_table_list(value)) {
      text += key_text(key) + " = " + value_text(value) + "\n";
    }
  }
  for (const auto& [key, value] : table.entries) {
    const std::string child = path.empty() ? key_text(key) : path + "." + key_text(key);
    if (value.kind == Kind::kTable) {
      text += "\n[" + child + "]\n";
      write_table(value, child, text);
    } else if (is_table_list(value)) {
      for (const TomlNode& item : value.items) {
        text += "\n[[" + child + "]]\n";
        write_table(item, child, text);
      }
    }
  }
}

}  // namespace

std::string write_toml(const TomlNode& root) {
  std::string text;
  write_table(root, {}, text);
  return text.starts_with('\n') ? text.substr(1) : text;
}

}  // namespace rotorub::scene
