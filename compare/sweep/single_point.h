// A point run by itself, by any engine.
#pragma once

#include <atomic>
#include <memory>
#include <optional>

#include "compare/engine/engine.h"
#include "compare/sweep/point_result.h"
#include "compare/sweep/study_file.h"

namespace rotorub::sweep {

// The engine that the study asks for, for this scene.
std::unique_ptr<Engine> engine_of(const Study& study, const scene::Scene& scene);

// Nothing: interrupted. Scenes that the engine refuses are a result too.
std::optional<PointResult> run_single(std::int64_t point, const scene::Scene& scene,
                                      const Engine& engine, const std::atomic<bool>& interrupt);

PointResult refused(std::int64_t point, std::string reason);

}  // namespace rotorub::sweep
