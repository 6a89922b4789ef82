// TableReader: single values.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>

#include "native_model/scene/old_words.h"
#include "native_model/scene/printable.h"
#include "native_model/scene/table_reader.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

using Kind = TomlNode::Kind;

// Products of a few such numbers are still finite; nothing of a machine is so large.
constexpr double kLargestNumber = 1e60;

std::string got(const TomlNode& node) {
  if (node.kind == Kind::kString) return ", got \"" + printable(node.text) + "\"";
  if (node.kind == Kind::kInteger) return ", got " + std::to_string(node.integer);
  if (node.kind == Kind::kFloat) return ", got " + number_text(node.number);
  return ", got " + std::string(kind_name(node.kind));
}

}  // namespace

bool TableReader::refuse(const Key& key, const TomlNode& node, const std::string& path) {
  fail(node, path, "expected " + key.expected() + got(node));
  return false;
}

bool TableReader::read_value(const Key& key, const TomlNode& node, const std::string& path,
                             Value& value) {
  switch (key.type) {
    case ValueType::kNumber:
      return read_number(key, node, path, value.number);
    case ValueType::kWhole:
      if (node.kind == Kind::kString &&
          std::find(key.words.begin(), key.words.end(), node.text) != key.words.end()) {
        value.text = node.text;
        return true;
      }
      return read_whole(key, node, path, value.whole);
    case ValueType::kWord:
      return read_word(key, node, path, value.whole);
    case ValueType::kFlag:
      return read_flag(key, node, path, value.whole);
    case ValueType::kPlanes:
    case ValueType::kVector:
      return read_pair(key, node, path, value.pair);
    case ValueType::kList:
      return read_list(key, node, path, value.list);
    case ValueType::kText:
      return read_text(key, node, path, value.text);
  }
  return false;
}

bool TableReader::read_number(const Key& key, const TomlNode& node, const std::string& path,
                              double& number) {
  // What one number is, whatever the list or pair around it.
  Key one = key;
  one.type = ValueType::kNumber;
  if (node.kind == Kind::kString) {
    const ParsedQuantity parsed = parse_quantity(node.text, key.quantity);
    if (!parsed.error.empty()) {
      fail(node, path, parsed.error);
      return false;
    }
    number = parsed.value;
  } else if (node.kind == Kind::kInteger) {
    number = static_cast<double>(node.integer);
  } else if (node.kind == Kind::kFloat) {
    number = node.number;
  } else {
    fail(node, path, "expected " + one.expected() + got(node));
    return false;
  }
  if (!std::isfinite(number) || !key.range.contains(number)) {
    const std::string where = std::isfinite(number) ? "out of range" : "not finite";
    fail(node, path, where + ": expected " + one.expected() + got(node));
    return false;
  }
  if (std::abs(number) > kLargestNumber) {
    fail(node, path,
         "too large: expected " + one.expected() + ", of a size up to " +
             number_text(kLargestNumber) + got(node));
    return false;
  }
  return true;
}

bool TableReader::read_whole(const Key& key, const TomlNode& node, const std::string& path,
                             int& whole) {
  if (node.kind != Kind::kInteger || !key.range.contains(static_cast<double>(node.integer)))
    return refuse(key, node, path);
  whole = static_cast<int>(node.integer);
  return true;
}

bool TableReader::read_word(const Key& key, const TomlNode& node, const std::string& path,
                            int& index) {
  const std::string_view word = node.kind == Kind::kString ? current_word(node.text) : "";
  for (std::size_t i = 0; i < key.words.size(); ++i) {
    if (word.empty() || word != key.words[i]) continue;
    if (word != node.text) scene_.notes.push_back(old_word_note(path, node.text));
    index = static_cast<int>(i);
    return true;
  }
  std::string reason = "expected " + key.expected() + got(node);
  const std::string_view meant = node.kind == Kind::kString ? nearest(node.text, key.words) : "";
  if (!meant.empty()) reason += ", did you mean \"" + std::string(meant) + "\"?";
  fail(node, path, reason);
  return false;
}

bool TableReader::read_text(const Key& key, const TomlNode& node, const std::string& path,
                            std::string& text) {
  if (node.kind != Kind::kString || node.text.empty()) return refuse(key, node, path);
  text = node.text;
  return true;
}

bool TableReader::read_flag(const Key& key, const TomlNode& node, const std::string& path,
                            int& flag) {
  if (node.kind != Kind::kBoolean) return refuse(key, node, path);
  flag = node.boolean ? 1 : 0;
  return true;
}

bool TableReader::read_pair(const Key& key, const TomlNode& node, const std::string& path,
                            Eigen::Vector2d& pair) {
  if (key.type == ValueType::kPlanes && node.kind != Kind::kArray) {
    double number = 0.0;
    if (!read_number(key, node, path, number)) return false;
    pair.setConstant(number);
    return true;
  }
  if (node.kind != Kind::kArray || node.items.size() != 2) {
    fail(node, path,
         "expected " + key.expected() +
             (node.kind == Kind::kArray ? ", got a list of " + std::to_string(node.items.size())
                                        : got(node)));
    return false;
  }
  const bool x_good = read_number(key, node.items[0], list_element(path, 0), pair.x());
  const bool y_good = read_number(key, node.items[1], list_element(path, 1), pair.y());
  return x_good && y_good;
}

bool TableReader::read_list(const Key& key, const TomlNode& node, const std::string& path,
                            std::vector<double>& list) {
  if (node.kind != Kind::kArray) return refuse(key, node, path);
  if (node.items.empty() && key.required()) {
    fail(node, path, "expected " + key.expected() + ", got an empty list");
    return false;
  }
  bool good = true;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    double number = 0.0;
    good = read_number(key, node.items[i], list_element(path, i), number) && good;
    list.push_back(number);
  }
  return good;
}

}  // namespace rotorub::scene
