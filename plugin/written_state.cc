#include "plugin/written_state.h"

#include <cmath>

#include "native_model/scene/mujoco.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/relative_motion.h"
#include "plugin/model/differentiating.h"
#include "plugin/model/user_data.h"

namespace rotorub::plugin {
namespace {

// before: m, distance of the centres in the previous pass.
bool is_written(const ContactPair& pair, PairMotion& motion, double h, double before) {
  constexpr double kSmall = 1e-6;  // share of the clearance; smaller impacts do not matter
  const ContactPoint point = motion.point();
  const double closing = -h * point.gap_rate;
  if (!(closing > kSmall * pair.contact.clearance)) return false;
  const double from = std::hypot(point.delta - closing, h * point.whirl_speed());
  const double bend = 0.5 * h * h * motion.turning().norm();
  return std::abs(from - before) > 0.5 * closing + 2.0 * bend;
}

// Calls action(pair, entry) for the contacts that `rigid` solves in MuJoCo's step.
template <typename Action>
void for_each_rigid(const Config& config, mjData* d, Action action) {
  if (config.takes_native_steps()) return;
  for (const ContactPair& pair : config.pairs) {
    if (pair.contact_model == scene::ContactModel::kRigid) action(pair, contact_entries(pair, d));
  }
}

}  // namespace

void forget_written_contacts(const Config& config, const mjModel* m, mjData* d,
                             PassMotion& motion) {
  if (Differentiating::nudges(d)) return;  // a nudged state does not count as written
  for_each_rigid(config, d, [&](const ContactPair& pair, ContactEntries& entry) {
    // In a further pass at the same time the memory has already moved on (ContactMemory).
    mjtNum& lasted = entry.time == d->time ? entry.before : entry.now;
    if (lasted == 0.0 || !is_written(pair, motion.of(pair), m->opt.timestep, lasted)) return;
    lasted = 0.0;
    ContactStatus(entry.status).begin();
  });
}

}  // namespace rotorub::plugin
