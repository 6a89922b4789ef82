#include "plugin/twin/twin_limits.h"

#include <algorithm>

#include "plugin/model/message.h"
#include "plugin/model/mujoco_dynamics.h"

namespace rotorub::plugin {
namespace {

constexpr double kSaid = 1e-4;      // relative size above which an effect is reported
constexpr double kNoTorque = 1e-9;  // N m, round-off

std::string percent(double share) {
  char digits[32];
  std::snprintf(digits, sizeof digits, "%.2g %%", 100.0 * share);
  return digits;
}

// The friction loss of a joint: in N for a slide, in N m for a hinge or ball, and in either for a
// free joint.
const char* loss_unit(int joint_type) {
  switch (joint_type) {
    case mjJNT_SLIDE:
      return "N";
    case mjJNT_FREE:
      return "N or N m";
    default:
      return "N m";
  }
}

// The largest friction loss of a joint's degrees of freedom.
double friction_loss(const mjModel* m, int joint) {
  double largest = 0.0;
  for (int i = 0; i < m->nv; ++i) {
    if (m->dof_jntid[i] == joint) largest = std::max(largest, m->dof_frictionloss[i]);
  }
  return largest;
}

// Adds MuJoCo's constraints that a linear model does not have. ignored: per joint.
void add_constraints(const mjModel* m, const std::vector<bool>& ignored,
                     std::vector<std::string>& all) {
  for (int joint = 0; joint < m->njnt; ++joint) {
    if (ignored[static_cast<std::size_t>(joint)]) continue;
    if (m->jnt_limited[joint]) {
      all.push_back(joint_element(m, joint) + " is limited; the native model's is not");
    }
    if (const double loss = friction_loss(m, joint); loss > 0.0) {
      all.push_back(joint_element(m, joint) + " loses " + text(loss) + " " +
                    loss_unit(m->jnt_type[joint]) + " to friction; the native model's does not");
    }
  }
  for (int i = 0; i < m->neq; ++i) {
    if (!equality_holds(m, i)) continue;
    const char* name = m->names + m->name_eqadr[i];
    all.push_back(
        (*name ? message("<equality> \"{}\"", name) : message("<equality> number {}", i + 1)) +
        " acts only in MuJoCo");
  }
}

}  // namespace

std::vector<std::string> twin_limits(const mjModel* m, const LinearMachine& machine,
                                     const TwinPlanes& planes) {
  std::vector<std::string> all;
  const double bent = std::max({machine.bent_mass, machine.bent_stiffness, machine.bent_contact});
  if (bent > kSaid) {
    all.push_back("deflections are not small: at one clearance the masses change by " +
                  percent(machine.bent_mass) + ", the springs' forces by " +
                  percent(machine.bent_stiffness) + ", the gap by " +
                  percent(machine.bent_contact) + " of the clearance; the native model keeps them");
  }
  if (machine.uneven_inertia > kSaid) {
    all.push_back("the rotor is no body of revolution: its masses change by " +
                  percent(machine.uneven_inertia) +
                  " as it turns; the native model has their mean");
  }
  if (machine.unbalance_torque > kNoTorque) {
    all.push_back("the weight of the unbalance turns the rotor by up to " +
                  text(machine.unbalance_torque) + " N m; the native model leaves that out");
  }
  std::vector<bool> ignored(static_cast<std::size_t>(m->njnt));
  for (const int dof : planes.ignored) ignored[static_cast<std::size_t>(m->dof_jntid[dof])] = true;
  add_constraints(m, ignored, all);
  for (int joint = 0; joint < m->njnt; ++joint) {
    if (!ignored[static_cast<std::size_t>(joint)]) continue;
    all.push_back(joint_element(m, joint) +
                  " does not move rotor or ring in the contact's plane, so it is left out");
  }
  return all;
}

}  // namespace rotorub::plugin
