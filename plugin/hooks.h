// The C++ API of the plugin: installs MuJoCo's callbacks for as long as a Hooks lives.
//
//   rotorub::plugin::Hooks hooks;  // mjcb_control, _passive, _sensor, _act_gain, _act_bias,
//                                  // _act_dyn and the collision table
//   mjModel* m = mj_loadXML("bench_ring.xml", ...);   // any model; others are left alone
//
// What was installed before is called first, and comes back at the end. What is installed after it
// (mjcb_control = mine, mj_resetCallbacks()) takes nothing of ours away: it is noticed in the pass
// that is under way and called before ours (places.h). MuJoCo's callbacks are global to the
// process: make the first and destroy the last Hooks while no other thread steps. Several may live
// at a time, in any threads; the last one restores. Where librotorub_mujoco.so is preloaded, it
// does the work and Hooks does nothing.
//
// Errors in a model's custom text are reported by mju_error, while the model is loaded: mj_loadXML
// then fails with the message.
#pragma once

namespace rotorub::plugin {

class Hooks {  // MuJoCo's callbacks are the plugin's while one lives
 public:
  Hooks();
  ~Hooks();
  Hooks(const Hooks&) = delete;
  Hooks& operator=(const Hooks&) = delete;
};

// True while the callbacks are installed, by Hooks or by the preloaded library.
bool hooks_installed();

}  // namespace rotorub::plugin
