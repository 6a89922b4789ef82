#include "compare/version.h"

#include <mujoco/mujoco.h>

namespace rotorub {

std::string program_version() { return ROTORUB_VERSION; }

std::string mujoco_version() { return mj_versionString(); }

}  // namespace rotorub
