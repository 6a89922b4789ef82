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

// Adds MuJoCo's constraints that a linear model does not have.
void add_constraints(const mjModel* m, const TwinPlanes& planes, std::vector<std::string>& all) {
  for (int i = 0; i < m->nv; ++i) {
    const std::vector<int>& ignored = planes.ignored;
    if (std::find(ignored.begin(), ignored.end(), i) != ignored.end()) continue;
    const int joint = m->dof_jntid[i];
    if (m->jnt_limited[joint]) {
      all.push_back(joint_element(m, joint) + " is limited; the twin's is not");
    }
    if (m->dof_frictionloss[i] > 0.0) {
      all.push_back(joint_element(m, joint) + " loses " + text(m->dof_frictionloss[i]) +
                    " N or N m to friction; the twin's does not");
    }
  }
  for (int i = 0; i < m->neq; ++i) {
    if (!equality_holds(m, i)) continue;
    all.push_back(message("<equality>: \"{}\" acts only in MuJoCo", m->names + m->name_eqadr[i]));
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
                  percent(machine.bent_contact) + " of the clearance; the twin keeps them");
  }
  if (machine.uneven_inertia > kSaid) {
    all.push_back("the rotor is no body of revolution: its masses change by " +
                  percent(machine.uneven_inertia) + " as it turns; the twin has their mean");
  }
  if (machine.unbalance_torque > kNoTorque) {
    all.push_back("the weight of the unbalance turns the rotor by up to " +
                  text(machine.unbalance_torque) + " N m; the twin leaves that out");
  }
  add_constraints(m, planes, all);
  for (const int dof : planes.ignored) {
    all.push_back(joint_element(m, m->dof_jntid[dof]) +
                  " moves nothing in the contact's plane; left out");
  }
  return all;
}

}  // namespace rotorub::plugin
