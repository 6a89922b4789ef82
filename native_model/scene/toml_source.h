// TOML text as a plain tree that keeps the line of everything, and back to text. The only place
// that knows the TOML library.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "native_model/scene/diagnostic.h"

namespace rotorub::scene {

struct TomlNode {
  enum class Kind { kTable, kArray, kString, kInteger, kFloat, kBoolean, kDate };

  Kind kind = Kind::kTable;
  std::string file;                                       // where it stands
  int line = 0;                                           // from 1; 0: no line
  std::vector<std::pair<std::string, TomlNode>> entries;  // kTable, in the order of the file
  std::vector<TomlNode> items;                            // kArray
  std::string text;                                       // kString, kDate
  std::int64_t integer = 0;                               // kInteger
  double number = 0.0;                                    // kFloat
  bool boolean = false;                                   // kBoolean

  // The entry of a table, or nullptr.
  TomlNode* find(std::string_view key);
  const TomlNode* find(std::string_view key) const;
};

// "a string", "an array", ...
std::string_view kind_name(TomlNode::Kind kind);

struct TomlDocument {
  TomlNode root;       // a table
  bool whole = false;  // false: some of the text could not be read, and `root` lacks it
};

// Reads `text`. Syntax errors and duplicate keys go to `diagnostics`; where the fault is a single
// `key = value` line, the reading goes on without it. Never throws on bad text, never aborts.
TomlDocument parse_toml(std::string_view text, const std::string& file,
                        std::vector<Diagnostic>& diagnostics);

// TOML text of a table: parse_toml gives the same tree again (numbers to the last bit), lines
// aside.
std::string write_toml(const TomlNode& root);

}  // namespace rotorub::scene
