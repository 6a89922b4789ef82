#include "compare/manual/scene_schema.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "native_model/scene/diagnostic.h"
#include "native_model/scene/schema.h"

namespace rotorub {
namespace {

using nlohmann::json;
using scene::Form;
using scene::Key;
using scene::Table;
using scene::ValueType;

// A number with or without a unit; the description lists the accepted units.
constexpr const char* kWithUnit =
    R"(^[ \t]*[+-]?([0-9]+[.]?[0-9]*|[.][0-9]+)([eE][+-]?[0-9]+)?[^0-9]*.*$)";

json bounded(const char* type, const scene::Range& range) {
  json schema{{"type", type}};
  if (std::isfinite(range.low)) schema[range.low_open ? "exclusiveMinimum" : "minimum"] = range.low;
  if (std::isfinite(range.high))
    schema[range.high_open ? "exclusiveMaximum" : "maximum"] = range.high;
  return schema;
}

json one_number(const Key& key) {
  return {{"anyOf", {bounded("number", key.range), {{"type", "string"}, {"pattern", kWithUnit}}}}};
}

json list_of(json item, int least, int most) {
  json schema{{"type", "array"}, {"items", std::move(item)}};
  if (least > 0) schema["minItems"] = least;
  if (most > 0) schema["maxItems"] = most;
  return schema;
}

json value_schema(const Key& key) {
  switch (key.type) {
    case ValueType::kNumber:
      return one_number(key);
    case ValueType::kWhole:
      if (key.words.empty()) return bounded("integer", key.range);
      return {{"anyOf", {bounded("integer", key.range), {{"enum", key.words}}}}};
    case ValueType::kWord:
      return {{"enum", key.words}};
    case ValueType::kFlag:
      return {{"type", "boolean"}};
    case ValueType::kPlanes:
      return {{"anyOf", {one_number(key), list_of(one_number(key), 2, 2)}}};
    case ValueType::kVector:
      return list_of(one_number(key), 2, 2);
    case ValueType::kList:
      return list_of(one_number(key), key.required() ? 1 : 0, 0);
    case ValueType::kText:
      return {{"type", "string"}, {"minLength", 1}};
  }
  return true;
}

// "shaft length. Expected: a length in m, > 0; units: m, mm, um, in, mil, cm. Required."
std::string described(const Key& key) {
  std::string text(key.meaning.empty() ? key.quantity.name : key.meaning);
  const bool measured =
      key.type != ValueType::kWord && key.type != ValueType::kFlag && key.type != ValueType::kText;
  if (measured) {
    text += ". Expected: " + key.expected();
    if (key.type != ValueType::kWhole) text += "; units: " + std::string(key.quantity.examples);
  }
  if (!key.kinds.empty()) text += ". With kind " + scene::join(key.kinds) + " only";
  if (key.form != Form::kEither)
    text += key.form == Form::kGeometry ? ". Geometry form" : ". Modal form";
  return text + (key.required() ? ". Required." : ". Default: " + key.fallback + ".");
}

// Requires the key in `schema` under either of its names.
void require(json& schema, const Key& key) {
  if (key.also.empty()) {
    schema["required"].push_back(key.name);
  } else {
    schema["allOf"].push_back(
        {{"anyOf", {{{"required", {key.name}}}, {{"required", {key.also}}}}}});
  }
}

// The keys that each word of `kind` requires and excludes.
json kind_rules(const Table& table) {
  const Key* kind = table.find("kind");
  json rules = json::array();
  if (kind == nullptr) return rules;
  for (const std::string_view word : kind->words) {
    json then = json::object(), shut = json::object();
    for (const Key& key : table.keys) {
      if (key.kinds.empty()) continue;
      if (!key.is_for(word)) {
        shut[std::string(key.name)] = false;
        if (!key.also.empty()) shut[std::string(key.also)] = false;
      } else if (key.required() && key.form == Form::kEither) {
        require(then, key);
      }
    }
    if (then.empty() && shut.empty()) continue;
    json given{{"properties", {{"kind", {{"const", word}}}}}};
    if (kind->default_word() != word) given["required"] = {"kind"};
    then["properties"] = shut;
    rules.push_back({{"if", given}, {"then", then}});
  }
  return rules;
}

json table_schema(const Table& table) {
  json schema{{"type", "object"}, {"properties", json::object()}};
  schema["additionalProperties"] = false;
  if (table.any_key) schema["additionalProperties"] = {{"type", {"number", "string"}}};
  for (const Key& key : table.keys) {
    json value = value_schema(key);
    value["description"] = described(key);
    if (!key.also.empty()) {  // one of its names, but not both
      schema["properties"][std::string(key.also)] = value;
      schema["allOf"].push_back({{"not", {{"required", {key.name, key.also}}}}});
    }
    schema["properties"][std::string(key.name)] = std::move(value);
    if (key.required() && key.form == Form::kEither && key.kinds.empty()) require(schema, key);
  }
  for (json& rule : kind_rules(table)) schema["allOf"].push_back(std::move(rule));
  return schema;
}

// The keys that one form of the rotor requires, and those that it excludes, depending on [rotor].
json form_rule(const Table& rotor) {
  json geometry = json::array(), shut = json::object();
  for (const Key& key : rotor.keys) {
    if (key.form != Form::kGeometry) continue;
    shut[std::string(key.name)] = false;
    if (key.required()) geometry.push_back(key.name);
  }
  for (const Table& table : scene::tables()) {
    const std::string_view path = table.path;
    if (table.form == Form::kGeometry && table.parent() == "rotor")
      shut[std::string(path.substr(6))] = false;
  }
  geometry.push_back("section");
  return {{"if", {{"required", {"modal"}}}},
          {"then", {{"properties", shut}}},
          {"else", {{"required", geometry}}}};
}

}  // namespace

std::string scene_schema() {
  json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "A scene of rotorub"},
            {"type", "object"},
            {"required", {"rotor"}},
            {"properties", json::object()},
            {"additionalProperties", false}};
  for (const Table& table : scene::tables()) {
    // Parents precede children.
    json* parent = &root;
    std::string_view name = table.path;
    for (std::size_t dot; (dot = name.find('.')) != std::string_view::npos;
         name.remove_prefix(dot + 1)) {
      parent = &(*parent)["properties"][std::string(name.substr(0, dot))];
      if (parent->contains("items")) parent = &(*parent)["items"];
    }
    json schema = table_schema(table);
    if (table.path == "rotor") schema["allOf"].push_back(form_rule(table));
    if (table.list) schema = {{"type", "array"}, {"items", std::move(schema)}};
    if (table.or_list) {
      // The parts of each auxiliary bearing are added below, as they are read.
      const std::size_t most = table.path == "contact" ? kMaxContacts : scene::kMaxMagneticBearings;
      schema = {{"anyOf", {schema, {{"type", "array"}, {"items", schema}, {"maxItems", most}}}}};
    }
    schema["description"] =
        std::string(table.meaning) + " Absent: " + std::string(table.when_absent) + ".";
    if (!parent->contains("anyOf")) {
      (*parent)["properties"][std::string(name)] = std::move(schema);
      continue;
    }
    // In [contact] and in a [[contact]], also as an alternative to a key's value there.
    json& either = (*parent)["anyOf"];
    for (json* object : {&either[0], &either[1]["items"]}) {
      json& value = (*object)["properties"][std::string(name)];
      value = table.for_key ? json{{"anyOf", {value, schema}}} : schema;
    }
  }
  // The tables within each [[contact]].
  json& listed = root["properties"]["contact"]["anyOf"][1]["items"]["properties"];
  for (const char* part : {"stator", "actuator", "controller"})
    listed[part] = root["properties"][part];
  for (const char* key : {"position", "velocity"})
    root["properties"]["stator"]["properties"].erase(key);
  return root.dump(1) + "\n";
}

}  // namespace rotorub
