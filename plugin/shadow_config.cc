#include "plugin/shadow_config.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>

#include "mjcf/names.h"
#include "native_model/stepping/step_limit.h"
#include "plugin/message.h"
#include "plugin/sensor_addresses.h"

namespace rotorub::plugin {

namespace names = mjcf_names;

void map_shadow(const mjModel* m, ShadowConfig& s) {
  const std::string refusal = step_refusal(s.model, m->opt.timestep);
  if (!refusal.empty()) {
    refuse(text_element(names::kSceneText),
           message("mujoco.shadow: the native model cannot run alongside: {}; accepted: a smaller "
                   "run.step, or false",
                   refusal));
  }
  s.gap = sensor_address(m, names::kShadowGap, 1);
  s.normal_force = sensor_address(m, names::kShadowNormalForce, 1);
  s.friction_force = sensor_address(m, names::kShadowFrictionForce, 1);
  s.rotor = sensor_address(m, names::kShadowRotor, 2);
  s.stator = sensor_address(m, names::kShadowStator, 2);
  s.mujoco_rotor = sensor_address(m, names::kRotorPosition, 2);
  const auto ghost = [m](const char* name) {
    const int body = mj_name2id(m, mjOBJ_BODY, name);
    return body < 0 || m->body_mocapid[body] < 0 ? -1 : 3 * m->body_mocapid[body];
  };
  s.ghost_rotor = ghost(names::kGhostRotor);
  s.ghost_ring = ghost(names::kGhostRing);
}

double mark_of(const Model& model) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto add = [&hash](const double* x, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x[i])) * 1099511628211ULL;
    }
  };
  for (const auto* list : {&model.mass, &model.stiffness, &model.damping, &model.weight}) {
    add(list->data(), static_cast<std::size_t>(list->size()));
  }
  if (model.first().contact) add(&model.first().contact->radius, 1);
  if (model.first().contact) add(&model.first().contact->clearance, 1);
  if (model.first().contact) add(&model.first().contact->friction.coefficient, 1);
  add(&model.first().force_limit, 1);
  return 1.0 + static_cast<double>(hash >> 12);
}

}  // namespace rotorub::plugin
