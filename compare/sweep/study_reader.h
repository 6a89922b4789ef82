// The tables of a study, key by key, with every mistake kept.
#pragma once

#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "native_model/scene/schema.h"
#include "native_model/scene/toml_source.h"

namespace rotorub::sweep {

// A note on standard error, where it is a word that has another name now.
void say_old_word(const std::string& where, const std::string& word);

// One table: what is asked of it is what it may hold.
class StudyTable {
 public:
  // `path`: for diagnostics, "vary[1]". `keys`: all that it may hold.
  StudyTable(const scene::TomlNode& node, std::string path,
             std::initializer_list<std::string_view> keys,
             std::vector<scene::Diagnostic>& diagnostics);

  const scene::TomlNode* find(std::string_view key) const { return node_->find(key); }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  // Nothing: absent, or reported.
  std::optional<std::string> text(std::string_view key) const;
  // Which of the words, which stand in the order of an enum.
  template <typename Enum>
  std::optional<Enum> word(std::string_view key, std::span<const std::string_view> words) const {
    const std::optional<std::size_t> place = place_of(key, words);
    return place ? std::optional(static_cast<Enum>(*place)) : std::nullopt;
  }
  std::optional<std::int64_t> whole(std::string_view key, std::int64_t least,
                                    std::int64_t most) const;
  std::optional<double> number(std::string_view key, const scene::Quantity& quantity) const;
  std::optional<double> number(const scene::TomlNode& value, const std::string& key,
                               const scene::Quantity& quantity) const;
  void missing(std::string_view key, const std::string& expected) const;
  void fail(std::string_view key, std::string reason) const;  // at the key, or at the table
  std::string path_of(std::string_view key) const;

 private:
  std::optional<std::size_t> place_of(std::string_view key,
                                      std::span<const std::string_view> words) const;

  const scene::TomlNode* node_;
  std::string path_;
  std::vector<scene::Diagnostic>* diagnostics_;
};

// The key of a scene that a path such as "force[0].amplitude" leads to; nullptr: a whole table, or
// nothing of a scene (`reason` then says what is accepted). In [controller.config], which takes any
// name, a number without a unit and without a name.
const scene::Key* scene_key(std::string_view path, std::string& reason);

// Shortest text that reads back to the same bits.
std::string number_text(double value);

// Whether one number is a value of the key at the path: of both planes, or of an element of a list
// too. key: may be null.
bool takes_number(std::string_view path, const scene::Key* key);

}  // namespace rotorub::sweep
