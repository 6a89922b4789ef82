// Any two parts of a machine as a scene. Every scene contains its text, so that MuJoCo can run it
// too.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/pair_parts.h"

namespace rotorub::test {

// The base with these parts; the overrides in `more` are applied last.
inline scene::Scene scene_of(Form form, const std::vector<Part>& parts,
                             const std::vector<std::string>& more = {}) {
  std::string name;
  std::vector<std::string> overrides;
  for (const Part& part : parts) {
    name += (name.empty() ? "" : " x ") + part.name;
    const std::vector<std::string>& own = part.overrides(form);
    overrides.insert(overrides.end(), own.begin(), own.end());
  }
  overrides.insert(overrides.end(), more.begin(), more.end());
  scene::Scene scene = scene::parse_scene(form == Form::kGeometry ? kBaseGeometry : kBaseModal,
                                          "pair.toml", overrides);
  scene.name = (form == Form::kGeometry ? "shaft: " : "modal: ") + name;
  return scene;
}

struct Pair {
  Form form;
  std::vector<Part> parts;
  scene::Scene scene() const { return scene_of(form, parts); }
};

// Daily tests use every eighth pair, nightly tests use all.
enum class Pairs { kEveryEighth, kAll };

// The part of that name alone, and its pairs with the parts after it in the list, in both forms.
// Over all names, every pair occurs once.
inline std::vector<Pair> pairs_from(const std::string& name, Pairs which) {
  const std::vector<Part> all = pair_parts();
  std::vector<Pair> out;
  bool after = false;
  const Part* first = nullptr;
  std::size_t sum = 0;  // sum of the indices of both parts, which spreads the selected pairs evenly
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Part& part = all[k];
    if (part.name == name) {
      first = &part;
      sum = k;
    }
    if (!first) continue;
    if (after && which == Pairs::kEveryEighth && (sum + k) % 8 != 0) continue;
    for (const Form form : {Form::kGeometry, Form::kModal}) {
      if (first->overrides(form).empty() || part.overrides(form).empty()) continue;
      if (after && part.group == first->group) continue;
      out.push_back(after ? Pair{form, {*first, part}} : Pair{form, {part}});
    }
    after = true;
  }
  return out;
}

inline std::vector<std::string> part_names() {
  std::vector<std::string> names;
  for (const Part& part : pair_parts()) names.push_back(part.name);
  return names;
}

}  // namespace rotorub::test
