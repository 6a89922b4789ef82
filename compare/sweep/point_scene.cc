#include "compare/sweep/point_scene.h"

#include <optional>

#include "native_model/scene/overrides.h"
#include "native_model/system/model.h"

namespace rotorub::sweep {
namespace {

std::vector<std::string> joined(std::span<const std::string> a, const std::vector<std::string>& b) {
  std::vector<std::string> all(a.begin(), a.end());
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

}  // namespace

PointScenes::PointScenes(const Study& study, std::span<const std::string> overrides)
    : study_(&study), sample_(study), variants_(study.scene, joined(overrides, study.overrides)) {}

scene::Scene PointScenes::at(std::int64_t index) const {
  const std::vector<Value> values = sample_.at(index);
  std::vector<std::string> changes;
  for (std::size_t k = 0; k < values.size(); ++k) {
    changes.push_back(study_->vary[k].key + "=" + values[k].text);
  }
  return variants_.scene(changes, study_->engine == EngineKind::kMujoco);
}

void PointScenes::check() const {
  std::optional<scene::SceneError> first;
  for (const std::int64_t index : {std::int64_t{0}, sample_.size() / 2, sample_.size() - 1}) {
    try {
      make_model(at(index));
      return;
    } catch (const scene::SceneError& error) {
      if (!first) first = error;
    }
  }
  throw *first;
}

std::string reason_of(const scene::SceneError& error) {
  std::string text;
  for (scene::Diagnostic d : error.diagnostics()) {
    // The row's own values came as overrides; of the scene the line is enough.
    d.file = d.file == scene::kOverrideFile ? std::string()
                                            : std::filesystem::path(d.file).filename().string();
    text += (text.empty() ? "" : "; ") + scene::to_string(d);
  }
  return text;
}

}  // namespace rotorub::sweep
