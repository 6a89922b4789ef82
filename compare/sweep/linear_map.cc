#include "compare/sweep/linear_map.h"

#include <algorithm>

#include "native_model/rotor/refusal.h"

namespace rotorub::sweep {
namespace {

// Index of contact.friction among the keys, if it is not coupled to other keys and has numeric
// values.
std::optional<std::size_t> friction_key(const Study& study) {
  for (std::size_t k = 0; k < study.vary.size(); ++k) {
    const Vary& vary = study.vary[k];
    if (vary.key == "contact.friction" && vary.also.empty() && vary.has_numbers()) return k;
  }
  return {};
}

}  // namespace

bool LinearMap::any() const {
  return std::any_of(points.begin(), points.end(), [](const auto& p) { return p.has_value(); });
}

LinearMap linear_map(const PointScenes& scenes) {
  const Study& study = scenes.study();
  const std::optional<std::size_t> key = friction_key(study);
  LinearMap map;
  if (study.kind != SampleKind::kGrid || study.vary.size() < 2 || !key) return map;
  const std::int64_t count = study.vary[*key].count, size = scenes.sample().size();
  if (size / count > kMostSystems) return map;
  std::int64_t stride = 1;
  for (std::size_t k = *key + 1; k < study.vary.size(); ++k) stride *= study.vary[k].count;

  map.points.resize(static_cast<std::size_t>(size));
  for (std::int64_t first = 0; first < size; ++first) {
    if (first / stride % count != 0) continue;  // start only at the first friction of each rotor
    try {
      const scene::Scene scene = scenes.at(first);
      with_place(scene, [&] {
        const rub::RubStudy rubs(rub::rub_system(scene));
        for (std::int64_t k = 0; k < count; ++k) {
          const std::int64_t index = first + k * stride;
          const double friction = *scenes.sample().at(index)[*key].number;
          map.points[static_cast<std::size_t>(index)] = rubs.at(friction);
        }
      });
    } catch (const scene::SceneError& error) {
      if (map.refused.empty()) map.refused = reason_of(error);
    }
  }
  return map;
}

}  // namespace rotorub::sweep
