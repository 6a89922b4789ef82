#include "native_model/scene/overrides.h"

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <utility>

#include "native_model/scene/schema.h"
#include "native_model/scene/text.h"

namespace rotorub::scene {
namespace {

using Kind = TomlNode::Kind;

FileName override_file() {
  static const FileName name(kOverrideFile);
  return name;
}

// One part of a path: a key or the index of an element.
struct Step {
  std::string key;
  std::size_t index = 0;
  bool is_index = false;
};

constexpr std::size_t kLongestPath = 8;

std::optional<std::size_t> as_index(std::string_view text) {
  std::size_t index = 0;
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), index);
  const bool whole = status == std::errc() && end == text.data() + text.size() && !text.empty();
  return whole ? std::optional(index) : std::nullopt;
}

// Splits "force[0].shape" or "force.0.shape" into parts. Nothing if it is not a path.
std::optional<std::vector<Step>> parse_path(std::string_view text) {
  std::vector<Step> steps;
  while (true) {
    const std::string_view part = text.substr(0, text.find('.'));
    const std::string_view name = part.substr(0, part.find('['));
    if (name.empty() || steps.size() >= kLongestPath) return std::nullopt;
    const std::optional<std::size_t> number = as_index(name);
    steps.push_back({std::string(name), number.value_or(0), number.has_value()});
    if (name.size() < part.size()) {
      if (part.back() != ']') return std::nullopt;
      const auto index = as_index(part.substr(name.size() + 1, part.size() - name.size() - 2));
      if (!index) return std::nullopt;
      steps.push_back({{}, *index, true});
    }
    if (part.size() == text.size()) break;
    text.remove_prefix(part.size() + 1);
  }
  return steps.front().is_index ? std::nullopt : std::optional(steps);
}

TomlNode empty_node(Kind kind) {
  TomlNode node;
  node.kind = kind;
  node.file = override_file();
  return node;
}

TomlNode parse_value(std::string_view text) {
  std::vector<Diagnostic> unread;
  const auto document = parse_toml("v = " + std::string(text), kOverrideFile, unread);
  if (document && unread.empty() && document->entries.size() == 1) {
    return document->entries.front().second;
  }
  TomlNode word = empty_node(Kind::kString);
  word.text = text;
  return word;
}

// Overrides have no line numbers.
void forget_lines(TomlNode& node) {
  node.line = 0;
  for (auto& [key, value] : node.entries) forget_lines(value);
  for (TomlNode& item : node.items) forget_lines(item);
}

// The child that `step` leads to, created if needed. nullptr, with a reason, if it cannot exist.
TomlNode* descend(TomlNode& node, const Step& step, Kind kind_if_made, std::string& reason) {
  if (step.is_index) {
    if (node.kind != Kind::kArray) {
      reason = "is " + std::string(kind_name(node.kind)) + ", which has no elements";
      return nullptr;
    }
    if (step.index > node.items.size()) {
      const std::size_t count = node.items.size();
      reason = "does not exist, because the list has " + std::to_string(count) +
               (count == 1 ? " element" : " elements") + ", counted from 0; use [" +
               std::to_string(count) + "] to add one";
      return nullptr;
    }
    if (step.index == node.items.size()) node.items.push_back(empty_node(kind_if_made));
    return &node.items[step.index];
  }
  if (node.kind != Kind::kTable) {
    reason = node.kind == Kind::kArray
                 ? "is a list; name an element of it, for example force[0].amplitude"
                 : "is " + std::string(kind_name(node.kind)) + ", not a table";
    return nullptr;
  }
  if (TomlNode* found = node.find(step.key)) return found;
  node.entries.emplace_back(step.key, empty_node(kind_if_made));
  return &node.entries.back().second;
}

void remove(TomlNode& node, const Step& step) {
  if (step.is_index) {
    if (step.index < node.items.size()) {
      node.items.erase(node.items.begin() + static_cast<std::ptrdiff_t>(step.index));
    }
    return;
  }
  std::erase_if(node.entries, [&](const auto& entry) { return entry.first == step.key; });
}

// Path of the table that contains the last step, such as "rotor.disc".
std::string table_path(const std::vector<Step>& steps) {
  std::string path;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (!steps[i].is_index) path += (path.empty() ? "" : ".") + steps[i].key;
  }
  return path;
}

// Removes what contradicts the new value of `name`: the file's value by the key's other name and,
// after a change of `kind`, the file's keys and tables that only other kinds allow.
void drop_contradictions(TomlNode& table, const std::string& path, const std::string& name,
                         std::string_view new_word) {
  const Table* schema = find_table(path);
  if (schema == nullptr || table.kind != Kind::kTable) return;
  const Key* set = schema->find(name);
  std::erase_if(table.entries, [&](const auto& entry) {
    if (entry.second.file == override_file()) return false;
    const Key* key = schema->find(entry.first);
    if (name != "kind") return key != nullptr && key == set;
    const Table* below = find_table(path + "." + entry.first);
    return (below != nullptr && !below->is_for(new_word)) ||
           (key != nullptr && !key->is_for(new_word));
  });
}

std::optional<double> seconds(const TomlNode& node) {
  if (node.kind == Kind::kFloat) return node.number;
  if (node.kind == Kind::kInteger) return static_cast<double>(node.integer);
  const ParsedQuantity parsed = parse_quantity(node.text, kTime);
  return parsed.error.empty() ? std::optional(parsed.value) : std::nullopt;
}

// Removes output times of the file after an earlier end, because the run no longer reaches them.
void drop_times_beyond(TomlNode& run, const TomlNode& end) {
  const std::optional<double> last = seconds(end);
  TomlNode* times = run.find("output_times");
  if (!last || times == nullptr || times->file == override_file()) return;
  std::erase_if(times->items, [&](const TomlNode& time) { return seconds(time) > last; });
}

// True if a scene may have this table or key, so that it can be removed.
bool is_known(const std::vector<Step>& steps) {
  std::string path = table_path(steps);
  if (!steps.back().is_index) path += (path.empty() ? "" : ".") + steps.back().key;
  return find_key(path) != nullptr || find_table(path) != nullptr;
}

// True if "none" is one of the words of this key, so that it sets the key and removes nothing.
bool has_word_none(const std::vector<Step>& steps) {
  const Table* table = find_table(table_path(steps));
  const Key* key = table != nullptr ? table->find(steps.back().key) : nullptr;
  return key != nullptr && std::ranges::find(key->words, "none") != key->words.end();
}

// Turns a constant mu into a friction law before a key of [contact.friction] is set.
void as_friction_law(TomlNode& node) {
  if (node.kind == Kind::kTable) return;
  TomlNode law = empty_node(Kind::kTable);
  for (const char* key : {"static", "kinetic"}) law.entries.emplace_back(key, node);
  node = std::move(law);
}

// Applies the override. Returns the reason if it cannot be applied, else an empty string.
std::string apply(TomlNode& root, const std::vector<Step>& steps, std::string_view text) {
  // An unknown key is set like any other, so that the reader refuses it by name.
  const bool removing = text == "none" && is_known(steps) && !has_word_none(steps);
  TomlNode* node = &root;
  std::string reason, path;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    if (removing && !steps[i].is_index && node->kind == Kind::kTable && !node->find(steps[i].key)) {
      return {};
    }
    const bool no_list = steps[i].is_index && node->kind != Kind::kArray;
    node = descend(*node, steps[i], steps[i + 1].is_index ? Kind::kArray : Kind::kTable, reason);
    if (no_list) return "cannot be set: " + path + " " + reason;
    path += steps[i].is_index ? "[" + std::to_string(steps[i].index) + "]"
                              : (path.empty() ? "" : ".") + steps[i].key;
    if (node == nullptr) return "cannot be set: " + path + " " + reason;
  }
  if (removing) {
    if (node == &root && steps.back().key == "rotor")
      return "cannot be removed, because every scene needs a [rotor]";
    remove(*node, steps.back());
    return {};
  }
  if (table_path(steps) == "contact.friction") as_friction_law(*node);
  TomlNode value = parse_value(text);
  value.file = override_file();
  forget_lines(value);
  const std::string word = value.text;
  TomlNode* target = descend(*node, steps.back(), Kind::kString, reason);
  if (target == nullptr) return "cannot be set: " + (path.empty() ? "it" : path) + " " + reason;
  *target = std::move(value);
  drop_contradictions(*node, table_path(steps), steps.back().key, word);
  if (path == "run" && steps.back().key == "end") drop_times_beyond(*node, *target);
  return {};
}

// An override of contact.friction applies to all contacts of a list; magnetic bearings work alike.
// A single table counts as a list of one: contact[0].friction is its friction.
std::string apply_to_each(TomlNode& root, std::vector<Step> steps, std::string_view text) {
  const std::string& key = steps.front().key;
  TomlNode* list = (key == "contact" || key == "magnetic_bearing") && steps.size() > 1
                       ? root.find(key)
                       : nullptr;
  const bool one = list != nullptr && list->kind == Kind::kTable;
  if (one && steps[1].is_index && steps[1].index == 0) steps.erase(steps.begin() + 1);
  const bool each = list != nullptr && list->kind == Kind::kArray && !list->items.empty();
  if (!each || steps[1].is_index) return apply(root, steps, text);
  steps.insert(steps.begin() + 1, Step{{}, 0, true});
  std::string reason;
  for (std::size_t i = 0; i < list->items.size() && reason.empty(); ++i) {
    steps[1].index = i;
    reason = apply(root, steps, text);
  }
  return reason;
}

}  // namespace

std::string override_key(const std::string& text) {
  return text.substr(0, text.find_last_not_of(" \t", text.find('=') - 1) + 1);
}

void apply_overrides(TomlNode& root, std::span<const std::string> overrides,
                     std::vector<Diagnostic>& diagnostics) {
  for (const std::string& override_text : overrides) {
    const std::string_view text = override_text;
    const std::size_t equals = text.find('=');
    const std::string_view path = trimmed(text.substr(0, equals));
    const std::string_view value =
        equals == std::string_view::npos ? std::string_view() : trimmed(text.substr(equals + 1));
    const auto steps = parse_path(path);
    if (!steps || value.empty()) {
      diagnostics.push_back({kOverrideFile,
                             0,
                             {},
                             "expected table.key=value, for example contact.friction=0.2 or "
                             "force[0].amplitude=\"100 N\", got '" +
                                 printable(override_text) + "'"});
      continue;
    }
    const std::string reason = apply_to_each(root, *steps, value);
    if (!reason.empty()) diagnostics.push_back({kOverrideFile, 0, std::string(path), reason});
  }
}

}  // namespace rotorub::scene
