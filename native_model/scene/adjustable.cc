#include "native_model/scene/adjustable.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string_view>

#include "native_model/scene/text.h"
#include "native_model/scene/units.h"

namespace rotorub::scene {
namespace {

// Keys of one table, in the order in which people read them.
struct KeysOfTable {
  std::string_view table;
  std::vector<std::string_view> keys;
};

const std::vector<KeysOfTable>& adjustable_keys() {
  static const std::vector<std::string_view> gains = {
      "preload", "gap_time", "bandwidth", "switching_gain", "stiffness", "damping", "feedback"};
  static const std::vector<KeysOfTable> all = {
      {"contact", {"friction", "clearance", "restitution"}},
      {"rotor", {"speed"}},
      {"rotor.disc", {"eccentricity", "unbalance"}},
      {"force", {"amplitude", "static_moment", "vector"}},
      {"controller", gains},
      {"contact.controller", gains},
      {"magnetic_bearing.control", {"stiffness", "damping"}},
  };
  return all;
}

// A table of the scene and its path: "rotor.disc[1]".
struct TablePlace {
  std::string path;
  const TomlNode* node;
};

std::vector<TablePlace> table_places(const TomlNode& root, std::string_view table) {
  std::vector<TablePlace> places = {{"", &root}};
  while (!table.empty()) {
    const std::string name(table.substr(0, table.find('.')));
    table.remove_prefix(std::min(table.size(), name.size() + 1));
    std::vector<TablePlace> next;
    for (const TablePlace& place : places) {
      const TomlNode* found = place.node->find(name);
      if (!found) continue;
      const std::string path = place.path.empty() ? name : place.path + "." + name;
      if (found->kind == TomlNode::Kind::kTable) next.push_back({path, found});
      for (std::size_t k = 0; k < found->items.size(); ++k)
        next.push_back({list_element(path, k), &found->items[k]});
    }
    places = std::move(next);
  }
  return places;
}

// SI; empty if it is not a single number.
std::optional<double> single_number(const TomlNode& node, const Quantity& quantity) {
  switch (node.kind) {
    case TomlNode::Kind::kFloat:
      return node.number;
    case TomlNode::Kind::kInteger:
      return static_cast<double>(node.integer);
    case TomlNode::Kind::kString: {
      const ParsedQuantity parsed = parse_quantity(node.text, quantity);
      return parsed.error.empty() ? std::optional(parsed.value) : std::nullopt;
    }
    default:
      return std::nullopt;
  }
}

std::optional<double> number_at(const TablePlace& place, const Key& key) {
  for (const std::string_view name : {key.name, key.also}) {
    const TomlNode* node = name.empty() ? nullptr : place.node->find(name);
    if (node) return single_number(*node, key.quantity);
  }
  const bool law = place.path.ends_with("controller");
  if (!law || key.type != ValueType::kNumber || key.standard.empty()) return std::nullopt;
  return std::strtod(key.standard.c_str(), nullptr);
}

// The x and y of a vector, in SI; empty if the key has no vector of two numbers.
std::optional<std::pair<double, double>> pair_at(const TablePlace& place, const Key& key) {
  const TomlNode* node = place.node->find(key.name);
  if (key.type != ValueType::kVector || !node || node->items.size() != 2) return std::nullopt;
  const auto x = single_number(node->items[0], key.quantity);
  const auto y = single_number(node->items[1], key.quantity);
  return x && y ? std::optional(std::pair(*x, *y)) : std::nullopt;
}

std::vector<Adjustable> numbers_of(const TomlNode& root, const std::vector<KeysOfTable>& asked) {
  std::vector<Adjustable> all;
  for (const auto& [path, keys] : asked) {
    const Table* table = find_table(path);
    for (const TablePlace& place : table_places(root, path)) {
      const TomlNode* kind = place.node->find("kind");
      for (const std::string_view name : keys) {
        const Key* key = table ? table->find(name) : nullptr;
        if (!key || !key->is_for(kind ? kind->text : "")) continue;
        const std::string at = place.path + "." + std::string(key->name);
        if (const auto pair = pair_at(place, *key)) {
          all.push_back({at, key, pair->first, Adjustable::Part::kX});
          all.push_back({at, key, pair->second, Adjustable::Part::kY});
        } else if (const std::optional<double> value = number_at(place, *key)) {
          all.push_back({at, key, *value});
        }
      }
    }
  }
  return all;
}

}  // namespace

std::vector<Adjustable> adjustable_numbers(const TomlNode& root) {
  return numbers_of(root, adjustable_keys());
}

std::vector<Adjustable> speeds_beside_the_rotors(const TomlNode& root) {
  return numbers_of(root, {{"drive", {"speed", "synchronous_speed"}}, {"force", {"frequency"}}});
}

std::vector<std::string> overrides_to(const std::vector<Adjustable>& numbers,
                                      const std::vector<double>& values) {
  constexpr int kEveryDigit = 17;
  std::vector<std::string> overrides;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const bool vector = numbers[k].part == Adjustable::Part::kX;
    const std::size_t last = vector ? k + 1 : k;
    const bool changed = values[k] != numbers[k].value || values[last] != numbers[last].value;
    std::string text = number_text(values[k], kEveryDigit);
    if (vector) text = "[" + text + ", " + number_text(values[last], kEveryDigit) + "]";
    if (changed) overrides.push_back(numbers[k].path + "=" + text);
    k = last;
  }
  return overrides;
}

}  // namespace rotorub::scene
