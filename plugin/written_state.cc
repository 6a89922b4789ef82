#include "plugin/written_state.h"

#include <cmath>

#include "native_model/model/dynamics.h"
#include "native_model/scene/scene.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/contact_space.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/model/differentiating.h"
#include "plugin/model/generated_rotor.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

ContactPoint point_in_pass(const Config& config, const ContactPair& pair, const mjModel* m,
                           const mjData* d) {
  if (!pair.on_chain) return contact_point_of(pair, m, d);
  const Coordinates state(config, d);
  return contact_point(config.model, state.q(), state.v(), pair.bearing);
}

// before: m, between the centres in the pass before.
bool is_written(const Config& config, const ContactPair& pair, const mjModel* m, const mjData* d,
                double before) {
  constexpr double kSmall = 1e-6;  // of the clearance: a blow that nobody misses
  const ContactPoint point = point_in_pass(config, pair, m, d);
  const double h = m->opt.timestep, closing = -h * point.gap_rate;
  if (!(closing > kSmall * pair.contact.clearance)) return false;
  const double from = std::hypot(point.delta - closing, h * point.whirl_speed());
  const double bend =
      pair.on_chain ? 0.0 : 0.5 * h * h * turning_of(pair, contact_place(pair, d), m, d).norm();
  return std::abs(from - before) > 0.5 * closing + 2.0 * bend;
}

// Those that `rigid` solves in MuJoCo's step. Calls action(pair, entry).
template <typename Action>
void for_each_rigid(const Config& config, mjData* d, Action action) {
  if (!config.has_rigid() || config.takes_native_steps()) return;
  for (const ContactPair& pair : config.pairs) {
    if (pair.law == scene::ContactModel::kRigid) action(pair, d->userdata + pair.data);
  }
}

}  // namespace

void forget_written_contacts(const Config& config, const mjModel* m, mjData* d) {
  if (Differentiating::in_this_thread()) return;  // a state that is nudged is not written
  for_each_rigid(config, d, [&](const ContactPair& pair, mjtNum* entry) {
    // In a further pass of the same time the memory has moved on already (ContactMemory).
    mjtNum& lasted = entry[kContactTime] == d->time ? entry[kContactBefore] : entry[kContactNow];
    if (lasted == 0.0 || !is_written(config, pair, m, d, lasted)) return;
    lasted = 0.0;
    EscapeGuard(entry).begin();
  });
}

void remember_places(const Config& config, const mjModel* m, mjData* d) {
  for_each_rigid(config, d, [&](const ContactPair& pair, mjtNum* entry) {
    if (entry[kContactNow] != 0.0) entry[kContactNow] = point_in_pass(config, pair, m, d).delta;
  });
}

}  // namespace rotorub::plugin
