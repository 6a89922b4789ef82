#include "compare/engine/mujoco_model.h"

#include <mutex>
#include <stdexcept>
#include <utility>

#include "mjcf/names.h"
#include "plugin/model/control.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub {
namespace {

std::mutex messages_mutex;
int living = 0;
void (*previous_error)(const char*) = nullptr;
void (*previous_warning)(const char*) = nullptr;
thread_local std::vector<std::string> collected;

// The exception unwinds MuJoCo's C frames; the data are not used again afterwards.
void on_error(const char* message) { throw MujocoError(message); }

void on_warning(const char* message) { collected.emplace_back(message); }

// Loads a model with load(error, size).
template <typename Load>
MujocoModel loaded(Load load) {
  // MuJoCo's parser and compiler share state between threads.
  static std::mutex mutex;
  const std::lock_guard<std::mutex> lock(mutex);
  const plugin::WhileCompiling compiling;
  char error[1000] = "";
  MujocoModel model(load(error, static_cast<int>(sizeof error)));
  if (!model) throw std::runtime_error(std::string("MuJoCo: ") + error);
  return model;
}

}  // namespace

MujocoMessages::MujocoMessages() {
  collected.clear();
  const std::lock_guard<std::mutex> lock(messages_mutex);
  if (living++ > 0) return;
  previous_error = std::exchange(mju_user_error, on_error);
  previous_warning = std::exchange(mju_user_warning, on_warning);
}

MujocoMessages::~MujocoMessages() {
  const std::lock_guard<std::mutex> lock(messages_mutex);
  if (--living > 0) return;
  mju_user_error = previous_error;
  mju_user_warning = previous_warning;
}

std::vector<std::string> MujocoMessages::warnings() const { return collected; }

MujocoModel load_mjcf_file(const std::filesystem::path& file) {
  return loaded([name = file.string()](char* error, int size) {
    return mj_loadXML(name.c_str(), nullptr, error, size);
  });
}

MujocoModel load_mjcf(const std::string& document) {
  return loaded([&](char* error, int size) { return plugin::load_text(document, error, size); });
}

int start_keyframe(const mjModel* m) {
  const int key = mj_name2id(m, mjOBJ_KEY, mjcf_names::kStartKey);
  return key >= 0 ? key : mj_name2id(m, mjOBJ_KEY, mjcf_names::kTestKey);
}

MujocoData make_start(const mjModel* m) {
  MujocoData data(mj_makeData(m));
  if (!data) throw std::runtime_error("MuJoCo: no memory for mjData");
  if (const int key = start_keyframe(m); key >= 0) mj_resetDataKeyframe(m, data.get(), key);
  return data;
}

}  // namespace rotorub
