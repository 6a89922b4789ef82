// run.h5: a run in one HDF5 file. It has the groups `series`, `impacts`, `events` and `keyphasor`,
// with one dataset per column and the attributes `unit` and `meaning`. The attributes of the file
// are the contents of summary.json except for computing times, and the scene as `scene_text`.
#pragma once

#include <string>

#include "compare/hdf5/module.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub::hdf5 {

// The bytes of the file; equal for equal runs.
std::string run_file(ImageOf image_of, const scene::Scene& scene, const std::string& scene_text,
                     const Trajectory& trajectory);

}  // namespace rotorub::hdf5
