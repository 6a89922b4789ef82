// Whether a run can be done at all: its steps, samples of its controller and the rows of its
// series, before the first step.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "native_model/scene/scene.h"
#include "native_model/system/model.h"

namespace rotorub {

// Days of computing on any machine.
inline constexpr double kMostSteps = 1e10;
// Numbers of a series: 2 GB of memory, 5 GB of text.
inline constexpr double kMostSeriesValues = 2.5e8;

// Throws scene::SceneError for a run of more than kMostSteps of `fixed_step`, s, or samples of its
// controller.
void check_steps(const scene::Scene& scene, double fixed_step);

// Throws scene::SceneError for a run that is too large. fixed_step: s, absent for an integrator
// that chooses its own. times: of the rows, if they are not those of the scene.
void check_run_size(const scene::Scene& scene, const Model& model, std::optional<double> fixed_step,
                    const std::vector<double>* times = nullptr);

}  // namespace rotorub
