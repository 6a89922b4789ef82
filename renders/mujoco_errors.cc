#include "renders/mujoco_errors.h"

#include <mujoco/mujoco.h>

#include <stdexcept>
#include <string>

namespace rotorub::renders {

namespace {
[[noreturn]] void raise(const char* message) {
  throw std::runtime_error(std::string("off-screen rendering: MuJoCo: ") + message);
}
}  // namespace

MujocoErrors::MujocoErrors() : previous_(mju_user_error) { mju_user_error = raise; }
MujocoErrors::~MujocoErrors() { mju_user_error = previous_; }

}  // namespace rotorub::renders
