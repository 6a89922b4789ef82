// The C++ API of the plugin: installs MuJoCo's callbacks for as long as a Hooks lives.
//
//   rotorub::plugin::Hooks hooks;  // mjcb_control, _passive, _sensor, _act_gain, _act_bias,
//                                  // _act_dyn and the collision table
//   mjModel* m = mj_loadXML("bench_ring.xml", ...);   // any model; foreign models are left alone
//
// Previously installed callbacks are called first, and are restored at the end. Callbacks that are
// installed later (mjcb_control = mine, mj_resetCallbacks()) do not remove the plugin's: the plugin
// notices them in the same pass and calls them before its own (callback_slot.h). MuJoCo's callbacks
// are global to the process, so make the first and destroy the last Hooks while no other thread
// steps. Several may live at a time, in any threads; the last one restores. If librotorub_mujoco.so
// is preloaded, it does the work and Hooks does nothing.
//
// Errors in a model's custom text are reported by mju_error while the model is loaded: mj_loadXML
// then fails with the message.
#pragma once

namespace rotorub::plugin {

class Hooks {  // the plugin's callbacks are installed while one lives
 public:
  Hooks();
  ~Hooks();
  Hooks(const Hooks&) = delete;
  Hooks& operator=(const Hooks&) = delete;
};

// True while the callbacks are installed, by Hooks or by the preloaded library.
bool hooks_installed();

}  // namespace rotorub::plugin
