#include "plugin/own/own_names.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string_view>

#include "mjcf/names.h"
#include "native_model/scene/diagnostic.h"
#include "plugin/message.h"

namespace rotorub::plugin {
namespace {

namespace names = mjcf_names;

constexpr const char* kTexts[] = {names::kContactText, names::kOwnRotorGeom, names::kOwnRingGeom};
constexpr const char* kNumbers[] = {names::kOwnClearance,  names::kOwnRadius,
                                    names::kOwnFriction,   names::kOwnRestitution,
                                    names::kOwnTangential, names::kOwnFrictionReference,
                                    names::kOwnWidth,      names::kOwnUserData};

bool is_ours(std::string_view name) { return name.find(names::kOwnMark) != name.npos; }

// Calls action(name) for each name of ours.
template <typename Action>
void for_each_text(const mjModel* m, Action action) {
  for (int i = 0; i < m->ntext; ++i) {
    const std::string name = m->names + m->name_textadr[i];
    if (is_ours(name)) action(name);
  }
}
template <typename Action>
void for_each_number(const mjModel* m, Action action) {
  for (int i = 0; i < m->nnumeric; ++i) {
    const std::string name = m->names + m->name_numericadr[i];
    if (is_ours(name)) action(name, m->numeric_data[m->numeric_adr[i]]);
  }
}

// Whether `name` is `key` between a prefix and a suffix, which are then in `pair`.
bool is_key(const std::string& name, std::string_view key, PairName& pair) {
  const std::size_t at = name.find(names::kOwnMark);
  if (name.compare(at, key.size(), key) != 0) return false;
  pair = {name.substr(0, at), name.substr(at + key.size())};
  return true;
}

std::vector<std::string> all_of(std::span<const char* const> keys,
                                const std::vector<PairName>& pairs) {
  std::vector<std::string> all;
  for (const PairName& pair : pairs) {
    for (const char* key : keys) all.push_back(pair.of(key));
  }
  return all;
}

// Nothing of ours may be misspelt: it would count as not given.
void check(const std::string& name, std::span<const char* const> keys, const char* kind,
           const std::vector<PairName>& pairs) {
  for (const char* key : keys) {
    PairName pair;
    if (!is_key(name, key, pair)) continue;
    if (key == names::kOwnUserData && pair.suffix.empty()) return;
    if (std::find(pairs.begin(), pairs.end(), pair) != pairs.end()) return;
  }
  const std::vector<std::string> known = all_of(keys, pairs);
  const std::vector<std::string_view> views(known.begin(), known.end());
  const std::string_view meant = scene::nearest(name, views);
  refuse(
      message("<custom><{} name=\"{}\">", kind, name),
      message("unknown{}; accepted: {}",
              meant.empty() ? "" : message(", did you mean \"{}\"?", meant), scene::join(views)));
}

void check_names(const mjModel* m, const std::vector<PairName>& pairs) {
  for_each_text(m, [&](const std::string& name) {
    PairName of;
    if (is_key(name, names::kSceneText, of)) {
      refuse(text_element(name.c_str()),
             "a scene stands alone, with its own names; accepted in an attached model: geoms and "
             "numbers (plugin/README.md, a model of your own)");
    }
    if (is_key(name, names::kOwnConeCoulombPair, of)) return;  // of any ending
    check(name, kTexts, "text", pairs);
  });
  for_each_number(
      m, [&](const std::string& name, mjtNum) { check(name, kNumbers, "numeric", pairs); });
}

bool is_number(const std::string& suffix) {
  return suffix.find_first_of("0123456789") != suffix.npos &&
         suffix.find_first_not_of("_-0123456789") == suffix.npos;
}

}  // namespace

bool has_own_names(const mjModel* m) {
  const auto ours = [m](int address) { return is_ours(m->names + address); };
  return std::any_of(m->name_textadr, m->name_textadr + m->ntext, ours) ||
         std::any_of(m->name_numericadr, m->name_numericadr + m->nnumeric, ours);
}

std::vector<PairName> own_pair_names(const mjModel* m) {
  std::vector<PairName> pairs;
  for_each_text(m, [&pairs](const std::string& name) {
    for (const char* key : {names::kOwnRotorGeom, names::kOwnRingGeom}) {
      PairName pair;
      if (!is_key(name, key, pair)) continue;
      if (std::find(pairs.begin(), pairs.end(), pair) == pairs.end()) pairs.push_back(pair);
    }
  });
  check_names(m, pairs.empty() ? std::vector<PairName>{{}} : pairs);
  if (pairs.empty() && corrected_pairs(m).empty())
    pairs.emplace_back();  // other names of ours: its geoms are missing
  return pairs;
}

void refuse_own_names(const mjModel* m) {
  for_each_text(m, [](const std::string& name) {
    if (name == names::kSceneText || name == names::kContactText) return;
    check(name, kTexts, "text", {{}});
    refuse(text_element(name.c_str()), "beside a scene's text; accepted: one");
  });
  for_each_number(m, [](const std::string& name, mjtNum) {
    if (name == names::kOwnFrictionReference) return;
    check(name, kNumbers, "numeric", {{}});
    refuse(message("<custom><numeric name=\"{}\">", name),
           "the scene's text has its own; accepted: the value in the scene");
  });
}

std::vector<int> corrected_pairs(const mjModel* m) {
  std::vector<int> pairs;
  for_each_text(m, [&](const std::string& name) {
    PairName of;
    if (!is_key(name, names::kOwnConeCoulombPair, of)) return;
    const char* said = custom_text(m, name);
    int pair = mj_name2id(m, mjOBJ_PAIR, (of.prefix + said).c_str());
    if (pair < 0) pair = mj_name2id(m, mjOBJ_PAIR, said);
    if (pair < 0) refuse(text_element(name.c_str()), message("no <pair> is called \"{}\"", said));
    if (m->pair_dim[pair] < 3) {
      refuse(
          text_element(name.c_str()),
          message("<pair name=\"{}\"> has no friction to correct; accepted: condim=\"3\" or more",
                  said));
    }
    pairs.push_back(pair);
  });
  return pairs;
}

const mjtNum* own_number(const mjModel* m, const std::string& name) {
  const int id = mj_name2id(m, mjOBJ_NUMERIC, name.c_str());
  return id < 0 ? nullptr : m->numeric_data + m->numeric_adr[id];
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
  const std::string element = text_element(pair.of(text).c_str());
  const char* said = custom_text(m, pair.of(text));
  if (!said) refuse(element, "missing, but another name of its contact is there");
  const int literal = mj_name2id(m, mjOBJ_GEOM, said);
  int id = mj_name2id(m, mjOBJ_GEOM, pair.of(said).c_str());
  if (id >= 0 && literal >= 0 && id != literal && is_number(pair.suffix)) {
    refuse(element,
           message("both geoms, \"{}\" and \"{}\", are there: which is meant? Accepted: \"{}\", "
                   "or a number with no geom that ends with it",
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
           "as rotor or ring, accepted types: sphere, capsule, ellipsoid, cylinder, box");
  }
  return id;
}

int own_memory(const mjModel* m) {
  double memory = 0.0;
  bool given = false;
  for_each_number(m, [&](const std::string& name, mjtNum value) {
    PairName of;
    if (!is_key(name, names::kOwnUserData, of)) return;
    const std::string element = message("<custom><numeric name=\"{}\">", name);
    if (!(value >= 0.0) || value != std::floor(value) || value > 1e9) {
      refuse(element, message("{}; accepted: an index, 0, 1, 2, ...", value));
    }
    if (given && value != memory) {
      refuse(element, message("{}, but {} elsewhere; accepted: one value in the whole model", value,
                              memory));
    }
    memory = value;
    given = true;
  });
  return static_cast<int>(memory);
}

}  // namespace rotorub::plugin
