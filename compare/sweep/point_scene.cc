#include "compare/sweep/point_scene.h"

#include <optional>

#include "native_model/scene/overrides.h"
#include "native_model/system/model.h"

namespace rotorub::sweep {
namespace {

std::vector<std::string> joined(const std::vector<std::string>& a, std::span<const std::string> b) {
  std::vector<std::string> all = a;
  all.insert(all.end(), b.begin(), b.end());
  return all;
}

}  // namespace

PointScenes::PointScenes(const Study& study, std::span<const std::string> overrides)
    : study_(&study), sample_(study), variants_(study.scene, joined(study.overrides, overrides)) {
  std::vector<scene::Diagnostic> twice;
  for (const std::string& text : overrides) {
    const std::string key = text.substr(0, text.find_last_not_of(" \t", text.find('=') - 1) + 1);
    if (!study.varies(key)) continue;
    twice.push_back({scene::kOverrideFile, 0, key, "varies in the study; set another key"});
  }
  if (!twice.empty()) throw scene::SceneError(std::move(twice));
}

scene::Scene PointScenes::at(std::int64_t index) const {
  const std::vector<Value> values = sample_.at(index);
  std::vector<std::string> changes;
  for (std::size_t k = 0; k < values.size(); ++k) {
    const Vary& vary = study_->vary[k];
    changes.push_back(vary.key + "=" + values[k].text);
    for (const std::string& key : vary.also) changes.push_back(key + "=" + values[k].text);
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
