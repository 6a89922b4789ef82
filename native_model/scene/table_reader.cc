#include "native_model/scene/table_reader.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace rotorub::scene {
namespace {

// True for the eight coefficients of a bearing as ROSS names them, which share one message.
bool is_ross_coefficient(std::string_view name) {
  return name.size() == 3 && (name[0] == 'k' || name[0] == 'c') &&
         (name[1] == 'x' || name[1] == 'y') && (name[2] == 'x' || name[2] == 'y');
}
constexpr const char* kRossBearing =
    "unknown key; in place of the names of ROSS write stiffness = [kxx, kyy], damping = [cxx, "
    "cyy], "
    "cross_stiffness = [kxy, kyx] and cross_damping = [cxy, cyx]; coefficients that depend on the "
    "speed are table_kxx, ... together with table_speed";

using Kind = TomlNode::Kind;

constexpr const char* kGeometryForm = "the geometry form ([rotor] with length, E, rho, ...)";
constexpr const char* kModalForm = "the modal form ([rotor.modal])";

const TomlNode* find_path(const TomlNode& root, std::string_view path) {
  const TomlNode* node = &root;
  while (node != nullptr && !path.empty()) {
    const std::string_view key = path.substr(0, path.find('.'));
    node = node->kind == Kind::kTable ? node->find(key) : nullptr;
    path.remove_prefix(std::min(key.size() + 1, path.size()));
  }
  return node;
}

std::string child_path(const std::string& path, std::string_view key) {
  return path.empty() ? std::string(key) : path + "." + std::string(key);
}

constexpr std::string_view kBelowContact = "contact.";

// True for a part of one of several auxiliary bearings: "contact[1].stator".
bool is_listed(std::string_view path) { return path.starts_with("contact["); }

bool lists_contacts(const TomlNode& root) {
  const TomlNode* contact = find_path(root, "contact");
  return contact != nullptr && contact->kind == Kind::kArray;
}

bool is_table_of(std::string_view path) {
  const Table* table = find_table(path);
  return table != nullptr && table->path == path;
}

// The tables that allow a key of this name: "[rotor], [rotor.torsion]".
std::string homes_of(std::string_view name) {
  std::string text;
  for (const Table& table : tables()) {
    if (table.find(name) == nullptr) continue;
    text += (text.empty() ? "" : ", ") + std::string(table.list ? "[[" : "[") +
            std::string(table.path) + (table.list ? "]]" : "]");
  }
  return text;
}

// The `kind` of a table: the given word or the default. Empty if there is none or it is unknown.
std::string_view kind_of(const Table& table, const TomlNode& node) {
  const Key* key = table.find("kind");
  if (key == nullptr) return {};
  const TomlNode* given = node.find("kind");
  const std::string_view word = given ? std::string_view(given->text) : key->default_word();
  const auto found = std::find(key->words.begin(), key->words.end(), word);
  return found == key->words.end() ? std::string_view() : *found;
}

}  // namespace

void TableReader::fail(const TomlNode& node, const std::string& path, std::string reason) {
  diagnostics_.push_back({node.file, node.line, path, std::move(reason)});
}

void TableReader::read(const TomlNode& root) {
  record_.note({}, root, true);
  refuse_unknown(root, {}, {});
  find_form(root);
  const bool listed = lists_contacts(root);
  for (const Table& table : tables()) {
    if (table.for_key) continue;  // read with the key
    if (!listed || !is_part_of_contact(table)) {
      read_table(table, root);
    } else if (const TomlNode* node = find_path(root, table.path)) {
      fail(*node, std::string(table.path),
           "stands beside [[contact]]; accepted: below each, as [contact." +
               std::string(table.path) + "]");
    }
  }
}

// The form is modal if there is a [rotor.modal], and geometry if there is any key of a geometry.
void TableReader::find_form(const TomlNode& root) {
  const TomlNode* rotor = find_path(root, "rotor");
  if (rotor == nullptr || rotor->kind != Kind::kTable) return;
  const TomlNode* modal = rotor->find("modal");
  std::string geometry;  // the first key of a geometry
  for (const auto& [name, value] : rotor->entries) {
    const Key* key = find_table("rotor")->find(name);
    const Table* table = find_table("rotor." + name);
    if ((key && key->form == Form::kGeometry) || (table && table->form == Form::kGeometry)) {
      geometry = geometry.empty() ? name : geometry;
    }
  }
  if (modal != nullptr && !geometry.empty()) {
    fail(*modal, "rotor.modal",
         "the rotor is given by its modes and by its geometry (`rotor." + geometry +
             "`); give one of them");
  } else if (modal != nullptr) {
    form_ = Form::kModal;
  } else if (!geometry.empty()) {
    form_ = Form::kGeometry;
  } else {
    fail(*rotor, "rotor",
         std::string("no rotor is given: expected ") + kGeometryForm + " or " + kModalForm);
  }
}

// Reads each [[contact]] or [[magnetic_bearing]] with the parts of its bearing.
void TableReader::read_list(const Table& table, const TomlNode& list) {
  const std::string path(table.path), below = path + ".";
  const bool contacts = path == "contact";
  const std::size_t most = contacts ? kMaxContacts : kMaxMagneticBearings;
  if (list.items.size() > most) {
    fail(list, path,
         "has " + std::to_string(list.items.size()) +
             (contacts ? " contacts" : " magnetic bearings") + "; accepted: at most " +
             std::to_string(most));
    if (!contacts) return;
  }
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    const std::string element = list_element(path, i);
    const TomlNode& node = list.items[i];
    if (contacts && i > 0) scene_.auxiliary.emplace_back();
    if (node.kind != Kind::kTable) {
      fail(node, element, "expected a table [[" + path + "]]");
      continue;
    }
    read_object(table, node, element);
    for (const Table& part : tables()) {
      if (contacts && is_part_of_contact(part)) read_table(part, node, element + ".");
      if (!part.path.starts_with(below) || part.for_key) continue;
      const std::string name(part.path.substr(below.size()));
      if (const TomlNode* own = node.find(name)) read_one(part, *own, child_path(element, name));
    }
  }
}

void TableReader::read_table(const Table& table, const TomlNode& root, const std::string& above) {
  const std::string path = above + std::string(table.path);
  const TomlNode* node = find_path(root, table.path);
  if (node == nullptr) {
    if (path == "rotor") fail(root, path, "missing: every scene has a [rotor]");
    return;
  }
  if (!kind_takes(table, root, *node, path)) return record_.note(path, *node, false);
  if (table.or_list && node->kind == Kind::kArray) {
    record_.note(path, *node, true);
    return read_list(table, *node);
  }
  const std::string header = (table.list ? "[[" : "[") + path + (table.list ? "]]" : "]");
  if (table.list && node->kind == Kind::kArray) {
    record_.note(path, *node, true);
    for (std::size_t i = 0; i < node->items.size(); ++i) {
      const std::string element = path + "[" + std::to_string(i) + "]";
      if (node->items[i].kind == Kind::kTable) {
        read_object(table, node->items[i], element);
      } else {
        fail(node->items[i], element, "expected a table " + header);
      }
    }
  } else {
    read_one(table, *node, path);
  }
}

void TableReader::read_one(const Table& table, const TomlNode& node, const std::string& path) {
  if (!table.list && node.kind == Kind::kTable) return read_object(table, node, path);
  record_.note(path, node, false);
  fail(node, path,
       std::string("expected ") + (table.list ? "a list of tables [[" : "one table [") + path +
           (table.list ? "]]" : "]") + ", got " + std::string(kind_name(node.kind)));
}

bool TableReader::kind_takes(const Table& table, const TomlNode& root, const TomlNode& node,
                             const std::string& path) {
  if (table.kinds.empty()) return true;  // also for tables at the top level
  const std::string_view parent = table.path.substr(0, table.path.rfind('.'));
  const std::string_view kind = kind_of(*find_table(parent), *find_path(root, parent));
  if (kind.empty() || table.is_for(kind)) return true;
  fail(node, path,
       "belongs to kind = \"" + join(table.kinds) + "\" and has no effect with \"" +
           std::string(kind) + "\"");
  return false;
}

void TableReader::read_object(const Table& table, const TomlNode& node, const std::string& path) {
  record_.note(path, node, true);
  if (table.store_any != nullptr) return read_any(table, node, path);
  const bool below = is_listed(path) && is_part_of_contact(table);
  refuse_unknown(
      node, (below ? std::string(kBelowContact) : std::string()) + std::string(table.path), path);
  const std::string_view kind = kind_of(table, node);

  void* object = table.object != nullptr ? table.object(scene_) : &rules_.emplace_back();
  for (const Key& key : table.keys) {
    const TomlNode* value = node.find(key.name);
    const TomlNode* other = key.also.empty() ? nullptr : node.find(key.also);
    const Table* instead = find_table(child_path(std::string(table.path), key.name));
    if (instead != nullptr && value != nullptr && value->kind == Kind::kTable) {
      read_object(*instead, *value, child_path(path, key.name));
    } else if (value != nullptr && other != nullptr) {
      fail(*other, child_path(path, key.also),
           "is another name of `" + std::string(key.name) + "`; give one of them");
      record_.note(child_path(path, key.name), *value, false);
    } else if (value != nullptr || other != nullptr) {
      const std::string written = child_path(path, value != nullptr ? key.name : key.also);
      if (value == nullptr) value = other;
      record_.note(child_path(path, key.name), *value, read_key(key, kind, *value, written, object),
                   written);
    } else if (key.required() && key.belongs_to(form_) &&
               (key.kinds.empty() || (!kind.empty() && key.is_for(kind)))) {
      const std::string key_path = child_path(path, key.name);
      record_.note_missing(key_path);
      fail(node, key_path, "missing: expected " + key.expected());
    }
  }
}

void TableReader::read_any(const Table& table, const TomlNode& node, const std::string& path) {
  void* object = table.object(scene_);
  for (const auto& [name, value] : node.entries) {
    if (value.kind == Kind::kFaulty) continue;
    ConfigEntry entry{name, std::nullopt, 0.0};
    bool sound = true;
    if (value.kind == Kind::kString) {
      entry.text = value.text;
    } else if (value.kind == Kind::kInteger) {
      entry.number = static_cast<double>(value.integer);
    } else {
      entry.number = value.number;
      sound = value.kind == Kind::kFloat && std::isfinite(value.number);
    }
    record_.note(child_path(path, name), value, sound);
    if (sound) {
      table.store_any(object, std::move(entry));
    } else {
      fail(value, child_path(path, name),
           "expected a finite number or a text in quotes" +
               (value.kind == Kind::kFloat ? "" : ", got " + std::string(kind_name(value.kind))));
    }
  }
}

bool TableReader::read_key(const Key& key, std::string_view kind, const TomlNode& node,
                           const std::string& path, void* object) {
  if (node.kind == Kind::kFaulty) return false;
  if (form_ != Form::kEither && !key.belongs_to(form_)) {
    fail(node, path,
         std::string("belongs to ") + (form_ == Form::kModal ? kGeometryForm : kModalForm) +
             ", and the rotor is in " + (form_ == Form::kModal ? kModalForm : kGeometryForm));
    return false;
  }
  if (key.listed_only && !is_listed(path)) {
    fail(node, path,
         "stands in [contact.stator] below a [[contact]] alone; of [stator] it is "
         "`initial.stator`, `initial.stator_velocity`");
    return false;
  }
  if (!kind.empty() && !key.is_for(kind)) {
    fail(node, path,
         "belongs to kind = \"" + join(key.kinds) + "\" and has no effect with \"" +
             std::string(kind) + "\"");
    return false;
  }
  Value value;
  if (!read_value(key, node, path, value)) return false;
  key.store(object, value);
  return true;
}

void TableReader::refuse_unknown(const TomlNode& node, std::string_view table_path,
                                 const std::string& path) {
  // The keys of the table and the tables below it are allowed here.
  const Table* own = find_table(table_path);
  const std::string prefix = table_path.empty() ? "" : std::string(table_path) + ".";
  const bool in_list = is_listed(path);
  const std::string_view inner =
      std::string_view(prefix).substr(in_list ? kBelowContact.size() : 0);
  const auto is_known = [&](const std::string& name) {
    if (own != nullptr && own->find(name) != nullptr) return true;
    // A top-level [stator] is next to [contact], not below it.
    if (table_path == "contact" && !in_list) return is_table_of(prefix + name);
    return name.find('.') == std::string::npos && find_table(prefix + name) != nullptr;
  };
  if (std::all_of(node.entries.begin(), node.entries.end(),
                  [&](const auto& entry) { return is_known(entry.first); })) {
    return;
  }
  std::vector<std::string_view> known;
  if (own != nullptr) {
    for (const Key& key : own->keys) {
      known.push_back(key.name);
      if (!key.also.empty()) known.push_back(key.also);
    }
  }
  for (const Table& table : tables()) {
    // Below [[contact]] the path of [stator] is "contact.stator".
    const std::string_view inside =
        in_list && is_part_of_contact(table) ? inner : std::string_view(prefix);
    if (!table.path.starts_with(inside)) continue;
    const std::string_view below = table.path.substr(inside.size());
    if (!below.empty() && below.find('.') == std::string_view::npos && !table.for_key)
      known.push_back(below);
  }
  bool said_ross = false;
  for (const auto& [name, value] : node.entries) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (table_path == "rotor.bearing" && is_ross_coefficient(name)) {
      if (!said_ross) fail(value, child_path(path, name), kRossBearing);
      said_ross = true;
      continue;
    }
    const bool is_table =
        value.kind == Kind::kTable || (value.kind == Kind::kArray && !value.items.empty() &&
                                       value.items.front().kind == Kind::kTable);
    std::string reason = is_table ? "unknown table" : "unknown key";
    if (const std::string_view meant = nearest(name, known); !meant.empty()) {
      reason += ", did you mean `" + std::string(meant) + "`?";
    } else if (const std::string homes = homes_of(name); !homes.empty()) {
      reason += " here; it stands in " + homes + ";";
    } else {
      reason += ";";
    }
    fail(value, child_path(path, name), reason + " accepted: " + join(known));
  }
}

}  // namespace rotorub::scene
