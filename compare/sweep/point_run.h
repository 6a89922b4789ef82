// Runs single points of a study on any engine.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "compare/sweep/point_result.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// The engine that the study requests for this scene.
std::unique_ptr<Engine> engine_of(const Study& study, const scene::Scene& scene);

// Why a scene or an engine refuses `work`; empty if it does not.
std::optional<std::string> refusal_of(const std::function<void()>& work);

using SceneOfPoint =
    std::function<scene::Scene(std::int64_t point)>;  // thread safe; throws scene::SceneError

// Empty if interrupted. Values that make no valid scene, and a scene that the engine refuses, are
// also a result.
std::optional<PointResult> run_point(const Study& study, std::int64_t point,
                                     const SceneOfPoint& scene_at,
                                     const std::atomic<bool>& interrupt);

// Runs the points 0 to count - 1 of a native study on all processors; the result has their order.
// Points missing after an interrupt have an empty status.
std::vector<PointResult> run_points(const Study& study, std::int64_t count,
                                    const SceneOfPoint& scene_at,
                                    const std::atomic<bool>& interrupt);

}  // namespace rotorub::sweep
