#include "native_model/scene/reading.h"

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
    "unknown key; this is a name of ROSS. Write stiffness = [kxx, kyy], damping = [cxx, cyy], "
    "cross_stiffness = [kxy, kyx] and cross_damping = [cxy, cyx] instead. For coefficients that "
    "depend on the speed give table_kxx, ... together with table_speed";

using Kind = TomlNode::Kind;

constexpr const char* kGeometryForm = "the geometry form ([rotor] with length, E, rho, ...)";
constexpr const char* kModalForm = "the modal form ([rotor.modal])";

TomlNode* find_path(TomlNode& root, std::string_view path) {
  TomlNode* node = &root;
  while (node != nullptr && !path.empty()) {
    const std::string_view key = path.substr(0, path.find('.'));
    node = node->kind == Kind::kTable ? node->find(key) : nullptr;
    path.remove_prefix(std::min(key.size() + 1, path.size()));
  }
  return node;
}

// "[[rotor.disc]]" or "[rotor]".
std::string header(bool list, const std::string& path) {
  return list ? "[[" + path + "]]" : "[" + path + "]";
}

// "\"pid\" or \"shared\"".
std::string quoted_words(std::span<const std::string_view> words) {
  std::string text;
  for (const std::string_view word : words) {
    if (!text.empty()) text += word == words.back() ? " or " : ", ";
    text += "\"" + std::string(word) + "\"";
  }
  return text;
}

std::string not_of_kind(std::span<const std::string_view> kinds, std::string_view kind) {
  return "belongs to kind = " + quoted_words(kinds) + " and has no effect with \"" +
         std::string(kind) + "\"; remove it, or change the kind";
}

// True for a part of one of several auxiliary bearings: "contact[1].stator".
bool is_listed(std::string_view path) { return path.starts_with("contact["); }

// True if `table` stands directly below `above` (null: at the top level), which is read at `path`.
bool stands_below(const Table& table, const Table* above, const std::string& path) {
  if (table.for_key) return false;  // read with the key
  if (table.parent() == (above == nullptr ? std::string_view() : above->path)) return true;
  return is_listed(path) && path.ends_with(']') && table.parent().empty() &&
         is_part_of_contact(table);
}

// Where a key or table of this name belongs: "`mass` belongs in [stator], [rotor.modal]". Empty if
// it belongs nowhere.
std::string homes_of(const std::string& name, bool is_table) {
  std::string homes;
  for (const Table& table : tables()) {
    if (is_table ? table.name() != name : table.find(name) == nullptr) continue;
    homes += (homes.empty() ? "" : ", ") + header(table.list, std::string(table.path));
  }
  if (homes.empty()) return homes;
  return (is_table ? "write it as " : "`" + name + "` belongs in ") + homes;
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

Reading::Reading(Scene& of_scene, std::vector<Diagnostic>& diagnostics)
    : scene(of_scene),
      scene_(of_scene),
      diagnostics_(diagnostics),
      record_(std::make_shared<Record>()) {
  scene_.record = record_;
}

bool Reading::refuse(const Spot& here, std::string reason) {
  diagnostics_.push_back({here.node.file, here.node.line, here.path, std::move(reason)});
  return false;
}

Reading::Spot Reading::Spot::below(TomlNode& inner, std::string_view key) const {
  return {inner, path.empty() ? std::string(key) : path + "." + std::string(key)};
}

void Reading::note(const Spot& here, bool sound, const std::string& written) {
  record_->note(here.path, here.node, sound, written);
}

void Reading::read(TomlNode& root) {
  note({root, {}}, true);
  refuse_unknown(nullptr, {root, {}});
  if (root.find("rotor") == nullptr)
    refuse({root, "rotor"}, "missing: every scene needs a table [rotor]");
  const TomlNode* contact = root.find("contact");
  const bool listed = contact != nullptr && contact->kind == Kind::kArray;
  for (const Table& table : tables()) {
    const std::string path(table.path);
    if (listed && is_part_of_contact(table)) {
      if (TomlNode* node = find_path(root, path)) {
        refuse({*node, path},
               "cannot stand beside [[contact]]; give each contact its own, as [contact." + path +
                   "] below its [[contact]]");
      }
    } else if (TomlNode* node = root.find(path); node != nullptr && table.parent().empty()) {
      read_table(table, {*node, path});
    }
  }
}

// The form is modal if there is a [rotor.modal], and geometry if there is any key of a geometry.
void Reading::find_form(const Spot& rotor) {
  TomlNode* modal = rotor.node.find("modal");
  std::string geometry;  // the first key of a geometry
  for (const auto& [name, value] : rotor.node.entries) {
    const Key* key = find_table("rotor")->find(name);
    const Table* table = find_table("rotor." + name);
    if ((key && key->form == Form::kGeometry) || (table && table->form == Form::kGeometry)) {
      geometry = geometry.empty() ? name : geometry;
    }
  }
  if (modal != nullptr && !geometry.empty()) {
    refuse(rotor.below(*modal, "modal"),
           "the rotor is given both by its modes and by its geometry (`rotor." + geometry +
               "`); remove one of them");
  } else if (modal != nullptr) {
    form_ = Form::kModal;
  } else if (!geometry.empty()) {
    form_ = Form::kGeometry;
  } else {
    refuse(rotor, std::string("no rotor is given; give ") + kGeometryForm + " or " + kModalForm);
  }
}

// Whether the file has tables below [rotor] alone.
bool Reading::is_missing_rotor(const Table& table, const Spot& here) const {
  return table.path == "rotor" && form_ == Form::kGeometry &&
         std::ranges::none_of(table.keys,
                              [&](const Key& key) { return here.node.find(key.name) != nullptr; });
}

// One error instead of one for each required key.
void Reading::refuse_missing_rotor(const Table& table, const Spot& here) {
  note(here, false);
  for (const Key& key : table.keys) record_->note_missing(here.path + "." + std::string(key.name));
  refuse(here, "the table [rotor] is missing; it has at least length, E, rho and modes");
  read_below(table, {}, here);
}

void Reading::refuse_unknown(const Table* own, const Spot& here) {
  std::vector<std::string_view> known;
  if (own != nullptr) {
    for (const Key& key : own->keys) {
      known.push_back(key.name);
      if (!key.also.empty()) known.push_back(key.also);
    }
  }
  for (const Table& table : tables()) {
    if (stands_below(table, own, here.path)) known.push_back(table.name());
  }
  bool said_ross = false;
  for (auto& [name, value] : here.node.entries) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    if (own != nullptr && own->path == "rotor.bearing" && is_ross_coefficient(name)) {
      if (!said_ross) refuse(here.below(value, name), kRossBearing);
      said_ross = true;
      continue;
    }
    const bool is_table =
        value.kind == Kind::kTable || (value.kind == Kind::kArray && !value.items.empty() &&
                                       value.items.front().kind == Kind::kTable);
    std::string reason = is_table ? "unknown table" : "unknown key";
    const std::string homes = homes_of(name, is_table);
    const std::string_view meant = homes.empty() ? nearest(name, known) : std::string_view();
    if (!homes.empty()) {
      reason += " here; " + homes + ". The names here are ";
    } else if (meant.empty()) {
      reason += "; choose from ";
    } else {
      reason += ", did you mean `" + std::string(meant) + "`? Choose from ";
    }
    refuse(here.below(value, name), reason + join(known));
    // The value is read as it was meant, so that the mistake has no further consequences.
    TomlNode* there = meant.empty() ? nullptr : here.node.find(meant);
    if (there != nullptr && there->kind == Kind::kTable) {
      for (auto& entry : value.entries) {
        if (there->find(entry.first) == nullptr) there->entries.push_back(std::move(entry));
      }
    } else if (there == nullptr && !meant.empty()) {
      name = meant;
    }
  }
}

void Reading::read_table(const Table& table, const Spot& here) {
  if (here.node.kind == Kind::kArray && (table.list || table.or_list)) {
    note(here, true);
    read_list(table, here);
  } else if (here.node.kind == Kind::kTable && !table.list) {
    read_object(table, here);
  } else {
    note(here, false);
    refuse(here, std::string("expected ") + (table.list ? "a list of tables " : "one table ") +
                     header(table.list, here.path) + ", got " +
                     std::string(kind_name(here.node.kind)));
  }
}

void Reading::read_list(const Table& table, const Spot& here) {
  const bool contacts = here.path == "contact";
  const std::size_t most = contacts ? kMaxContacts : kMaxMagneticBearings;
  if (table.or_list && here.node.items.size() > most) {
    refuse(here, "has " + std::to_string(here.node.items.size()) +
                     (contacts ? " contacts" : " magnetic bearings") + "; at most " +
                     std::to_string(most) + " are accepted");
    if (!contacts) return;
  }
  for (std::size_t i = 0; i < here.node.items.size(); ++i) {
    const Spot element{here.node.items[i], list_element(here.path, i)};
    if (contacts && i > 0) scene_.auxiliary.emplace_back();
    if (element.node.kind == Kind::kTable) {
      read_object(table, element);
    } else {
      refuse(element, "expected a table " + header(true, here.path));
    }
  }
}

void Reading::read_object(const Table& table, const Spot& here) {
  note(here, true);
  if (table.any_key) return read_any(table, here);
  refuse_unknown(&table, here);
  if (table.path == "rotor") find_form(here);
  if (is_missing_rotor(table, here)) return refuse_missing_rotor(table, here);
  const std::string_view kind = kind_of(table, here.node);
  void* object = table.object != nullptr ? table.object(scene_) : &rules_.emplace_back();
  for (const Key& key : table.keys) {
    TomlNode* value = here.node.find(key.name);
    TomlNode* other = key.also.empty() ? nullptr : here.node.find(key.also);
    const Spot one = here.below(value != nullptr   ? *value
                                : other != nullptr ? *other
                                                   : here.node,
                                key.name);
    const Table* instead = value != nullptr && value->kind == Kind::kTable
                               ? find_table(std::string(table.path) + "." + std::string(key.name))
                               : nullptr;
    if (instead != nullptr) {
      read_object(*instead, one);
    } else if (value != nullptr && other != nullptr) {
      refuse(here.below(*other, key.also),
             "is another name of `" + std::string(key.name) + "`, which is also given; remove one");
      note(one, false);
    } else if (value != nullptr || other != nullptr) {
      const Spot written = here.below(one.node, value != nullptr ? key.name : key.also);
      note(one, read_key(key, kind, written, object), written.path);
    } else if (key.required() && key.belongs_to(form_) &&
               (key.kinds.empty() || (!kind.empty() && key.is_for(kind)))) {
      record_->note_missing(one.path);
      refuse(one, "missing: expected " + key.expected());
    }
  }
  read_below(table, kind, here);
}

void Reading::read_below(const Table& table, std::string_view kind, const Spot& here) {
  for (const Table& below : tables()) {
    if (!stands_below(below, &table, here.path)) continue;
    TomlNode* own = here.node.find(below.name());
    if (own == nullptr) continue;
    const Spot spot = here.below(*own, below.name());
    if (kind.empty() || below.is_for(kind)) {
      read_table(below, spot);
    } else {
      refuse(spot, not_of_kind(below.kinds, kind));
      note(spot, false);
    }
  }
}

bool Reading::read_key(const Key& key, std::string_view kind, const Spot& here, void* object) {
  if (here.node.kind == Kind::kFaulty) return false;
  if (form_ != Form::kEither && !key.belongs_to(form_)) {
    const bool modal = form_ == Form::kModal;
    return refuse(here, std::string("belongs to ") + (modal ? kGeometryForm : kModalForm) +
                            ", but this rotor is given in " + (modal ? kModalForm : kGeometryForm) +
                            "; remove it");
  }
  if (key.listed_only && !is_listed(here.path)) {
    return refuse(here,
                  "is accepted only in [contact.stator] below a [[contact]]; for [stator] use "
                  "`initial.stator` and `initial.stator_velocity`");
  }
  if (!kind.empty() && !key.is_for(kind)) return refuse(here, not_of_kind(key.kinds, kind));
  Value value;
  if (!read_value(key, here, value)) return false;
  key.store(object, value);
  return true;
}

void Reading::read_any(const Table& table, const Spot& here) {
  auto& config = *static_cast<std::vector<ConfigEntry>*>(table.object(scene_));
  for (auto& [name, value] : here.node.entries) {
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
    note(here.below(value, name), sound);
    if (sound) {
      config.push_back(std::move(entry));
    } else {
      refuse(here.below(value, name),
             "expected a finite number, or a text in quotes" +
                 (value.kind == Kind::kFloat ? "" : ", got " + std::string(kind_name(value.kind))));
    }
  }
}

}  // namespace rotorub::scene
