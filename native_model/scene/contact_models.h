// The contact models of MuJoCo's side and their words: in scene files, options, columns and
// reports.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "native_model/scene/scene.h"

namespace rotorub::scene {

struct ContactWord {
  ContactModel model;
  const char* word;
};

// In the order of the enum, which is that of every table.
inline constexpr std::array kContactModels{ContactWord{ContactModel::kRigid, "rigid"},
                                           ContactWord{ContactModel::kCoulomb, "coulomb"},
                                           ContactWord{ContactModel::kCone, "cone"},
                                           ContactWord{ContactModel::kConeCoulomb, "cone-coulomb"}};

constexpr const char* to_string(ContactModel model) {
  return kContactModels[static_cast<std::size_t>(model)].word;
}

// Of a word; none: no contact model is called so.
constexpr std::optional<ContactModel> contact_model(std::string_view word) {
  for (const ContactWord& w : kContactModels) {
    if (word == w.word) return w.model;
  }
  return std::nullopt;
}

// Normal force and friction are both found by MuJoCo's solver, in its friction cone.
constexpr bool is_cone(ContactModel model) {
  return model == ContactModel::kCone || model == ContactModel::kConeCoulomb;
}

// Container of words, as schemas and options take them.
template <typename Words>
Words contact_words() {
  Words words;
  for (const ContactWord& w : kContactModels) words.emplace_back(w.word);
  return words;
}

}  // namespace rotorub::scene
