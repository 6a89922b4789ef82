// Converts TOML text to a plain tree that keeps the line of every value, and back. The only files
// that use the TOML library.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "native_model/scene/diagnostic.h"

namespace rotorub::scene {

// The name of a file, which every value of a scene carries. Each name exists once in the process,
// so that copying trees of values is cheap.
class FileName {
 public:
  FileName() : FileName(std::string_view()) {}
  FileName(std::string_view name) : name_(&kept(name)) {}                  // NOLINT: is a name
  FileName(const std::string& name) : FileName(std::string_view(name)) {}  // NOLINT: is a name
  FileName(const char* name) : FileName(std::string_view(name)) {}         // NOLINT: is a name
  operator const std::string&() const { return *name_; }                   // NOLINT: is a name
  bool operator==(const FileName& other) const { return name_ == other.name_; }

 private:
  // Thread-safe. Names are kept until the end of the process, because there are few.
  static const std::string& kept(std::string_view name);
  const std::string* name_;
};

struct TomlNode {
  // kFaulty: a value that could not be read, which is already reported.
  enum class Kind { kTable, kArray, kString, kInteger, kFloat, kBoolean, kDate, kFaulty };

  Kind kind = Kind::kTable;
  FileName file;                                          // that contains the value
  int line = 0;                                           // from 1; 0: unknown
  std::vector<std::pair<std::string, TomlNode>> entries;  // kTable, in the order of the file
  std::vector<TomlNode> items;                            // kArray
  std::string text;                                       // kString, kDate
  std::int64_t integer = 0;                               // kInteger
  double number = 0.0;                                    // kFloat
  bool boolean = false;                                   // kBoolean

  TomlNode();  // defined in the source file, because clang needs it while `entries` is incomplete

  // The entry of a table, or nullptr.
  TomlNode* find(std::string_view key);
  const TomlNode* find(std::string_view key) const;
};

// "a string", "an array", ...
std::string_view kind_name(TomlNode::Kind kind);

// Parses `text`. Returns nothing if it cannot be read to its end. Syntax errors and duplicates go
// to `diagnostics`. After a fault in a single `key = value` line, or a table given twice, parsing
// continues, so that one mistake does not hide others. Bad text causes neither an exception nor
// an abort.
std::optional<TomlNode> parse_toml(std::string_view text, const std::string& file,
                                   std::vector<Diagnostic>& diagnostics);

// TOML text of a table. parse_toml of it returns the same tree, with numbers equal to the last bit,
// except for the lines.
std::string write_toml(const TomlNode& root);

// The tree that is read is traversed recursively, so that deeper keys would exhaust the stack.
inline constexpr int kDeepestKey = 1000;  // dots
// The first line with a key of more than kDeepestKey dots, including the dots of the keys around it
// (inline tables); 0 if there is none. Dots in values, strings and comments do not count.
int line_of_too_deep_key(std::string_view text);

}  // namespace rotorub::scene
