// C++ wrappers of MuJoCo: errors and warnings, and owners of mjModel and mjData.
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace rotorub {

// An error raised by mju_error. By default mju_error would wait for Enter, end the process and
// write a log file.
class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// While an object of this class exists, errors are thrown as MujocoError and warnings are collected
// per thread. MuJoCo's handlers are global: several objects may exist at a time, in any threads;
// the first installs the handlers and the last restores the previous ones. warnings() returns the
// warnings of the calling thread since that thread last made an object.
class MujocoMessages {
 public:
  MujocoMessages();
  ~MujocoMessages();
  MujocoMessages(const MujocoMessages&) = delete;
  MujocoMessages& operator=(const MujocoMessages&) = delete;

  std::vector<std::string> warnings() const;
};

struct MujocoDeleter {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};
using MujocoModel = std::unique_ptr<mjModel, MujocoDeleter>;
using MujocoData = std::unique_ptr<mjData, MujocoDeleter>;

// Compiles an MJCF document. Throws std::runtime_error with MuJoCo's message.
MujocoModel load_mjcf(const std::string& document);

// The same for a file and its includes.
MujocoModel load_mjcf_file(const std::filesystem::path& file);

// The keyframe that a run starts from: "start", otherwise "test"; -1 if neither exists.
int start_keyframe(const mjModel* m);

// An mjData at the start of the run: at that keyframe, or as mj_makeData initialises it.
MujocoData make_start(const mjModel* m);

}  // namespace rotorub
