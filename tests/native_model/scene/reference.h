// The reference of the scene's tables and keys, from the schema.
#pragma once

#include <string>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/schema.h"

namespace rotorub::scene {

inline constexpr const char* kReferenceBegin = "<!-- reference: begin (from the schema) -->\n";
inline constexpr const char* kReferenceEnd = "<!-- reference: end -->\n";

inline std::string form_text(Form form) {
  if (form == Form::kGeometry) return "geometry form";
  return form == Form::kModal ? "modal form" : "";
}

inline std::string type_text(const Key& key) {
  switch (key.type) {
    case ValueType::kNumber:
      return std::string(key.quantity.unit);
    case ValueType::kWhole:
      return key.words.empty() ? "whole number" : "whole number, `" + join(key.words) + "`";
    case ValueType::kPlanes:
      return std::string(key.quantity.unit) + ", one or [x, y]";
    case ValueType::kVector:
      return std::string(key.quantity.unit) + ", [x, y]";
    case ValueType::kList:
      return std::string(key.quantity.unit) + ", list";
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

// The quantity's name ("a force") is the meaning where no other is given.
inline std::string meaning_text(const Key& key) {
  std::string text(key.meaning.empty() ? key.quantity.name : key.meaning);
  std::string limits;
  if (!key.kinds.empty()) limits = "`" + join(key.kinds) + "` only";
  if (const std::string form = form_text(key.form); !form.empty()) {
    limits += (limits.empty() ? "" : ", ") + form;
  }
  return limits.empty() ? text : text + " (" + limits + ")";
}

inline std::string row(const Key& key) {
  const std::string also = key.also.empty() ? "" : ", `" + std::string(key.also) + "`";
  return "| `" + std::string(key.name) + "`" + also + " | " + type_text(key) + " | " +
         std::string(key.range.text) + " | " + (key.required() ? "required" : key.fallback) +
         " | " + meaning_text(key) + " |\n";
}

// Markdown: a section for every table with its keys, units, ranges, defaults and meanings. Stands
// in mjcf/README.md between the marks above; a test holds the two together.
inline std::string reference_markdown() {
  std::string text;
  for (const Table& table : tables()) {
    const std::string path(table.path);
    text += "### `" + (table.list ? "[[" + path + "]]" : "[" + path + "]") + "`\n\n";
    text += std::string(table.meaning);
    if (!table.kinds.empty()) text += " `" + join(table.kinds) + "` only.";
    text += " Absent: " + std::string(table.when_absent) + ".\n\n";
    if (table.keys.empty()) continue;
    text +=
        "| key | unit or words | range | default | meaning |\n| --- | --- | --- | --- | --- |\n";
    for (const Key& key : table.keys) text += row(key);
    text += "\n";
  }
  return text;
}

}  // namespace rotorub::scene
