#include "plugin/own/own_names.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>

#include "native_model/scene/diagnostic.h"
#include "plugin/model/config.h"
#include "plugin/model/later_attributes.h"
#include "plugin/model/message.h"
#include "plugin/own/instances.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

bool is_ours(std::string_view name) { return name.find(names::kOwnMark) != name.npos; }

bool is_number(const InstanceWord& word) {
  return std::find(kOwnNumbers.begin(), kOwnNumbers.end(), word.key) != kOwnNumbers.end();
}

// The numbers in the text of a word.
OwnNumber parse(const InstanceWord& word) {
  OwnNumber number;
  const int most = std::string_view(names::kOwnFriction) == word.key ? 4 : 1;
  const std::string_view text = word.value;
  const char *at = text.data(), *const end = at + text.size();
  for (bool good = true; good;) {
    while (at != end && *at == ' ') ++at;
    if (at == end && number.size > 0) return number;
    if (number.size == most) break;
    double& value = number.values[static_cast<std::size_t>(number.size++)];
    const auto [stop, problem] = std::from_chars(at, end, value);
    good = problem == std::errc{} && std::isfinite(value) && (stop == end || *stop == ' ');
    at = stop;
  }
  refuse(word.element, message("\"{}\" must be {} without a unit", word.value,
                               most == 1 ? "a number" : "one number or four"));
}

// Calls action(name) for each text, action(name, value) for each numeric of the plugin.
template <typename Action>
void for_each_text(const mjModel* m, Action action) {
  for (int i = 0; i < m->ntext; ++i) {
    const std::string name = m->names + m->name_textadr[i];
    if (is_ours(name)) action(name);
  }
  for (const InstanceWord& word : instance_words(m)) {
    if (!is_number(word)) action(word.name());
  }
}
template <typename Action>
void for_each_number(const mjModel* m, Action action) {
  for (int i = 0; i < m->nnumeric; ++i) {
    const std::string name = m->names + m->name_numericadr[i];
    if (is_ours(name)) action(name, m->numeric_data[m->numeric_adr[i]]);
  }
  for (const InstanceWord& word : instance_words(m)) {
    if (is_number(word)) action(word.name(), parse(word).values[0]);
  }
}

// True if `name` is `key` between a prefix and a suffix, which are then written to `pair`.
bool is_key(const std::string& name, std::string_view key, PairName& pair) {
  const std::size_t at = name.find(names::kOwnMark);
  if (name.compare(at, key.size(), key) != 0) return false;
  pair = {name.substr(0, at), name.substr(at + key.size())};
  return true;
}

std::string element_of(const mjModel* m, const char* kind, const std::string& name) {
  const std::string element = instance_element(m, name);
  return element.empty() ? message("<custom><{} name=\"{}\">", kind, name) : element;
}

// Refuses unknown names, because a misspelt name would otherwise count as not given.
void check(const mjModel* m, const std::string& name, std::span<const char* const> keys,
           const char* kind, const std::vector<PairName>& pairs) {
  for (const char* key : keys) {
    PairName pair;
    if (!is_key(name, key, pair)) continue;
    if (key == names::kOwnUserData && pair.suffix.empty()) return;
    if (std::find(pairs.begin(), pairs.end(), pair) != pairs.end()) return;
  }
  std::vector<std::string> known;
  for (const PairName& pair : pairs) {
    for (const char* key : keys) known.push_back(pair.of(key));
  }
  if (std::string_view(kind) == "text") known.emplace_back(names::kOwnConeCoulombPair);
  const std::vector<std::string_view> views(known.begin(), known.end());
  const std::string_view meant = scene::nearest(name, views);
  if (!meant.empty())
    refuse(element_of(m, kind, name), message("unknown name; did you mean \"{}\"?", meant));
  refuse(element_of(m, kind, name), message("unknown name; choose from {}", scene::join(views)));
}

void check_names(const mjModel* m, const std::vector<PairName>& pairs, Refusals& refusals) {
  for_each_text(m, [&](const std::string& name) {
    refusals.attempt([&] {
      PairName of;
      if (is_key(name, names::kSceneText, of)) {
        refuse(own_element(m, name),
               "a scene cannot be attached to another model; name geoms and numbers in the "
               "attached model instead (plugin/README.md, a model of your own)");
      }
      if (is_key(name, names::kOwnConeCoulombPair, of)) return;  // with any ending
      check(m, name, kOwnTexts, "text", pairs);
    });
  });
  for_each_number(m, [&](const std::string& name, mjtNum) {
    refusals.attempt([&] { check(m, name, kOwnNumbers, "numeric", pairs); });
  });
}

void refuse_said_twice(const mjModel* m, const std::vector<InstanceWord>& words) {
  for (auto word = words.begin(); word != words.end(); ++word) {
    const std::string name = word->name();
    if (custom_text(m, name) || mj_name2id(m, mjOBJ_NUMERIC, name.c_str()) >= 0) {
      refuse(word->element, message("{} is in <custom> too; remove one of them", name));
    }
    for (auto other = words.begin(); other != word; ++other) {
      if (other->name() != name) continue;
      refuse(word->element,
             message("describes the same contact as {}; keep one instance for each contact",
                     other->element));
    }
  }
}

bool names_corrected_pair(const mjModel* m) {
  bool any = false;
  for_each_text(m, [&any](const std::string& name) {
    PairName of;
    any = any || is_key(name, names::kOwnConeCoulombPair, of);
  });
  return any;
}

// Beside corrected <pair>s alone such a number would have no effect.
void refuse_numbers_of_no_contact(const mjModel* m) {
  for_each_number(m, [m](const std::string& name, mjtNum) {
    if (PairName of; is_key(name, names::kOwnUserData, of)) return;
    refuse(own_element(m, name),
           "belongs to no contact; a corrected <pair> has its own friction and solref");
  });
}

bool is_numbering(const std::string& suffix) {
  return suffix.find_first_of("0123456789") != suffix.npos &&
         suffix.find_first_not_of("_-0123456789") == suffix.npos;
}

}  // namespace

bool has_own_names(const mjModel* m) {
  const auto ours = [m](int address) { return is_ours(m->names + address); };
  return has_instances(m) || std::any_of(m->name_textadr, m->name_textadr + m->ntext, ours) ||
         std::any_of(m->name_numericadr, m->name_numericadr + m->nnumeric, ours);
}

std::vector<PairName> own_pair_names(const mjModel* m) {
  Refusals refusals;
  std::vector<PairName> pairs = own_pair_names(m, refusals);
  refusals.raise();
  return pairs;
}

std::vector<PairName> own_pair_names(const mjModel* m, Refusals& refusals) {
  std::vector<PairName> pairs;
  const auto add = [&pairs](const PairName& pair) {
    if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
  };
  for_each_text(m, [&add](const std::string& name) {
    for (const char* key : {names::kOwnRotorGeom, names::kOwnRingGeom}) {
      if (PairName pair; is_key(name, key, pair)) add(pair);
    }
  });
  const std::vector<InstanceWord> words = instance_words(m);
  refusals.attempt([&] { refuse_said_twice(m, words); });
  for (const InstanceWord& word : words) {
    if (std::string_view(names::kOwnConeCoulombPair) != word.key) add(word.contact);
  }
  check_names(m, pairs.empty() ? std::vector<PairName>{{}} : pairs, refusals);
  if (!pairs.empty()) return pairs;
  if (names_corrected_pair(m)) {
    refusals.attempt([&] { refuse_numbers_of_no_contact(m); });
  } else {
    pairs.emplace_back();  // there are other names; the geoms of their contact are missing
  }
  return pairs;
}

void refuse_own_names(const mjModel* m) {
  if (has_instances(m)) {
    refuse("<extension>",
           "has a contact beside the contact of the scene's text; remove one of them");
  }
  for_each_text(m, [m](const std::string& name) {
    if (name == names::kSceneText || name == names::kContactText) return;
    check(m, name, kOwnTexts, "text", {{}});
    refuse(own_element(m, name), "stands beside a scene's text; remove one of them");
  });
  for_each_number(m, [m](const std::string& name, mjtNum) {
    if (name == names::kOwnFrictionReference) return;
    check(m, name, kOwnNumbers, "numeric", {{}});
    refuse(own_element(m, name), "the scene's text has its own; set the value in the scene");
  });
}

std::vector<int> corrected_pairs(const mjModel* m) {
  std::vector<int> pairs;
  for_each_text(m, [&](const std::string& name) {
    PairName of;
    if (!is_key(name, names::kOwnConeCoulombPair, of)) return;
    const char* said = own_text(m, name);
    int pair = mj_name2id(m, mjOBJ_PAIR, (of.prefix + said).c_str());
    if (pair < 0) pair = mj_name2id(m, mjOBJ_PAIR, said);
    if (pair < 0) refuse(own_element(m, name), message("no <pair> is called \"{}\"", said));
    if (m->pair_dim[pair] < 3) {
      refuse(
          own_element(m, name),
          message("<pair name=\"{}\"> has no friction to correct; set condim=\"3\" or more", said));
    }
    if (std::find(pairs.begin(), pairs.end(), pair) != pairs.end()) {
      refuse(own_element(m, name),
             message("<pair name=\"{}\"> is named twice and would be corrected twice; name it once",
                     said));
    }
    // MuJoCo treats two <pair>s of the same geoms as two contacts, so a name would be ambiguous.
    if (count_pairs(m, m->pair_geom1[pair], m->pair_geom2[pair]) > 1) {
      refuse(
          own_element(m, name),
          message("another <pair> has the same two geoms as \"{}\"; keep one <pair> for two geoms",
                  said));
    }
    check_corrected_pair(m, pair);
    pairs.push_back(pair);
  });
  return pairs;
}

const char* own_text(const mjModel* m, const std::string& name) {
  if (const char* text = custom_text(m, name)) return text;
  for (const InstanceWord& word : instance_words(m)) {
    if (word.name() == name) return word.value;
  }
  return nullptr;
}

std::optional<OwnNumber> own_number(const mjModel* m, const std::string& name) {
  if (const int id = mj_name2id(m, mjOBJ_NUMERIC, name.c_str()); id >= 0) {
    OwnNumber number;
    number.size = m->numeric_size[id];
    std::copy_n(m->numeric_data + m->numeric_adr[id],
                std::min(number.size, static_cast<int>(number.values.size())),
                number.values.begin());
    return number;
  }
  for (const InstanceWord& word : instance_words(m)) {
    if (word.name() == name) return parse(word);
  }
  return std::nullopt;
}

std::optional<double> own_value(const mjModel* m, const std::string& name) {
  const std::optional<OwnNumber> number = own_number(m, name);
  if (!number) return std::nullopt;
  if (number->size == 1) return number->values[0];
  refuse(own_element(m, name), message("has {} numbers; give one", number->size));
}

std::string own_element(const mjModel* m, const std::string& name) {
  const bool number = std::any_of(kOwnNumbers.begin(), kOwnNumbers.end(),
                                  [&](const char* key) { return name.find(key) != name.npos; });
  return element_of(m, number ? "numeric" : "text", name);
}

namespace {

std::vector<std::string_view> geom_names(const mjModel* m) {
  std::vector<std::string_view> names;
  for (int k = 0; k < m->ngeom; ++k) {
    const std::string_view name = m->names + m->name_geomadr[k];
    if (!name.empty()) names.push_back(name);
  }
  return names;
}

}  // namespace

int own_geom(const mjModel* m, const PairName& pair, const char* text) {
  const std::string element = own_element(m, pair.of(text));
  const char* said = own_text(m, pair.of(text));
  if (!said) refuse(element, "missing, but another name of its contact is there");
  const int literal = mj_name2id(m, mjOBJ_GEOM, said);
  int id = mj_name2id(m, mjOBJ_GEOM, pair.of(said).c_str());
  if (id >= 0 && literal >= 0 && id != literal && is_numbering(pair.suffix)) {
    refuse(element, message("both geoms, \"{}\" and \"{}\", exist, so the name is ambiguous; write "
                            "\"{}\", or choose a number with which no geom ends",
                            said, pair.of(said), pair.of(said)));
  }
  if (id < 0) id = literal;
  if (id < 0) {
    const std::string_view meant = scene::nearest(said, geom_names(m));
    refuse(element, message("no geom is called \"{}\"{}", said,
                            meant.empty() ? "" : message(", did you mean \"{}\"?", meant)));
  }
  const int type = m->geom_type[id];
  if (type < mjGEOM_SPHERE || type > mjGEOM_BOX) {
    refuse(message("<geom name=\"{}\">", m->names + m->name_geomadr[id]),
           "a rotor or ring must be a sphere, capsule, ellipsoid, cylinder or box");
  }
  return id;
}

int own_memory(const mjModel* m) {
  double memory = 0.0;
  bool given = false;
  for_each_number(m, [&](const std::string& name, mjtNum value) {
    PairName of;
    if (!is_key(name, names::kOwnUserData, of)) return;
    const std::string element = own_element(m, name);
    own_value(m, name);  // refuses several numbers
    if (!(value >= 0.0) || value != std::floor(value) || value > 1e9) {
      refuse(element, message("{} must be an index, 0, 1, 2, ...", value));
    }
    if (given && value != memory) {
      refuse(element, message("{} differs from {} elsewhere; give one value in the whole model",
                              value, memory));
    }
    memory = value;
    given = true;
  });
  return static_cast<int>(memory);
}

scene::ContactModel contact_model(const mjModel* m, const std::string& text_name,
                                  scene::ContactModel otherwise) {
  const char* text = own_text(m, text_name);
  if (!text) return otherwise;
  if (const auto model = scene::contact_model(text)) return *model;
  refuse(own_element(m, text_name),
         message("\"{}\" is not a contact model; choose from {}", text,
                 scene::join(scene::contact_words<std::vector<std::string_view>>())));
}

}  // namespace rotorub::plugin
