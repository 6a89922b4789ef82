// MuJoCo as C++ sees it: its errors and warnings, mjModel and mjData with owners.
#pragma once

#include <mujoco/mujoco.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace rotorub {

// What mju_error said, which by itself waits for Enter, ends the process and writes a log file.
class MujocoError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// While one lives, errors are thrown as MujocoError and warnings are collected, each in its thread.
// MuJoCo's handlers are global: several may live at a time, in any threads; the first installs and
// the last one restores. A thread's newest has that thread's warnings since it was made.
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

// The same of a file, with what it includes.
MujocoModel load_mjcf_file(const std::filesystem::path& file);

// The keyframe that a run starts from: "start", or else "test"; -1: none is called so.
int start_keyframe(const mjModel* m);

// An mjData in the start of the run: that keyframe, or else mj_resetData's.
MujocoData make_start(const mjModel* m);

}  // namespace rotorub
