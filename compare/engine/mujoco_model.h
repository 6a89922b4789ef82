// mjModel and mjData with owners.
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <string>

namespace rotorub {

struct MujocoDeleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using MujocoModel = std::unique_ptr<mjModel, MujocoDeleter>;
using MujocoData = std::unique_ptr<mjData, MujocoDeleter>;

// Compiles an MJCF document. Throws std::runtime_error with MuJoCo's message.
MujocoModel load_mjcf(const std::string& document);

// The same of a file, with what it includes.
MujocoModel load_mjcf_file(const std::filesystem::path& file);

// An mjData in the start of the run: keyframe "start", or "test", or else mj_resetData's.
MujocoData make_start(const mjModel* m);

}  // namespace rotorub
