// Points of a study, each run by itself by any engine.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/sweep/point_result.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// The engine that the study asks for, for this scene.
std::unique_ptr<Engine> engine_of(const Study& study, const scene::Scene& scene);

// Nothing: interrupted. Scenes that the engine refuses are a result too.
std::optional<PointResult> run_single(std::int64_t point, const scene::Scene& scene,
                                      const Engine& engine, const std::atomic<bool>& interrupt);

using SceneOfPoint =
    std::function<scene::Scene(std::int64_t point)>;  // thread safe; throws scene::SceneError

// The same of a point of a study, whose values may make no scene either.
std::optional<PointResult> run_point(const Study& study, std::int64_t point,
                                     const SceneOfPoint& scene_at,
                                     const std::atomic<bool>& interrupt);

// All points of a native study from 0 to count - 1, on all processors, in their order; `interrupt`:
// those that are missing then have no status.
std::vector<PointResult> run_points(const Study& study, std::int64_t count,
                                    const SceneOfPoint& scene_at,
                                    const std::atomic<bool>& interrupt);

}  // namespace rotorub::sweep
