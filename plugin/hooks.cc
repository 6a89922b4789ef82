#include "plugin/hooks.h"

#include <dlfcn.h>

#include <atomic>
#include <mutex>

#include "plugin/callbacks.h"

namespace rotorub::plugin {
namespace {

// The mark that register.cc exports: preloaded, or loaded since (mj_loadPluginLibrary).
bool preloaded() {
  static const bool found = dlsym(RTLD_DEFAULT, "rotorub_mujoco_preloaded") != nullptr;
  return found || dlopen("librotorub_mujoco.so", RTLD_LAZY | RTLD_NOLOAD) != nullptr;
}

std::mutex mutex;  // of who installs and restores
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
