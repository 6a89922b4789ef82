// From a point of a study to its scene.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "compare/sweep/sample.h"
#include "native_model/scene/reader.h"

namespace rotorub::sweep {

class PointScenes {
 public:
  // `overrides`: of the command line, on top of the study's own. Throws scene::SceneError, also
  // where one of them sets what varies.
  PointScenes(const Study& study, std::span<const std::string> overrides);

  const Study& study() const { return *study_; }
  const Sample& sample() const { return sample_; }
  const std::string& scene_text() const { return variants_.text(); }

  // Thread safe. Throws scene::SceneError.
  scene::Scene at(std::int64_t index) const;

  // Throws scene::SceneError where the first, the middle and the last point are all refused: a
  // study that nothing can come of.
  void check() const;

 private:
  const Study* study_;
  Sample sample_;
  scene::Variants variants_;
};

// What is wrong with a scene, on one line, for a row of the results.
std::string reason_of(const scene::SceneError& error);

}  // namespace rotorub::sweep
