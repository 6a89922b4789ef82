// The reference of the scene's tables and keys, from the schema.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {
namespace {

constexpr const char* kReferenceBegin = "<!-- reference: begin (from the schema) -->\n";
constexpr const char* kReferenceEnd = "<!-- reference: end -->\n";

std::string form_text(Form form) {
  if (form == Form::kGeometry) return "geometry";
  return form == Form::kModal ? "modal" : "";
}

// "N/m, one or [x, y], >= 0"; "list, >= 0" without a unit
std::string value_text(const Key& key) {
  const bool pure = key.quantity.unit == kPure.unit;
  const std::string unit = pure ? "" : std::string(key.quantity.unit) + ", ";
  const std::string bounds = key.range.text.empty() ? "" : ", " + std::string(key.range.text);
  switch (key.type) {
    case ValueType::kNumber:
      return (pure ? "number" : std::string(key.quantity.unit)) + bounds;
    case ValueType::kWhole:
      return "whole number" + bounds + (key.words.empty() ? "" : ", or `" + join(key.words) + "`");
    case ValueType::kPlanes:
      return unit + "one or [x, y]" + bounds;
    case ValueType::kVector:
      return unit + "[x, y]" + bounds;
    case ValueType::kList:
      return unit + "list" + bounds;
    case ValueType::kFlag:
      return "true or false";
    case ValueType::kText:
      return "text";
    case ValueType::kWord:
      break;
  }
  std::string text;
  for (std::string_view word : key.words)
    text += (text.empty() ? "`" : ", `") + std::string(word) + "`";
  return text;
}

// Without another description the quantity's name ("a force") is the meaning.
std::string meaning_text(const Key& key) {
  std::string text(key.meaning.empty() ? key.quantity.name : key.meaning);
  std::string limits;
  if (!key.kinds.empty()) limits = "`" + join(key.kinds) + "`";
  if (const std::string form = form_text(key.form); !form.empty()) {
    limits += (limits.empty() ? "" : ", ") + form;
  }
  return limits.empty() ? text : text + " (" + limits + ")";
}

std::string cells(const Key& key) {
  return " | " + value_text(key) + " | " + (key.required() ? "required" : key.fallback) + " | " +
         meaning_text(key) + " |\n";
}

// Neighbours that differ only in their names share a row.
std::string rows(const std::vector<Key>& keys) {
  std::string text;
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const bool shared = i > 0 && cells(keys[i - 1]) == cells(keys[i]);
    if (i > 0 && !shared) text += cells(keys[i - 1]);
    text += (shared ? ", `" : "| `") + std::string(keys[i].name) + "`";
    if (!keys[i].also.empty()) text += ", `" + std::string(keys[i].also) + "`";
  }
  return text + cells(keys.back());
}

// Markdown: a section for every table with its keys, units, ranges, defaults and meanings. Stands
// in mjcf/docs/keys.md between the marks above; a test holds the two together.
std::string reference_markdown() {
  std::string text;
  for (const Table& table : tables()) {
    const std::string path(table.path);
    text += "### `" + (table.list ? "[[" + path + "]]" : "[" + path + "]") + "`\n\n";
    text += std::string(table.meaning);
    if (!table.kinds.empty()) text += " `" + join(table.kinds) + "` only.";
    text += " Absent: " + std::string(table.when_absent) + ".\n\n";
    if (table.keys.empty()) continue;
    text += "| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
    text += rows(table.keys) + "\n";
  }
  return text;
}

// ROTORUB_UPDATE_REFERENCE=1 in the environment writes the section instead.
TEST(Reference, StandsInTheDocumentAsTheSchemaHasIt) {
  const std::string path = std::string(ROTORUB_MJCF_DIR) + "/docs/keys.md";
  std::ifstream file(path);
  std::stringstream content;
  content << file.rdbuf();
  std::string document = content.str();
  const std::size_t begin = document.find(kReferenceBegin), end = document.find(kReferenceEnd);
  ASSERT_TRUE(begin != std::string::npos && end != std::string::npos) << "no marks in " << path;

  const std::size_t first = begin + std::string(kReferenceBegin).size();
  const std::string expected = "\n" + reference_markdown();
  if (std::getenv("ROTORUB_UPDATE_REFERENCE") != nullptr) {
    std::ofstream(path) << document.replace(first, end - first, expected);
    return;
  }
  EXPECT_EQ(document.substr(first, end - first), expected)
      << path << " is behind the schema; run this test with ROTORUB_UPDATE_REFERENCE=1";
}

TEST(Schema, NamesEveryKeyOnceAndKeepsKindsAndWordsInStep) {
  std::set<std::string> names;
  for (const Table& table : tables()) {
    EXPECT_FALSE(table.meaning.empty() || table.when_absent.empty()) << table.path;
    const Key* kind = table.find("kind");
    for (const Key& key : table.keys) {
      const std::string path = std::string(table.path) + "." + std::string(key.name);
      EXPECT_TRUE(names.insert(path).second) << path << " stands twice";
      if (key.type != ValueType::kWhole) {  // which may have words beside its numbers
        EXPECT_EQ(key.type == ValueType::kWord, !key.words.empty()) << path;
      }
      EXPECT_NE(key.store, nullptr) << path;
      for (std::string_view word : key.kinds) {
        ASSERT_NE(kind, nullptr) << path;
        EXPECT_NE(std::find(kind->words.begin(), kind->words.end(), word), kind->words.end())
            << path << " is for a kind that is none: " << word;
      }
    }
  }
}

}  // namespace
}  // namespace rotorub::scene
