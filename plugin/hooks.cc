#include "plugin/hooks.h"

#include <dlfcn.h>

#include <atomic>
#include <mutex>

#include "plugin/callbacks.h"

namespace rotorub::plugin {
namespace {

// True if librotorub_mujoco.so is preloaded, which the symbol exported by register.cc shows, or was
// loaded since (mj_loadPluginLibrary).
bool preloaded() {
  static const bool found = dlsym(RTLD_DEFAULT, "rotorub_mujoco_preloaded") != nullptr;
  return found || dlopen("librotorub_mujoco.so", RTLD_LAZY | RTLD_NOLOAD) != nullptr;
}

std::mutex mutex;  // held while callbacks are installed or restored
std::atomic<int> living = 0;

}  // namespace

Hooks::Hooks() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!preloaded() && living++ == 0) install_callbacks();
}

Hooks::~Hooks() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (!preloaded() && --living == 0) restore_callbacks();
}

bool hooks_installed() { return preloaded() || living > 0; }

}  // namespace rotorub::plugin
