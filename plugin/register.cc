// Loaded with LD_PRELOAD, the library installs its callbacks before the program starts:
//   LD_PRELOAD=librotorub_mujoco.so mujoco-testspeed bench_ring.xml
#include "plugin/callbacks.h"

// Tells a program that links the plugin too that the work is being done (hooks.cc).
extern "C" __attribute__((visibility("default"))) const int rotorub_mujoco_preloaded = 1;

namespace {

__attribute__((constructor)) void install() { rotorub::plugin::install_callbacks(); }

}  // namespace
