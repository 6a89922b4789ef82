#include "plugin/options.h"

#include <algorithm>

#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {

namespace {

// Stiffness and impedance of a row without either, once its reference is in `pos`.
constexpr double kOurs = 1.0;

}  // namespace

KeptReferences::KeptReferences(const mjModel* m, mjData* d)
    : d_(d), room_(d), aref_(room_.numbers(d->nefc)), velocity_(room_.numbers(d->nefc)) {
  for (int i = 0; i < d->nefc; ++i) {
    const mjtNum* kbip = d->efc_KBIP + 4 * i;
    if (kbip[0] == kOurs && kbip[2] == kOurs) d->efc_pos[i] = d->efc_margin[i];
  }
  mj_referenceConstraint(m, d);
  std::copy_n(d->efc_aref, d->nefc, aref_);
  std::copy_n(d->efc_vel, d->nefc, velocity_);
}

void KeptReferences::keep() {
  for (int i = 0; i < d_->nefc; ++i) {
    if (d_->efc_aref[i] == aref_[i]) continue;
    mjtNum* kbip = d_->efc_KBIP + 4 * i;
    if (kbip[0] * kbip[2] == 0.0) kbip[0] = kbip[2] = kOurs;
    const double rest = d_->efc_aref[i] + kbip[1] * velocity_[i];
    d_->efc_pos[i] = d_->efc_margin[i] - rest / (kbip[0] * kbip[2]);
  }
}

bool may_fall_asleep(const Config& config, const mjModel* m) {
  if (!sleep_enabled(m)) return false;
  if (config.own || config.has_contact()) {
    return std::any_of(config.pairs.begin(), config.pairs.end(), [m](const ContactPair& pair) {
      return tree_may_sleep(m, m->geom_bodyid[pair.rotor_geom]) ||
             tree_may_sleep(m, m->geom_bodyid[pair.ring_geom]);
    });
  }
  return std::any_of(config.dof_address.begin(), config.dof_address.end(),
                     [m](int dof) { return dof >= 0 && tree_may_sleep(m, m->dof_bodyid[dof]); });
}

void refuse_sleep() {
  raise_error(
      "rotorub: <flag sleep=\"enable\"/>: rotor or ring would sleep under the plugin's loads; "
      "accepted: sleep=\"never\" on the bodies that carry them, or \"disable\"");
}

bool is_overridden(const Config& config, const mjModel* m) {
  return (m->opt.enableflags & mjENBL_OVERRIDE) && config.has_soft();
}

void refuse_override() {
  raise_error(
      "rotorub: <flag override=\"enable\"/>: MuJoCo's solver then takes o_margin, o_solref and "
      "o_solimp of <option> "
      "for those of the rotor's <pair>, by which contact models coulomb and cone are set; "
      "accepted: \"disable\", "
      "or contact model rigid");
}

void refuse_silence() {
  raise_error(
      "rotorub: <flag spring=\"disable\" damper=\"disable\" actuation=\"disable\"/>: MuJoCo then "
      "calls nothing that the contact could act in; accepted: one of them enabled");
}

void refuse_runge_kutta() {
  raise_error(
      "rotorub: <option integrator=\"RK4\">: contact model `rigid` gives its impulses once a step; "
      "accepted: Euler, implicit (or contact model coulomb or cone)");
}

}  // namespace rotorub::plugin
