#include "plugin/model/generated_rotor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "native_model/model/dynamics.h"
#include "native_model/model/sampled_feedback.h"
#include "native_model/scene/mujoco.h"
#include "plugin/model/message.h"
#include "plugin/model/mujoco_actuators.h"
#include "plugin/model/mujoco_dynamics.h"
#include "plugin/model/mujoco_versions.h"

namespace rotorub::plugin {
namespace {

// f = -Omega G w on the bending rows; 0 elsewhere.
void gyroscopic_force(const Model& model, double omega, const double* w, double* f) {
  const Layout& l = model.layout;
  std::fill_n(f, l.nq(), 0.0);
  model.gyroscopic.add(-omega, w + l.y(), f + l.x(), l.modes);
  model.gyroscopic.add_transposed(omega, w + l.x(), f + l.y(), l.modes);
}

// Solves (M(phi) + h D) dv = h (f - Omega G (v + dv/2)) by fixed-point iteration. Each round
// reduces the error by the factor h Omega g / (2 m), far below 1 at any step that resolves the
// whirl.
void midpoint_velocity_change(const Config& config, const mjModel* m, const mjData* d,
                              const Coordinates& state, const double* mass, const double* f,
                              double* dv) {
  const Model& model = config.model;
  const int n = model.nq();
  const double h = m->opt.timestep, omega = spin_speed(model, state.v());
  double middle[kMaxCoordinates], force[kMaxCoordinates];
  std::fill_n(dv, n, 0.0);
  constexpr int kRounds = 60;
  for (int round = 0; round < kRounds; ++round) {
    for (int i = 0; i < n; ++i) middle[i] = state.v()[i] + 0.5 * dv[i];
    gyroscopic_force(model, omega, middle, force);
    for (int i = 0; i < n; ++i) force[i] = h * (force[i] + f[i]);
    solve_mass(model, mass, d->time, state.q(), force, force);
    double change = 0.0, size = 0.0;
    for (int i = 0; i < n; ++i) {
      change = std::max(change, std::abs(force[i] - dv[i]));
      size = std::max(size, std::abs(force[i]));
      dv[i] = force[i];
    }
    if (!(change > 1e-15 * size) || model.gyroscopic.absent()) return;
  }
}

}  // namespace

void step_mass(const Config& config, const mjModel* m, double* diagonal) {
  const Model& model = config.model;
  const double h = damped_step(m);
  for (int i = 0; i < model.nq(); ++i) diagonal[i] = model.mass[i] + h * model.damping[i];
}

void place_further_contacts(const Config& config, const mjModel* m, mjData* d,
                            const Coordinates& state) {
  for (const ContactPair& pair : config.pairs) {
    if (!pair.further) continue;
    const Eigen::Vector2d place = rotor_point(config.model, state.q(), pair.bearing);
    mjtNum* body = d->mocap_pos + 3 * m->body_mocapid[m->geom_bodyid[pair.rotor_geom]];
    body[0] = place.x();
    body[1] = place.y();
  }
}

void add_passive_force(const Config& config, const mjModel* m, mjData* d,
                       const Coordinates& state) {
  const Model& model = config.model;
  const int n = model.nq();
  double f[kMaxCoordinates], v[kMaxCoordinates], sampled[kMaxCoordinates] = {};
  std::copy_n(state.v(), n, v);
  take_samples_in_step(model, d->time, m->opt.timestep, state.q(), v, sampled);
  const bool rk4 = m->opt.integrator == mjINT_RK4;
  if (rk4 || (model.gyroscopic.absent() && !model.coupled_mass())) {
    coupling_force(model, d->time, state.q(), v, f);
    if (!rk4) step_bristles(model, v, v, m->opt.timestep, f);
    for (int i = model.sampled_states(); i < n; ++i) f[i] += sampled[i];
    add_to_dofs(config, f, d->qfrc_passive);
    return;
  }
  // First all known forces of the step, then the dv that they must produce, then the force that
  // produces this dv in MuJoCo.
  double mass[kMaxCoordinates], dv[kMaxCoordinates];
  step_mass(config, m, mass);
  load_force(model, d->time, state.q(), v, f);
  step_bristles(model, v, v, m->opt.timestep, f);
  for (int i = model.sampled_states(); i < n; ++i) f[i] += sampled[i];
  for (int i = 0; i < n; ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    f[i] += d->qfrc_passive[dof] + d->qfrc_applied[dof];
  }
  midpoint_velocity_change(config, m, d, state, mass, f, dv);
  const double h = m->opt.timestep;
  for (int i = 0; i < n; ++i) {
    const int dof = config.dof_address[static_cast<std::size_t>(i)];
    d->qfrc_passive[dof] = mass[i] * dv[i] / h - d->qfrc_applied[dof];
  }
}

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
      case mjEQ_CONNECT:
      case mjEQ_WELD:
        return has_body(equality_body(m_, equality, a)) || has_body(equality_body(m_, equality, b));
      default:  // a flex, whose bodies are its own
        return false;
    }
  }
  // True if the filter by contype and conaffinity allows a contact. MuJoCo's other filters
  // (parents, excludes) are not applied here.
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

bool is_contact(const Config& config, int pair) {
  return std::any_of(config.pairs.begin(), config.pairs.end(),
                     [pair](const ContactPair& p) { return p.pair == pair; });
}

// The first added constraint, as `<joint name="x_1" limited>`, whether it is active or not; empty
// if there is none.
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
    if (!collides_pairs(m) || is_contact(config, i)) continue;
    if (chain.has_geom(a) || chain.has_geom(b)) return element(m, "pair", mjOBJ_GEOM, a, "");
  }
  return {};
}

// True if MuJoCo includes the derivative of the actuator's force in an implicit step.
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
  if (!config.has_contact() || config.segments || scene::is_cone(config.contact_model()))
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
  if (scene::is_cone(config.contact_model())) return;
  config.damping_added = damping_is_added(m, config);
  const std::string constraint = added_constraint(m, config);
  if (constraint.empty() && !config.damping_added) return;
  const std::string added = constraint.empty() ? "what MuJoCo steps implicitly" : constraint;
  if (config.pairs.size() > 1) {
    refuse(added,
           "acts on a modal chain with several contacts, which is not supported; keep one contact, "
           "or use a scene with mujoco.rotor = \"segments\"");
  }
  config.pairs.front().on_chain = false;
  config.verlet_data = -1;
  if (!config.model.coupled_mass()) return;
  const std::string text = "rotorub: " + added +
                           " acts on a generated rotor with unbalance and a drive: the contact is "
                           "solved beside it without their coupling of spin and bending";
  warn(text.c_str());
}

}  // namespace rotorub::plugin
