// Reading of single values, for TableReader.

#include <algorithm>
#include <cmath>
#include <string>

#include "native_model/scene/table_reader.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

using Kind = TomlNode::Kind;

// Products of a few such numbers are still finite, and no property of a machine is as large.
constexpr double kLargestNumber = 1e60;

std::string got(const TomlNode& node) {
  if (node.kind == Kind::kString) return ", got \"" + printable(node.text) + "\"";
  if (node.kind == Kind::kInteger) return ", got " + std::to_string(node.integer);
  if (node.kind == Kind::kFloat) return ", got " + number_text(node.number);
  return ", got " + std::string(kind_name(node.kind));
}

// Reads the value of one key. Each function returns false, after reporting the reason, if the value
// cannot be used.
struct ValueReader {
  const Key& key;
  std::vector<Diagnostic>& diagnostics;
  std::vector<std::string>& notes;

  bool fail(const TomlNode& node, const std::string& path, std::string reason) const {
    diagnostics.push_back({node.file, node.line, path, std::move(reason)});
    return false;
  }
  bool refuse(const TomlNode& node, const std::string& path) const {
    return fail(node, path, "expected " + key.expected() + got(node));
  }

  bool read(const TomlNode& node, const std::string& path, Value& value) const {
    switch (key.type) {
      case ValueType::kNumber:
        return read_number(node, path, value.number);
      case ValueType::kWhole:
        return read_whole(node, path, value);
      case ValueType::kWord:
        return read_word(node, path, value.whole);
      case ValueType::kFlag:
        if (node.kind != Kind::kBoolean) return refuse(node, path);
        value.whole = node.boolean ? 1 : 0;
        return true;
      case ValueType::kPlanes:
      case ValueType::kVector:
        return read_pair(node, path, value.pair);
      case ValueType::kList:
        return read_list(node, path, value.list);
      case ValueType::kText:
        if (node.kind != Kind::kString || node.text.empty()) return refuse(node, path);
        // The text is shown on terminals.
        if (printable(node.text, node.text.size()) != node.text)
          return fail(node, path, "expected text without control characters" + got(node));
        value.text = node.text;
        return true;
    }
    return false;
  }

  bool read_number(const TomlNode& node, const std::string& path, double& number) const {
    // Describes a single number, also within a list or pair.
    Key one = key;
    one.type = ValueType::kNumber;
    const std::string expected = "expected " + one.expected();
    if (node.kind == Kind::kString) {
      const ParsedQuantity parsed = parse_quantity(node.text, key.quantity);
      if (!parsed.error.empty()) return fail(node, path, parsed.error);
      number = parsed.value;
    } else if (node.kind == Kind::kInteger) {
      number = static_cast<double>(node.integer);
    } else if (node.kind == Kind::kFloat) {
      number = node.number;
    } else {
      return fail(node, path, expected + got(node));
    }
    if (!std::isfinite(number)) return fail(node, path, "not finite: " + expected + got(node));
    if (!key.range.contains(number))
      return fail(node, path, "out of range: " + expected + got(node));
    note_speed(node, path, number);
    if (std::abs(number) <= kLargestNumber) return true;
    return fail(
        node, path,
        "too large: " + expected + ", of a size up to " + number_text(kLargestNumber) + got(node));
  }

  // Adds a note for a speed without a unit, which is accepted but may be meant in rpm.
  void note_speed(const TomlNode& node, const std::string& path, double number) const {
    const bool turns = key.quantity.name == kSpin.name && key.name.ends_with("speed");
    if (!turns || key.type != ValueType::kNumber || node.kind == Kind::kString) return;
    if (const std::string note = unitless_speed_note(path, number); !note.empty())
      notes.push_back(note);
  }

  bool read_whole(const TomlNode& node, const std::string& path, Value& value) const {
    if (node.kind == Kind::kString &&
        std::find(key.words.begin(), key.words.end(), node.text) != key.words.end()) {
      value.text = node.text;
      return true;
    }
    if (node.kind != Kind::kInteger || !key.range.contains(static_cast<double>(node.integer)))
      return refuse(node, path);
    value.whole = static_cast<int>(node.integer);
    return true;
  }

  bool read_word(const TomlNode& node, const std::string& path, int& index) const {
    const std::string_view word = node.kind == Kind::kString ? current_word(node.text) : "";
    const auto found = std::find(key.words.begin(), key.words.end(), word);
    if (found != key.words.end()) {
      if (word != node.text) notes.push_back(old_word_note(path, node.text));
      index = static_cast<int>(found - key.words.begin());
      return true;
    }
    std::string reason = "expected " + key.expected() + got(node);
    const std::string_view meant = node.kind == Kind::kString ? nearest(node.text, key.words) : "";
    if (!meant.empty()) reason += ", did you mean \"" + std::string(meant) + "\"?";
    return fail(node, path, reason);
  }

  bool read_pair(const TomlNode& node, const std::string& path, Eigen::Vector2d& pair) const {
    if (key.type == ValueType::kPlanes && node.kind != Kind::kArray) {
      double number = 0.0;
      if (!read_number(node, path, number)) return false;
      pair.setConstant(number);
      return true;
    }
    if (node.kind != Kind::kArray) return refuse(node, path);
    if (node.items.size() != 2) {
      return fail(
          node, path,
          "expected " + key.expected() + ", got a list of " + std::to_string(node.items.size()));
    }
    const bool x_good = read_number(node.items[0], list_element(path, 0), pair.x());
    const bool y_good = read_number(node.items[1], list_element(path, 1), pair.y());
    return x_good && y_good;
  }

  bool read_list(const TomlNode& node, const std::string& path, std::vector<double>& list) const {
    if (node.kind != Kind::kArray) return refuse(node, path);
    if (node.items.empty() && key.required())
      return fail(node, path, "expected " + key.expected() + ", got an empty list");
    bool good = true;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      double number = 0.0;
      good = read_number(node.items[i], list_element(path, i), number) && good;
      list.push_back(number);
    }
    return good;
  }
};

}  // namespace

bool TableReader::read_value(const Key& key, const TomlNode& node, const std::string& path,
                             Value& value) {
  return ValueReader{key, diagnostics_, scene_.notes}.read(node, path, value);
}

}  // namespace rotorub::scene
