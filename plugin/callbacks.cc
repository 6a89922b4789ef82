#include "plugin/callbacks.h"

#include <atomic>
#include <exception>
#include <utility>

#include "plugin/callback_slot.h"
#include "plugin/make_config.h"
#include "plugin/model/actuators.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_versions.h"
#include "plugin/own/instances.h"
#include "plugin/passes.h"

namespace rotorub::plugin {
namespace {

std::atomic<bool> active = false;

constinit CallbackSlot<mjfGeneric> passive_slot(&mjcb_passive), control_slot(&mjcb_control);
constinit CallbackSlot<mjfSensor> sensor_slot(&mjcb_sensor);
constinit CallbackSlot<mjfAct> gain_slot(&mjcb_act_gain), bias_slot(&mjcb_act_bias),
    rate_slot(&mjcb_act_dyn);

void passive(const mjModel* m, mjData* d) {
  if (callbacks_active()) passive_pass(m, d);
}
void control(const mjModel* m, mjData* d) {
  begin_actuators(d);
  if (callbacks_active()) control_pass(m, d);
}
void sensor(const mjModel* m, mjData* d, int stage) {
  if (callbacks_active()) sensor_pass(m, d, stage);
}
// Other actuators have the values that MuJoCo uses without a callback, or those of the previously
// installed callback.
template <ActuatorQuestion kAsked>
bool answer(const mjModel* m, const mjData* d, int id, mjtNum& value) {
  return callbacks_active() && magnet_answers(kAsked, m, d, id, value);
}

// Calls action(slot, links) for each of the callbacks.
template <typename Action>
void for_each_callback(Action action) {
  action(passive_slot, Links<passive_slot, passive>::kTable);
  action(control_slot, Links<control_slot, control>::kTable);
  action(sensor_slot, Links<sensor_slot, sensor>::kTable);
  using enum ActuatorQuestion;
  action(gain_slot, ActuatorLinks<gain_slot, answer<kGain>, kGain>::kTable);
  action(bias_slot, ActuatorLinks<bias_slot, answer<kBias>, kBias>::kTable);
  action(rate_slot, ActuatorLinks<rate_slot, answer<kRate>, kRate>::kTable);
}

// MuJoCo's table is for ordered pairs of types. The geoms of a scene are a sphere and a capsule;
// those of a user's own model may have any type from sphere to box.
constexpr int kFirstShape = mjGEOM_SPHERE, kShapes = mjGEOM_BOX - mjGEOM_SPHERE + 1;
constinit CallbackSlot<mjfCollision> collision_slots[kShapes][kShapes];
std::atomic<int> collisions_taken = 0;

CallbackSlot<mjfCollision>& collision_slot(const mjModel* m, int g1, int g2) {
  const int a = m->geom_type[g1] - kFirstShape, b = m->geom_type[g2] - kFirstShape;
  return a < b ? collision_slots[a][b] : collision_slots[b][a];
}

// The arguments of mjfCollision differ between MuJoCo's versions, so they are taken from its type.
template <typename Function>
struct Collision;

template <typename Model, typename Data, typename Contact, typename... Rest>
struct Collision<int (*)(Model, Data, Contact, int, int, Rest...)> {
  static inline thread_local constinit LinkCall call;

  template <int K>
  static int link(Model m, Data d, Contact con, int g1, int g2, Rest... rest) {
    int count = 0;
    if (callbacks_active() && collide_pair(m, d, con, g1, g2, count)) return count;
    const CallbackSlot<mjfCollision>& slot = collision_slot(m, g1, g2);
    const mjfCollision previous = slot.previous(K);
    if (!previous) return 0;
    LinkScope scope(call, d, K);
    scope.reaches([&] { count = previous(m, d, con, g1, g2, rest...); });
    return count;
  }
  static constexpr LinkTable<mjfCollision> kTable = make_links<Collision, mjfCollision>();
};

template <typename Action>
void for_each_collision(Action action) {
  for (int i = 0; i < kShapes; ++i) {
    for (int j = i; j < kShapes; ++j) action(collision_slots[i][j], i, j);
  }
}

// The engine plugin of own/instances.h, as MuJoCo calls it.
#if mjVERSION_HEADER >= 235
// mju_error may leave by longjmp, so the frame that calls it contains nothing with a destructor.
thread_local char refusal_text[1000];

// True if the model can be read; otherwise refusal_text says why not.
bool can_be_read(const mjModel* m) {
  try {
    if (!callbacks_active()) {
      refuse(message("<extension><plugin plugin=\"{}\">", kInstancePlugin),
             "the plugin's callbacks are not installed; keep a plugin::Hooks as long as the data");
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

// Does nothing if it is registered already.
void register_contact_plugin() {
  // another copy of this library has registered it
  if (mjp_getPlugin(kInstancePlugin, nullptr)) return;
  mjpPlugin plugin;
  mjp_defaultPlugin(&plugin);
  plugin.name = kInstancePlugin;
  plugin.nattribute = static_cast<int>(instance_keys().size());
  plugin.attributes = instance_keys().data();
  // mjPLUGIN_PASSIVE is the only capability that requires nothing else from the model. The plugin
  // itself works in the callbacks.
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

}  // namespace

void install_callbacks() {
  if (mj_version() != mjVERSION_HEADER) {
    const std::string text =
        "rotorub: built for MuJoCo " + version_text(mjVERSION_HEADER) + ", the program has " +
        version_text(mj_version()) +
        ", whose structures differ; use a plugin that is built for this version";
    raise_error(text.c_str());
    return;
  }
  for_each_callback([](auto& slot, const auto& links) {
    slot.link_with(links.data());
    slot.take();
  });
  for_each_collision([](auto& slot, int i, int j) {
    slot.set_global(&mjCOLLISIONFUNC[kFirstShape + i][kFirstShape + j]);
    slot.link_with(Collision<mjfCollision>::kTable.data());
    slot.take();
  });
  register_contact_plugin();
  active = true;
}

void restore_callbacks() {
  active = false;
  for_each_callback([](auto& slot, const auto&) { slot.give_back(); });
  for_each_collision([](auto& slot, int, int) { slot.give_back(); });
}

bool callbacks_active() { return active.load(std::memory_order_relaxed); }

bool callbacks_lost() {
  return !(passive_slot.reaches_plugin() && control_slot.reaches_plugin() &&
           sensor_slot.reaches_plugin() && gain_slot.reaches_plugin() &&
           bias_slot.reaches_plugin() && rate_slot.reaches_plugin());
}

void keep_callbacks() {
  if (!callbacks_lost()) return;
  for_each_callback([](auto& slot, const auto&) { slot.take(); });
}

bool collision_was_lost(const Config& config, const mjModel* m) {
  for (const ContactPair& pair : config.pairs) {
    CallbackSlot<mjfCollision>& slot = collision_slot(m, pair.rotor_geom, pair.ring_geom);
    if (!slot.reaches_plugin() && slot.take()) ++collisions_taken;
  }
  const int taken = collisions_taken.load(std::memory_order_acquire);
  static thread_local constinit int known = 0;
  return std::exchange(known, taken) != taken;
}

bool distrust_control() { return control_slot.distrust(); }
bool distrust_passive() { return passive_slot.distrust(); }

}  // namespace rotorub::plugin
