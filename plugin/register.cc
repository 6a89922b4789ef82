// If the library is loaded with LD_PRELOAD, it installs its callbacks before the program starts:
//   LD_PRELOAD=librotorub_mujoco.so mujoco-testspeed bench_ring.xml
// It also replaces some of MuJoCo's own functions, which call one another through the same names.
// It therefore sees the beginning of each pass, even if all its callbacks were removed, and when
// MuJoCo's sensors have been filled; and it replaces mj_inverse, mjd_transitionFD, mj_contactForce
// and mj_rnePostConstraint.
#include <dlfcn.h>
#include <link.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "plugin/callbacks.h"
#include "plugin/config_cache.h"
#include "plugin/contact_force.h"
#include "plugin/differences.h"
#include "plugin/inverse.h"
#include "plugin/load_cells.h"
#include "plugin/model/actuators.h"
#include "plugin/model/mujoco_versions.h"

namespace plugin = rotorub::plugin;

#define ROTORUB_EXPORT extern "C" __attribute__((visibility("default")))

// Tells a program that also links the plugin that this library does the work (hooks.cc).
ROTORUB_EXPORT const int rotorub_mujoco_preloaded;
const int rotorub_mujoco_preloaded = 1;

namespace {

using Pass = void (*)(const mjModel*, mjData*);
using SkippingPass = void (*)(const mjModel*, mjData*, int, int);

// mjtByte; another type in later versions.
using Centered = plugin::Argument<decltype(mjd_transitionFD), 3>;

template <typename Function>
Function original(const char* name) {
  return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

void keep(const mjModel* m, const mjData* d) {
  if (plugin::callbacks_lost() && plugin::find_config(m, d)) {
    plugin::keep_callbacks();
  }
}

// Counts the MuJoCo libraries in the process. With a second one the plugin could use the structures
// or callbacks of the wrong one.
int count_mujoco(dl_phdr_info* info, std::size_t, void* count) {
  const std::string_view path = info->dlpi_name;
  const std::string_view file = path.substr(path.rfind('/') + 1);
  if (file.starts_with("libmujoco.so")) ++*static_cast<int*>(count);
  return 0;
}

// False if the library was loaded later than MuJoCo (mj_loadPluginLibrary): then it replaces none
// of MuJoCo's functions.
bool stands_before_mujoco() {
  Dl_info ours, found;
  const void* first = dlsym(RTLD_DEFAULT, "mj_sensorAcc");
  return dladdr(&rotorub_mujoco_preloaded, &ours) && first && dladdr(first, &found) &&
         ours.dli_fbase == found.dli_fbase;
}

// True while MuJoCo fills its own sensors in this thread, or computes the forces between bodies.
// Both receive the plugin's forces from load_cells.h, so mj_contactForce, which they call, must not
// add them.
thread_local bool without_plugin = false;

__attribute__((constructor)) void install() {
  int mujocos = 0;
  dl_iterate_phdr(count_mujoco, &mujocos);
  if (mujocos > 1) {
    // MuJoCo may not be ready for mju_error yet.
    const std::string built = plugin::version_text(mjVERSION_HEADER);
    std::fprintf(stderr,
                 "rotorub: this plugin is built for MuJoCo %s, but the program has another "
                 "version; use a plugin that is built for the program's version\n",
                 built.c_str());
    std::_Exit(1);
  }
  if (stands_before_mujoco()) plugin::set_preloaded();
  plugin::install_callbacks();
}

}  // namespace

ROTORUB_EXPORT void mj_step1(const mjModel* m, mjData* d) {
  static const auto step = original<Pass>("mj_step1");
  keep(m, d);
  step(m, d);
  plugin::allow_edits(m, d);
}

// Called by mj_step, mj_forward and the integrators.
ROTORUB_EXPORT void mj_forwardSkip(const mjModel* m, mjData* d, int skipstage, int skipsensor) {
  static const auto forward = original<SkippingPass>("mj_forwardSkip");
  keep(m, d);
  forward(m, d, skipstage, skipsensor);
}

ROTORUB_EXPORT void mj_sensorAcc(const mjModel* m, mjData* d) {
  static const auto sensors = original<Pass>("mj_sensorAcc");
  without_plugin = true;
  sensors(m, d);
  without_plugin = false;
  if (!plugin::callbacks_active() || (m->opt.disableflags & mjDSBL_SENSOR)) return;
  const plugin::Config* config = plugin::find_config(m, d);
  if (config && !config->cells_in_callback) plugin::fill_load_cells(*config, m, d);
}

ROTORUB_EXPORT void mj_contactForce(const mjModel* m, const mjData* d, int id, mjtNum result[6]) {
  static const auto force = original<decltype(&mj_contactForce)>("mj_contactForce");
  if (without_plugin) {
    force(m, d, id, result);
  } else {
    plugin::contact_force(m, d, id, result, force);
  }
}

ROTORUB_EXPORT void mj_rnePostConstraint(const mjModel* m, mjData* d) {
  static const auto rne = original<Pass>("mj_rnePostConstraint");
  if (without_plugin) {
    rne(m, d);
    return;
  }
  plugin::rne_post_constraint(m, d, [](const mjModel* model, mjData* data) {
    without_plugin = true;
    rne(model, data);
    without_plugin = false;
  });
}

// The plugin also calls this function, whether it is preloaded or not. MuJoCo's own is in the
// library that contains mj_forward.
ROTORUB_EXPORT void mj_fwdActuation(const mjModel* m, mjData* d) {
  static const auto actuation = [] {
    Dl_info mujoco;
    dladdr(reinterpret_cast<void*>(&mj_forward), &mujoco);
    return reinterpret_cast<Pass>(
        dlsym(dlopen(mujoco.dli_fname, RTLD_LAZY | RTLD_NOLOAD), "mj_fwdActuation"));
  }();
  if (!plugin::actuators_computed(m, d)) actuation(m, d);
}

ROTORUB_EXPORT void mj_inverseSkip(const mjModel* m, mjData* d, int skipstage, int skipsensor) {
  static const auto inverse = original<SkippingPass>("mj_inverseSkip");
  keep(m, d);
  plugin::inverse_with_contact(m, d, skipstage, skipsensor, inverse);
}

ROTORUB_EXPORT void mjd_transitionFD(const mjModel* m, mjData* d, mjtNum eps, Centered centered,
                                     mjtNum* A, mjtNum* B, mjtNum* C, mjtNum* D) {
  static const auto differences = original<decltype(&mjd_transitionFD)>("mjd_transitionFD");
  if (!plugin::find_config(m, d) || !(eps > 0.0)) {
    differences(m, d, eps, centered, A, B, C, D);
    return;
  }
  const plugin::Transition t = plugin::transition(m, d, eps);
  if (A) std::copy(t.A.begin(), t.A.end(), A);
  if (B) std::copy(t.B.begin(), t.B.end(), B);
  if (C) std::copy(t.C.begin(), t.C.end(), C);
  if (D) std::copy(t.D.begin(), t.D.end(), D);
}
