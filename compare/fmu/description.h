// The file modelDescription.xml of an FMU, which describes its variables.
#pragma once

#include <string>

#include "native_model/run/stepwise_run.h"

namespace rotorub::fmi {

enum class Version { k2, k3 };

// Path of this platform's binary within the FMU.
std::string binary_path(const scene::Scene& scene, Version version);

// run: of the scene. Throws std::invalid_argument for names that XML does not allow.
std::string model_description(const scene::Scene& scene, const StepwiseRun& run, Version version);

}  // namespace rotorub::fmi
