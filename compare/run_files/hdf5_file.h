// run.h5: a run in one HDF5 file. Groups `series`, `impacts`, `events`, `keyphasor`, a dataset a
// column with the attributes `unit` and `meaning`; attributes of the file: what summary.json says,
// but for times taken, and the scene as `scene_text`.
#pragma once

#include <string>

#include "compare/hdf5/module.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::hdf5 {

// The bytes of the file: the same run, the same bytes.
std::string run_file(ImageOf image_of, const scene::Scene& scene, const std::string& scene_text,
                     const Trajectory& trajectory);

}  // namespace rotorub::hdf5
