#include "compare/sweep/study_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "native_model/scene/text.h"

namespace rotorub::sweep {
namespace {

using scene::TomlNode;
using Kind = TomlNode::Kind;

}  // namespace

void say_old_word(const std::string& where, const std::string& word) {
  if (scene::current_word(word) != word)
    fmt::print(stderr, "note: {}\n", scene::old_word_note(where, word));
}

StudyTable::StudyTable(TomlNode& node, std::string path,
                       std::initializer_list<std::string_view> keys,
                       std::vector<scene::Diagnostic>& diagnostics)
    : node_(&node), file_(node.file), path_(std::move(path)), diagnostics_(&diagnostics) {
  const std::vector<std::string_view> known(keys);
  for (auto& [name, value] : node.entries) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    fail(name, "unknown key" + scene::suggestion(name, known));
    // The value is read as it was meant, so that the mistake has no further consequences.
    const std::string_view meant = scene::nearest(name, known);
    if (!meant.empty() && find(meant) == nullptr) name = meant;
  }
}

StudyTable StudyTable::table(const std::string& name,
                             std::initializer_list<std::string_view> keys) const {
  static TomlNode none;
  TomlNode* node = node_->find(name);
  const bool is_table = node != nullptr && node->kind == Kind::kTable;
  if (node != nullptr && !is_table)
    fail(name, fmt::format("expected one table [{}], got {}", name, kind_name(node->kind)));
  StudyTable found(is_table ? *node : none, path_of(name), keys, *diagnostics_);
  found.file_ = file_;
  return found;
}

std::string StudyTable::path_of(std::string_view key) const {
  return path_.empty() || key.empty() ? path_ + std::string(key) : path_ + "." + std::string(key);
}

void StudyTable::fail(std::string_view key, std::string reason) const {
  const TomlNode* at = node_->find(key);
  diagnostics_->push_back({file_, at ? at->line : node_->line, path_of(key), std::move(reason)});
}

void StudyTable::missing(std::string_view key, const std::string& expected) const {
  fail(key, "missing: expected " + expected);
}

std::optional<std::string> StudyTable::text(std::string_view key) const {
  const TomlNode* value = find(key);
  if (value == nullptr || value->kind == Kind::kFaulty) return std::nullopt;
  if (value->kind == Kind::kString && !value->text.empty()) return value->text;
  fail(key, fmt::format("expected a text in quotes, got {}",
                        value->kind == Kind::kString ? "an empty one" : kind_name(value->kind)));
  return std::nullopt;
}

std::optional<std::size_t> StudyTable::place_of(std::string_view key,
                                                const std::vector<std::string_view>& words) const {
  const auto given = text(key);
  if (!given) return std::nullopt;
  const std::string word(scene::current_word(*given));
  say_old_word(path_of(key), *given);
  const auto found = std::find(words.begin(), words.end(), word);
  if (found != words.end()) return static_cast<std::size_t>(found - words.begin());
  fail(key,
       fmt::format("unknown word `{}`{}", scene::printable(word), scene::suggestion(word, words)));
  return std::nullopt;
}

std::optional<std::int64_t> StudyTable::whole(std::string_view key, std::int64_t least,
                                              std::int64_t most) const {
  const TomlNode* value = find(key);
  if (value == nullptr || value->kind == Kind::kFaulty) return std::nullopt;
  if (value->kind == Kind::kInteger && value->integer >= least && value->integer <= most) {
    return value->integer;
  }
  fail(key, fmt::format("expected a whole number in [{}, {}], got {}", least, most,
                        value->kind == Kind::kInteger ? std::to_string(value->integer)
                                                      : std::string(kind_name(value->kind))));
  return std::nullopt;
}

std::optional<double> StudyTable::number(std::string_view key,
                                         const scene::Quantity& quantity) const {
  const TomlNode* value = find(key);
  return value ? number(*value, std::string(key), quantity) : std::nullopt;
}

std::optional<double> StudyTable::number(const TomlNode& value, const std::string& key,
                                         const scene::Quantity& quantity) const {
  std::string reason;
  switch (value.kind) {
    case Kind::kFaulty:
      return std::nullopt;
    case Kind::kInteger:
      return static_cast<double>(value.integer);
    case Kind::kFloat:
      if (std::isfinite(value.number)) return value.number;
      reason = "is not finite; expected " + std::string(quantity.name);
      break;
    case Kind::kString: {
      const auto parsed = scene::parse_quantity(value.text, quantity);
      if (parsed.error.empty()) return parsed.value;
      reason = parsed.error;
      break;
    }
    default:
      reason = fmt::format("expected {} ({}), got {}", quantity.name, quantity.examples,
                           kind_name(value.kind));
  }
  diagnostics_->push_back({value.file, value.line, path_of(key), std::move(reason)});
  return std::nullopt;
}

const scene::Key* scene_key(std::string_view path, std::string& reason) {
  const std::string plain = scene::without_elements(path);
  if (const scene::Key* key = scene::find_key(path)) return key;
  if (scene::find_table(plain) != nullptr) return nullptr;
  std::vector<std::string> all;
  for (const scene::Table& t : scene::tables()) {
    for (const scene::Key& key : t.keys) {
      all.push_back(std::string(t.path) + "." + std::string(key.name));
    }
    // A table of the user's own keys: only its path can be misspelt.
    const std::size_t last = plain.rfind('.');
    if (t.any_key && last != plain.npos) all.push_back(std::string(t.path) + plain.substr(last));
  }
  const std::vector<std::string_view> known(all.begin(), all.end());
  const std::string_view meant = scene::nearest(plain, known);
  reason = fmt::format("`{}` is not a key of a scene", scene::printable(path));
  reason += meant.empty() ? "." : fmt::format(", did you mean `{}`?", meant);
  reason +=
      " Expected table.key or table[element].key, for example contact.friction or "
      "force[0].amplitude (mjcf/docs/keys.md lists all keys)";
  return nullptr;
}

std::string number_text(double value) { return fmt::format("{}", value); }

bool takes_number(std::string_view path, const scene::Key* key) {
  using scene::ValueType;
  if (key == nullptr) return false;
  const bool element = path.ends_with(']');
  return key->type == ValueType::kNumber || key->type == ValueType::kPlanes ||
         (element && (key->type == ValueType::kList || key->type == ValueType::kVector));
}

}  // namespace rotorub::sweep
