#include "compare/version.h"

#include <mujoco/mujoco.h>

#include "plugin/mujoco_versions.h"

namespace rotorub {

std::string program_version() { return ROTORUB_VERSION; }

std::string mujoco_version() { return mj_versionString(); }

std::string version_line() {
  const std::string loaded = mujoco_version(), built = plugin::version_text(mjVERSION_HEADER);
  const bool same = mj_version() == mjVERSION_HEADER;
  return "rotorub " + program_version() + " (" +
         (same ? "MuJoCo " + loaded
               : "built for MuJoCo " + built + ", loaded " + loaded + ": MuJoCo runs are refused") +
         ")";
}

}  // namespace rotorub
