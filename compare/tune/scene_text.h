// A scene's text with some values replaced, its comments and its order kept.
#pragma once

#include <string>
#include <vector>

#include "compare/tune/setting.h"

namespace rotorub::tune {

// Replaces the value of a key where its table has one, a comment behind it kept; else adds the key
// to its table, the table at the end where there is none; takes a line away where the value is
// empty. Defaults are not added. Knows tables that stand under a header of their own ("[run]"), as
// nearly all do.
std::string with_values(const std::string& toml, const std::vector<KeyValue>& values);

// The text of `toml` (a whole scene) in this setting, judged against `event`: by with_values where
// that reads as the same setting, else written anew from the tree, without comments. `name`: of the
// scene's file.
struct TunedText {
  std::string text;
  bool comments_kept = true;
};
TunedText tuned_text(const std::string& toml, const std::string& name, const Setting& setting);

}  // namespace rotorub::tune
