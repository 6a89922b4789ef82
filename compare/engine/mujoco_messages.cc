#include "compare/engine/mujoco_messages.h"

#include <mujoco/mujoco.h>

#include <mutex>

namespace rotorub {
namespace {

std::mutex mutex;
std::vector<std::string> collected;

// MuJoCo's C frames are unwound by the exception; its data are not used again after one.
void on_error(const char* message) { throw MujocoError(message); }

void on_warning(const char* message) {
  const std::lock_guard<std::mutex> lock(mutex);
  collected.emplace_back(message);
}

}  // namespace

MujocoMessages::MujocoMessages()
    : previous_error_(mju_user_error), previous_warning_(mju_user_warning) {
  mju_user_error = on_error;
  mju_user_warning = on_warning;
  const std::lock_guard<std::mutex> lock(mutex);
  collected.clear();
}

MujocoMessages::~MujocoMessages() {
  mju_user_error = previous_error_;
  mju_user_warning = previous_warning_;
}

std::vector<std::string> MujocoMessages::warnings() const {
  const std::lock_guard<std::mutex> lock(mutex);
  return collected;
}

}  // namespace rotorub
