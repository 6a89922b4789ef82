#include "plugin/model/options.h"

#include <algorithm>

#include "plugin/model/later_attributes.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

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

// With an elliptic cone, PGS finds the force of a sliding contact only from a start that has one.
bool loses_sliding_contacts(const Config& config, const mjModel* m) {
  const bool needs_start = m->opt.solver == mjSOL_PGS && !mj_isPyramidal(m) &&
                           (m->opt.disableflags & mjDSBL_WARMSTART) != 0;
  return needs_start &&
         (!config.corrected_pairs.empty() ||
          std::any_of(config.pairs.begin(), config.pairs.end(), [](const ContactPair& pair) {
            return pair.contact_model == scene::ContactModel::kConeCoulomb;
          }));
}

}  // namespace

const char* refused_options(const Config& config, const mjModel* m) {
  if (const char* why = refused_attributes(config, m)) return why;
  if (bearing_is_disabled(m, config)) {
    return "rotorub: <option actuatorgroupdisable>: disables an actuator of the bearing, whose "
           "force the plugin computes; put the bearing's actuators in another group";
  }
  if (may_fall_asleep(config, m)) {
    return "rotorub: <flag sleep=\"enable\"/>: rotor or ring would sleep under the plugin's loads; "
           "set sleep=\"never\" on the bodies that carry them, or \"disable\" here";
  }
  if ((m->opt.enableflags & mjENBL_OVERRIDE) && config.has_soft()) {
    return "rotorub: <flag override=\"enable\"/>: MuJoCo's solver then uses o_margin, o_solref and "
           "o_solimp of <option> instead of the rotor's <pair>, which sets contact models coulomb, "
           "cone and cone-coulomb; set \"disable\", or use contact model rigid";
  }
  if (loses_sliding_contacts(config, m)) {
    return "rotorub: <flag warmstart=\"disable\"/>: with solver=\"PGS\" and cone=\"elliptic\" "
           "MuJoCo's "
           "solver then misses sliding contacts of cone-coulomb and rotorub_cone_coulomb_pair; set "
           "\"enable\", or use solver=\"Newton\" or \"CG\"";
  }
  return nullptr;
}

const char* refused_integrator(const Config& config, const mjModel* m) {
  if (m->opt.integrator != mjINT_RK4) return nullptr;
  if (!config.model.samplers.empty()) {
    return "rotorub: <option integrator=\"RK4\">: a magnetic bearing's control is sampled once a "
           "step; use Euler, implicit or, since MuJoCo 2.3.3, implicitfast";
  }
  if (!config.has_rigid()) return nullptr;
  return "rotorub: <option integrator=\"RK4\">: contact model `rigid` applies its impulses once a "
         "step; use Euler, implicit or, since MuJoCo 2.3.3, implicitfast (or contact model "
         "coulomb, "
         "cone or cone-coulomb)";
}

const char* refused_silence(const mjModel* m) {
  if (!passive_disabled(m) || !control_skipped(m)) return nullptr;
  return "rotorub: <flag spring=\"disable\" damper=\"disable\" actuation=\"disable\"/>: MuJoCo "
         "then calls nothing in which the contact could act; enable one of them";
}

}  // namespace rotorub::plugin
