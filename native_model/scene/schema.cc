#include "native_model/scene/schema.h"

#include <algorithm>
#include <cstdlib>

#include "native_model/scene/diagnostic.h"

namespace rotorub::scene {

Range::Range(std::string_view of_text) : text(of_text) {
  // The number after the first `mark` characters.
  const auto number = [this](std::size_t mark) {
    return std::strtod(std::string(text.substr(mark)).c_str(), nullptr);
  };
  if (text.starts_with("in ")) {
    low = number(4);
    high = number(text.find(',') + 1);
    low_open = text[3] == '(';
    high_open = text.back() == ')';
  } else if (text.starts_with('>')) {
    low_open = !text.starts_with(">=");
    low = number(low_open ? 1 : 2);
  }
}

std::string_view Key::default_word() const {
  if (required() || type != ValueType::kWord) return {};
  return std::string_view(standard).substr(1, standard.size() - 2);  // without the backquotes
}

std::string Key::expected(ValueType as_type) const {
  const std::string bounds = range.text.empty() ? "" : ", " + std::string(range.text);
  const std::string unit = quantity.unit == kPure.unit ? "" : " in " + std::string(quantity.unit);
  const std::string what = std::string(quantity.name) + unit + bounds;
  switch (as_type) {
    case ValueType::kNumber:
      return what;
    case ValueType::kWhole:
      return "a whole number" + bounds + (words.empty() ? "" : ", or \"" + join(words) + "\"");
    case ValueType::kPlanes:
      return what + ", or [x, y] of them";
    case ValueType::kVector:
      return "[x, y], each " + what;
    case ValueType::kList:
      return "a list, each " + what;
    case ValueType::kFlag:
      return "true or false";
    case ValueType::kText:
      return "a text in quotes";
    case ValueType::kWord:
      break;
  }
  std::string text = words.size() > 1 ? "one of " : "";
  for (std::size_t i = 0; i < words.size(); ++i) {
    text += (i > 0 ? ", \"" : "\"") + std::string(words[i]) + "\"";
  }
  return text;
}

std::string_view Table::parent() const {
  const std::size_t dot = path.rfind('.');
  return path.substr(0, dot == std::string_view::npos ? 0 : dot);
}

std::string_view Table::name() const {
  return path.substr(path.rfind('.') + 1);  // npos + 1 is 0
}

const Key* Table::find(std::string_view name) const {
  const auto found =
      std::find_if(keys.begin(), keys.end(), [&](const Key& key) { return key.is_called(name); });
  return found == keys.end() ? nullptr : &*found;
}

RotorGeometry& geometry_of(Scene& scene) {
  if (!scene.rotor.geometry) scene.rotor.geometry.emplace();
  return *scene.rotor.geometry;
}

std::span<const Table> tables() {
  static const std::vector<Table> all = [] {
    std::vector<Table> result{run_table()};
    for (auto* tables : {rotor_tables, load_tables, contact_tables, ring_tables, actuator_tables,
                         control_tables, start_tables}) {
      for (Table& table : tables()) result.push_back(std::move(table));
    }
    result.push_back(rule_table());
    return result;
  }();
  return all;
}

bool is_part_of_contact(const Table& table) {
  const std::string_view root = table.path.substr(0, table.path.find('.'));
  return root == "stator" || root == "actuator" || root == "controller";
}

std::string without_elements(std::string_view path) {
  std::string text;
  while (!path.empty()) {
    const std::string_view part = path.substr(0, path.find('.'));
    path.remove_prefix(std::min(part.size() + 1, path.size()));
    const std::string_view name = part.substr(0, part.find('['));
    const bool number =
        std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!number) text += (text.empty() ? "" : ".") + std::string(name);
  }
  return text;
}

const Key* find_key(std::string_view path) {
  static const Key any_number{};
  const std::string plain = without_elements(path);
  const std::size_t dot = plain.rfind('.');
  const Table* table = dot == std::string::npos ? nullptr : find_table(plain.substr(0, dot));
  if (table == nullptr || table->any_key) return table == nullptr ? nullptr : &any_number;
  return table->find(plain.substr(dot + 1));
}

const Table* find_table(std::string_view path) {
  constexpr std::string_view kList = "contact.";
  const bool below = path.starts_with(kList);
  const std::string_view part = below ? path.substr(kList.size()) : path;
  const std::span<const Table> all = tables();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Table& table) {
    return table.path == path || (below && table.path == part && is_part_of_contact(table));
  });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace rotorub::scene
