// TOML text as a plain tree that keeps the line of everything, and back to text. The only place
// that knows the TOML library.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "native_model/scene/diagnostic.h"

namespace rotorub::scene {

// The name of a file, as every value of a scene carries it: one copy in the process, so that trees
// of values are copied at no cost.
class FileName {
 public:
  FileName() : FileName(std::string_view()) {}
  FileName(std::string_view name) : name_(&kept(name)) {}                  // NOLINT: is a name
  FileName(const std::string& name) : FileName(std::string_view(name)) {}  // NOLINT: is a name
  FileName(const char* name) : FileName(std::string_view(name)) {}         // NOLINT: is a name
  operator const std::string&() const { return *name_; }                   // NOLINT: is a name
  bool operator==(const FileName& other) const { return name_ == other.name_; }

 private:
  // From any thread; names are kept to the end of the process: there are few.
  static const std::string& kept(std::string_view name);
  const std::string* name_;
};

struct TomlNode {
  // kFaulty: a value that could not be read and is already reported.
  enum class Kind { kTable, kArray, kString, kInteger, kFloat, kBoolean, kDate, kFaulty };

  Kind kind = Kind::kTable;
  FileName file;                                          // where it stands
  int line = 0;                                           // from 1; 0: no line
  std::vector<std::pair<std::string, TomlNode>> entries;  // kTable, in the order of the file
  std::vector<TomlNode> items;                            // kArray
  std::string text;                                       // kString, kDate
  std::int64_t integer = 0;                               // kInteger
  double number = 0.0;                                    // kFloat
  bool boolean = false;                                   // kBoolean

  TomlNode();  // in the source: clang asks for it while `entries` is being made of it

  // The entry of a table, or nullptr.
  TomlNode* find(std::string_view key);
  const TomlNode* find(std::string_view key) const;
};

// "a string", "an array", ...
std::string_view kind_name(TomlNode::Kind kind);

// Reads `text`; nothing if it cannot be read to its end. Syntax errors and duplicates go to
// `diagnostics`. Where the fault lies in a single `key = value` line or a table given twice, the
// reading goes on, so that one slip does not hide the others. Never throws on bad text, never
// aborts.
std::optional<TomlNode> parse_toml(std::string_view text, const std::string& file,
                                   std::vector<Diagnostic>& diagnostics);

// TOML text of a table: parse_toml gives the same tree again (numbers to the last bit), lines
// aside.
std::string write_toml(const TomlNode& root);

}  // namespace rotorub::scene
