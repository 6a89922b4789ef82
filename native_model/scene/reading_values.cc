// Reading of single values.

#include <algorithm>
#include <cmath>
#include <string>

#include "native_model/scene/reading.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

// Products of a few such numbers are still finite, and no property of a machine is as large.
constexpr double kLargestNumber = 1e60;

std::string got(const TomlNode& node) {
  if (node.kind == TomlNode::Kind::kString) return ", got \"" + printable(node.text) + "\"";
  if (node.kind == TomlNode::Kind::kInteger) return ", got " + std::to_string(node.integer);
  if (node.kind == TomlNode::Kind::kFloat) return ", got " + number_text(node.number);
  return ", got " + std::string(kind_name(node.kind));
}

}  // namespace

bool Reading::read_value(const Key& key, const Spot& here, Value& value) {
  const bool is_text = here.node.kind == TomlNode::Kind::kString;
  const bool is_array = here.node.kind == TomlNode::Kind::kArray;
  switch (key.type) {
    case ValueType::kNumber:
      return read_number(key, here, value.number);
    case ValueType::kWhole:
      if (is_text &&
          std::find(key.words.begin(), key.words.end(), here.node.text) != key.words.end()) {
        value.text = here.node.text;
        return true;
      }
      if (here.node.kind != TomlNode::Kind::kInteger ||
          !key.range.contains(static_cast<double>(here.node.integer)))
        break;
      value.whole = static_cast<int>(here.node.integer);
      return true;
    case ValueType::kWord:
      return read_word(key, here, value.whole);
    case ValueType::kFlag:
      if (here.node.kind != TomlNode::Kind::kBoolean) break;
      value.whole = here.node.boolean ? 1 : 0;
      return true;
    case ValueType::kPlanes:
      if (is_array) return read_pair(key, here, value.pair);
      if (!read_number(key, here, value.number)) return false;
      value.pair.setConstant(value.number);
      return true;
    case ValueType::kVector:
      if (!is_array) break;
      return read_pair(key, here, value.pair);
    case ValueType::kList:
      if (!is_array) break;
      if (here.node.items.empty() && key.required())
        return refuse(here, "expected " + key.expected() + ", got an empty list");
      return read_numbers(key, here, value.list);
    case ValueType::kText:
      if (!is_text || here.node.text.empty()) break;
      // The text is shown on terminals.
      if (printable(here.node.text, here.node.text.size()) != here.node.text)
        return refuse(here, "expected text without control characters" + got(here.node));
      value.text = here.node.text;
      return true;
  }
  return refuse(here, "expected " + key.expected() + got(here.node));
}

bool Reading::read_number(const Key& key, const Spot& here, double& number) {
  const auto unfit = [&](const char* what, const std::string& limit = {}) {
    return refuse(here,
                  what + ("expected " + key.expected(ValueType::kNumber)) + limit + got(here.node));
  };
  if (here.node.kind == TomlNode::Kind::kString) {
    const ParsedQuantity parsed = parse_quantity(here.node.text, key.quantity);
    if (!parsed.error.empty()) return refuse(here, parsed.error);
    number = parsed.value;
  } else if (here.node.kind == TomlNode::Kind::kInteger) {
    number = static_cast<double>(here.node.integer);
  } else if (here.node.kind == TomlNode::Kind::kFloat) {
    number = here.node.number;
  } else {
    return unfit("");
  }
  if (!std::isfinite(number)) return unfit("not finite: ");
  if (!key.range.contains(number)) return unfit("out of range: ");
  // A speed without a unit is accepted but may be meant in rpm.
  if (key.quantity.name == kSpin.name && key.name.ends_with("speed") &&
      key.type == ValueType::kNumber && here.node.kind != TomlNode::Kind::kString) {
    const std::string note = unitless_speed_note(here.path, number);
    if (!note.empty()) scene_.notes.push_back(note);
  }
  if (std::abs(number) <= kLargestNumber) return true;
  return unfit("too large: ", ", of a size up to " + number_text(kLargestNumber));
}

bool Reading::read_numbers(const Key& key, const Spot& here, std::vector<double>& list) {
  bool good = true;
  for (std::size_t i = 0; i < here.node.items.size(); ++i) {
    good =
        read_number(key, {here.node.items[i], list_element(here.path, i)}, list.emplace_back()) &&
        good;
  }
  return good;
}

bool Reading::read_pair(const Key& key, const Spot& here, Eigen::Vector2d& pair) {
  if (here.node.items.size() != 2) {
    return refuse(here, "expected " + key.expected() + ", got a list of " +
                            std::to_string(here.node.items.size()));
  }
  std::vector<double> list;
  if (!read_numbers(key, here, list)) return false;
  pair = {list[0], list[1]};
  return true;
}

bool Reading::read_word(const Key& key, const Spot& here, int& word_index) {
  const bool is_text = here.node.kind == TomlNode::Kind::kString;
  const std::string_view word = is_text ? current_word(here.node.text) : "";
  const auto found = std::find(key.words.begin(), key.words.end(), word);
  if (found != key.words.end()) {
    if (word != here.node.text) scene_.notes.push_back(old_word_note(here.path, here.node.text));
    word_index = static_cast<int>(found - key.words.begin());
    return true;
  }
  std::string reason = "expected " + key.expected() + got(here.node);
  const std::string_view meant = is_text ? nearest(here.node.text, key.words) : "";
  if (!meant.empty()) reason += ", did you mean \"" + std::string(meant) + "\"?";
  return refuse(here, reason);
}

}  // namespace rotorub::scene
