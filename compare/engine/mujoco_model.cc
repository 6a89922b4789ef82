#include "compare/engine/mujoco_model.h"

#include <cstring>
#include <mutex>
#include <stdexcept>

#include "mjcf/names.h"

namespace rotorub {

namespace {

// MuJoCo's parser and compiler share state between threads.
MujocoModel load(const std::string& name, const mjVFS* files) {
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  char error[1000] = "";
  MujocoModel model(mj_loadXML(name.c_str(), files, error, sizeof error));
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
  return model;
}

}  // namespace

MujocoModel load_mjcf_file(const std::filesystem::path& file) { return load(file.string(), nullptr); }

MujocoModel load_mjcf(const std::string& document) {
  // A file in memory; mjVFS is too large for the stack.
  const auto files = std::make_unique<mjVFS>();
  mj_defaultVFS(files.get());
  constexpr const char* kFile = "scene.xml";
  if (mj_makeEmptyFileVFS(files.get(), kFile, static_cast<int>(document.size())) != 0) {
    throw std::runtime_error("MuJoCo: no memory for the model's document");
  }
  std::memcpy(files->filedata[mj_findFileVFS(files.get(), kFile)], document.data(),
              document.size());
  struct Delete {
    mjVFS* files;
    ~Delete() { mj_deleteVFS(files); }
  } const at_the_end{files.get()};
  return load(kFile, files.get());
}

MujocoData make_start(const mjModel* m) {
  MujocoData data(mj_makeData(m));
  if (!data) throw std::runtime_error("MuJoCo: no memory for mjData");
  for (const char* name : {mjcf_names::kStartKey, mjcf_names::kTestKey}) {
    const int key = mj_name2id(m, mjOBJ_KEY, name);
    if (key < 0) continue;
    mj_resetDataKeyframe(m, data.get(), key);
    break;
  }
  return data;
}

}  // namespace rotorub
