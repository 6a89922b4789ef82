// The file modelDescription.xml of an FMU, which describes its variables.
#pragma once

#include <string>
#include <vector>

#include "native_model/run/stepwise_run.h"

namespace rotorub::fmi {

enum class Version { k2, k3 };

// Path of this platform's binary within the FMU.
std::string binary_path(const scene::Scene& scene, Version version);

// The outputs of the run that the FMU shows; coordinates of single modes only if `modal`.
std::vector<StepwiseRun::Port> outputs_of(const StepwiseRun& run, bool modal);

// run: of the scene. modal: also show the coordinates of single modes. Throws std::invalid_argument
// for names that XML does not allow.
std::string model_description(const scene::Scene& scene, const StepwiseRun& run, Version version,
                              bool modal);

}  // namespace rotorub::fmi
