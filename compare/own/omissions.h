// How much of a user's own machine its native twin leaves out, measured along a run in MuJoCo.
//
// The twin (plugin/twin/native_twin.h) carries MuJoCo's smooth forces and masses as they are for
// small motions about qpos0: springs and dampers of joints and tendons, actuators, gravity and its
// compensation, fluid, gyroscopics, unbalance, and the drive's torque over the speed. Refused by
// name are an equality that acts on rotor or ring, joints that do not part into two planes, and
// whatever else turns a ring. The rest is measured in every step, from MuJoCo's state (q, v):
//
//   equalities elsewhere, limits and      a = C M(q)^-1 J^T f of the rows of each element
//   friction loss of joints and tendons,
//   contacts of other geoms
//   smooth forces that are not linear     a = C M(q)^-1 (passive + actuator - bias) - a_t(q, v),
//   or change with the activations        a_t: the twin's own acceleration
//   the rotor's place in its ring         |d - d_t| / clearance
//   the mass that the contact feels       |A - A_t| / |A_t|, A = J M^-1 J^T
//   friction along the ring's axis        (|T| - |T_round|) / N
//
// C takes MuJoCo's rates to the twin's. An acceleration a counts as the force at the contact that
// would move a part of the twin as much, with the mode values s_i there and the modal masses m_i,
//
//   F = sum |s_i a_i| / sum s_i^2 / m_i    of rotor and ring, N;    F = J |a| / r    of turning.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"

namespace rotorub {

struct Omission {
  std::string what;   // up to the size: "the twin leaves out ..., whose force reaches"
  double peak = 0.0;  // over the run: N, or a share
  std::optional<std::string> share_of{};  // " of the clearance", or empty; none: a force

  // That share, or the one of a mean contact force (N, > 0).
  double share(double contact_force) const { return share_of ? peak : peak / contact_force; }
  // "the twin leaves out ..., whose force reaches 12 N, 8 % of the mean contact force"
  std::string sentence(double contact_force) const;
};

// The setup is that of a twin; its run ends at `end` (s) or with an interrupt. In no order.
std::vector<Omission> measure_omissions(const MujocoSetup& setup, double end,
                                        const std::atomic<bool>* interrupt = nullptr);

}  // namespace rotorub
