// Reads the tables of a study key by key and collects all errors.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/schema.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::sweep {

// Writes a note to standard error if the word has a new name.
void say_old_word(const std::string& where, const std::string& word);

// One table of a study.
class StudyTable {
 public:
  // path: for error messages, "vary[1]". keys: all keys that the table may have.
  StudyTable(scene::TomlNode& node, std::string path, std::initializer_list<std::string_view> keys,
             std::vector<scene::Diagnostic>& diagnostics);
  // The table [name] of this one; empty if it is absent, or if it is not a table, which is
  // reported.
  StudyTable table(const std::string& name, std::initializer_list<std::string_view> keys) const;

  const scene::TomlNode* find(std::string_view key) const { return node_->find(key); }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  // Empty if absent, or if wrong and reported.
  std::optional<std::string> text(std::string_view key) const;
  // The word's index in `words`, which must be in the order of the enum.
  template <typename Enum>
  std::optional<Enum> word(std::string_view key, const std::vector<std::string_view>& words) const {
    const std::optional<std::size_t> place = place_of(key, words);
    return place ? std::optional(static_cast<Enum>(*place)) : std::nullopt;
  }
  std::optional<std::int64_t> whole(std::string_view key, std::int64_t least,
                                    std::int64_t most) const;
  std::optional<double> number(std::string_view key, const scene::Quantity& quantity) const;
  std::optional<double> number(const scene::TomlNode& value, const std::string& key,
                               const scene::Quantity& quantity) const;
  void missing(std::string_view key, const std::string& expected) const;
  void fail(std::string_view key, std::string reason) const;  // reports at the key, or at the table
  std::string path_of(std::string_view key) const;

 private:
  std::optional<std::size_t> place_of(std::string_view key,
                                      const std::vector<std::string_view>& words) const;

  scene::TomlNode* node_;
  scene::FileName file_;
  std::string path_;
  std::vector<scene::Diagnostic>* diagnostics_;
};

// The key of a scene at a path such as "force[0].amplitude". nullptr for a whole table or for a
// path that is not part of a scene (`reason` then says what to give). In [controller.config],
// which accepts any name, it is a number without a unit and without a name.
const scene::Key* scene_key(std::string_view path, std::string& reason);

// The shortest text that reads back to the same bits.
std::string number_text(double value);

// Whether a single number is a value of the key at the path. A key for both planes or an element of
// a list counts too. key: may be null.
bool takes_number(std::string_view path, const scene::Key* key);

}  // namespace rotorub::sweep
