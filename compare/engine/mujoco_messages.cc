#include "compare/engine/mujoco_messages.h"

#include <mujoco/mujoco.h>

#include <mutex>
#include <utility>

namespace rotorub {
namespace {

std::mutex messages_mutex;
int living = 0;
void (*previous_error)(const char*) = nullptr;
void (*previous_warning)(const char*) = nullptr;
thread_local std::vector<std::string> collected;

// MuJoCo's C frames are unwound by the exception; its data are not used again after one.
void on_error(const char* message) { throw MujocoError(message); }

void on_warning(const char* message) { collected.emplace_back(message); }

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

}  // namespace rotorub
