#include "compare/engine/mujoco_model.h"

#include <mutex>
#include <stdexcept>

#include "mjcf/names.h"
#include "plugin/mujoco_versions.h"

namespace rotorub {

namespace {

// By load(error, size).
template <typename Load>
MujocoModel loaded(Load load) {
  // MuJoCo's parser and compiler share state between threads.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  char error[1000] = "";
  MujocoModel model(load(error, static_cast<int>(sizeof error)));
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
  return model;
}

}  // namespace

MujocoModel load_mjcf_file(const std::filesystem::path& file) {
  return loaded([name = file.string()](char* error, int size) {
    return mj_loadXML(name.c_str(), nullptr, error, size);
  });
}

MujocoModel load_mjcf(const std::string& document) {
  return loaded([&](char* error, int size) { return plugin::load_text(document, error, size); });
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
