#include "compare/base/version.h"

#include <mujoco/mujoco.h>

#include "plugin/model/mujoco_versions.h"

namespace rotorub {

std::string program_version() { return ROTORUB_VERSION; }

std::string mujoco_version() { return mj_versionString(); }

std::string version_line() {
  const bool same = mj_version() == mjVERSION_HEADER;
  return "rotorub " + program_version() + " (MuJoCo: headers " +
         plugin::version_text(mjVERSION_HEADER) + ", run time " + mujoco_version() +
         (same ? "" : ": MuJoCo runs are refused") + ")";
}

}  // namespace rotorub
