// The file modelDescription.xml of an FMU: what its variables are.
#pragma once

#include <string>

#include "native_model/run/stepwise_run.h"

namespace rotorub::fmi {

enum class Version { k2, k3 };

// Of the binary within the FMU, on this platform.
std::string binary_path(const scene::Scene& scene, Version version);

// run: of the scene. Throws std::invalid_argument for names that XML cannot hold.
std::string model_description(const scene::Scene& scene, const StepwiseRun& run, Version version);

}  // namespace rotorub::fmi
