#include "plugin/chain_constraints.h"

#include <algorithm>
#include <vector>

#include "native_model/scene/scene.h"
#include "plugin/mujoco_derivatives.h"
#include "plugin/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

class Chain {
 public:
  Chain(const mjModel* m, const Config& config) : m_(m), dofs_(config.dof_address) {}

  bool has_body(int body) const {
    return std::any_of(dofs_.begin(), dofs_.end(), [&](int dof) {
      return dof >= 0 && m_->body_rootid[m_->dof_bodyid[dof]] == m_->body_rootid[body];
    });
  }
  bool has_joint(int joint) const { return joint >= 0 && has_body(m_->jnt_bodyid[joint]); }
  bool has_geom(int geom) const { return has_body(m_->geom_bodyid[geom]); }
  bool has_tendon(int tendon) const {
    if (tendon < 0) return false;
    const int* type = m_->wrap_type + m_->tendon_adr[tendon];
    const int* id = m_->wrap_objid + m_->tendon_adr[tendon];
    for (int i = 0; i < m_->tendon_num[tendon]; ++i) {
      if (type[i] == mjWRAP_JOINT && has_joint(id[i])) return true;
      if (type[i] == mjWRAP_SITE && has_body(m_->site_bodyid[id[i]])) return true;
      const bool geom = type[i] == mjWRAP_SPHERE || type[i] == mjWRAP_CYLINDER;
      if (geom && has_geom(id[i])) return true;
    }
    return false;
  }
  bool has_transmission(int actuator) const {
    const int id = m_->actuator_trnid[2 * actuator];
    switch (m_->actuator_trntype[actuator]) {
      case mjTRN_JOINT:
      case mjTRN_JOINTINPARENT:
        return has_joint(id);
      case mjTRN_TENDON:
        return has_tendon(id);
      case mjTRN_SITE:
      case mjTRN_SLIDERCRANK:
        return has_body(m_->site_bodyid[id]);
      default:
        return true;
    }
  }
  bool has_equality(int equality) const {
    const int a = m_->eq_obj1id[equality], b = m_->eq_obj2id[equality];
    switch (m_->eq_type[equality]) {
      case mjEQ_JOINT:
        return has_joint(a) || has_joint(b);
      case mjEQ_TENDON:
        return has_tendon(a) || has_tendon(b);
      default:
        return has_body(a) || has_body(b);
    }
  }
  // By MuJoCo's own filter of types; what else it filters (parents, excludes) may stay in.
  bool collides(int geom) const {
    if (!has_geom(geom) || !collides_freely(m_)) return false;
    for (int other = 0; other < m_->ngeom; ++other) {
      const bool same = m_->geom_bodyid[other] == m_->geom_bodyid[geom];
      const bool meets = (m_->geom_contype[geom] & m_->geom_conaffinity[other]) ||
                         (m_->geom_contype[other] & m_->geom_conaffinity[geom]);
      if (!same && meets) return true;
    }
    return false;
  }

 private:
  const mjModel* m_;
  const std::vector<int>& dofs_;
};

std::string element(const mjModel* m, const char* tag, int type, int id, const char* what) {
  const char* name = mj_id2name(m, type, id);
  return "<" + std::string(tag) + " name=\"" + (name ? name : "") + "\"" + what + ">";
}

// The first one found, as `<joint name="x_1" limited>`; empty: none. Whether it is active or not.
std::string added_constraint(const mjModel* m, const Config& config) {
  const Chain chain(m, config);
  for (int i = 0; i < m->neq; ++i) {
    if (chain.has_equality(i)) return element(m, "equality", mjOBJ_EQUALITY, i, "");
  }
  for (int i = 0; i < m->njnt; ++i) {
    if (m->jnt_limited[i] && chain.has_joint(i)) {
      return element(m, "joint", mjOBJ_JOINT, i, " limited");
    }
  }
  for (int i = 0; i < m->nv; ++i) {
    if (m->dof_frictionloss[i] > 0.0 && chain.has_joint(m->dof_jntid[i])) {
      return element(m, "joint", mjOBJ_JOINT, m->dof_jntid[i], " frictionloss");
    }
  }
  for (int i = 0; i < m->ntendon; ++i) {
    const bool acts = m->tendon_limited[i] || m->tendon_frictionloss[i] > 0.0;
    if (acts && chain.has_tendon(i)) return element(m, "tendon", mjOBJ_TENDON, i, "");
  }
  for (int i = 0; i < m->ngeom; ++i) {
    if (chain.collides(i)) return element(m, "geom", mjOBJ_GEOM, i, "");
  }
  for (int i = 0; i < m->npair; ++i) {
    const int a = m->pair_geom1[i], b = m->pair_geom2[i];
    if (!collides_pairs(m) || i == config.pair) continue;
    if (chain.has_geom(a) || chain.has_geom(b)) return element(m, "pair", mjOBJ_GEOM, a, "");
  }
  return {};
}

// MuJoCo takes the rate of its force into an implicit step.
bool force_has_rate(const mjModel* m, int actuator) {
  const int gain = m->actuator_gaintype[actuator], bias = m->actuator_biastype[actuator];
  if (gain == mjGAIN_AFFINE && m->actuator_gainprm[mjNGAIN * actuator + 2] != 0.0) return true;
  if (bias == mjBIAS_AFFINE && m->actuator_biasprm[mjNBIAS * actuator + 2] != 0.0) return true;
  const bool known_gain = gain == mjGAIN_FIXED || gain == mjGAIN_AFFINE || gain == mjGAIN_USER;
  const bool known_bias = bias == mjBIAS_NONE || bias == mjBIAS_AFFINE || bias == mjBIAS_USER;
  return !known_gain || !known_bias;
}

}  // namespace

bool damping_is_added(const mjModel* m, const Config& config) {
  if (!config.model.first().contact || config.segments || scene::is_cone(config.contact))
    return false;
  const Chain chain(m, config);
  for (int i = 0; i < m->nv && damped_step(m) > 0.0; ++i) {
    if (joint_damping_varies(m, i) && chain.has_joint(m->dof_jntid[i])) return true;
  }
  if (!steps_implicitly(m)) return false;
  for (int i = 0; i < actuator_count(m); ++i) {
    if (force_has_rate(m, i) && chain.has_transmission(i)) return true;
  }
  for (int i = 0; i < m->ntendon; ++i) {
    if (tendon_damps(m, i) && chain.has_tendon(i)) return true;
  }
  return m->opt.density > 0.0 || m->opt.viscosity > 0.0;
}

void choose_path(const mjModel* m, Config& config) {
  if (scene::is_cone(config.contact)) return;
  config.damping_added = damping_is_added(m, config);
  const std::string constraint = added_constraint(m, config);
  if (constraint.empty() && !config.damping_added) return;
  config.general = true;
  config.verlet_data = -1;
  if (!config.model.coupled_mass()) return;
  const std::string added = constraint.empty() ? "what MuJoCo steps implicitly" : constraint;
  const std::string text = "rotorub: " + added +
                           " acts on a generated rotor with unbalance and a drive: the contact is "
                           "solved beside it without their coupling of spin and bending";
  warn(text.c_str());
}

}  // namespace rotorub::plugin
