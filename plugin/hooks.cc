#include "plugin/hooks.h"

#include <dlfcn.h>
#include <mujoco/mujoco.h>

#include "plugin/callbacks.h"

namespace rotorub::plugin {
namespace {

// The mark that register.cc exports.
bool preloaded() {
  static const bool found = dlsym(RTLD_DEFAULT, "rotorub_mujoco_preloaded") != nullptr;
  return found;
}

int living = 0;

}  // namespace

Hooks::Hooks() {
  if (!preloaded() && living++ == 0) install_callbacks();
}

Hooks::~Hooks() {
  if (!preloaded() && --living == 0) restore_callbacks();
}

bool hooks_installed() { return preloaded() || living > 0; }

}  // namespace rotorub::plugin
