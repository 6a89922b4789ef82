#include "plugin/contact_plugin.h"

#include <mujoco/mujoco.h>

#include <exception>

#include "plugin/callbacks.h"
#include "plugin/make_config.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/own/instances.h"

namespace rotorub::plugin {

#if mjVERSION_HEADER >= 235
namespace {

// mju_error may leave by longjmp, so the frame that calls it contains nothing with a destructor.
thread_local char refusal_text[1000];

// True if the model can be read; otherwise refusal_text says why not.
bool can_be_read(const mjModel* m) {
  try {
    if (!callbacks_active()) {
      refuse(message("<extension><plugin plugin=\"{}\">", kInstancePlugin),
             "the plugin's callbacks are not installed; accepted: a plugin::Hooks that lives as "
             "long as the data");
    }
    make_config(m);
    return true;
  } catch (const std::exception& error) {
    copy_lines(error.what(), refusal_text);
    return false;
  }
}

// Called by mj_makeData and by the compiler, so that a bad model is refused when it is loaded.
int check_instance(const mjModel* m, mjData*, int) {
  if (can_be_read(m)) return 0;
  raise_error(refusal_text);
  return -1;
}

}  // namespace

void register_contact_plugin() {
  // another copy of this library has registered it
  if (mjp_getPlugin(kInstancePlugin, nullptr)) return;
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = kInstancePlugin;
  plugin.nattribute = static_cast<int>(instance_keys().size());
  plugin.attributes = instance_keys().data();
  // Of MuJoCo's capabilities this is the one that requires nothing else from the model. The plugin
  // does its work in the callbacks.
  plugin.capabilityflags = mjPLUGIN_PASSIVE;
  plugin.nstate = [](const mjModel*, int) { return 0; };
  plugin.init = check_instance;
  plugin.reset = [](const mjModel*, mjtNum*, void*, int) {};
  plugin.compute = [](const mjModel*, mjData*, int, int) {};
  mjp_registerPlugin(&plugin);
}
#else
void register_contact_plugin() {}
#endif

}  // namespace rotorub::plugin
