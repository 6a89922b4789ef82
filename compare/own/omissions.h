// How much of a user's own machine its native twin leaves out, measured along a run in MuJoCo.
//
// The twin (plugin/twin/native_twin.h) carries MuJoCo's smooth forces and masses as they are for
// small motions about qpos0: springs and dampers of joints and tendons, actuators, gravity and its
// compensation, fluid, gyroscopic forces, unbalance, and the drive's torque over the speed. An
// equality that acts on the rotor or ring, joints that do not split into two planes, and anything
// else that turns a ring are refused by name. The rest is measured in every step from MuJoCo's
// state (q, v):
//
//   equalities elsewhere, limits and      a = C M(q)^-1 J^T f of the rows of each element
//   friction loss of joints and tendons,
//   contacts of other geoms
//   smooth forces that are not linear     a = C M(q)^-1 (passive + actuator - bias) - a_t(q, v),
//   or change with the activations        a_t: the twin's own acceleration
//   the rotor's place in its ring         |d - d_t| / clearance
//   the mass that the contact moves       |A - A_t| / |A_t|, A = J M^-1 J^T
//   friction along the ring's axis        (|T| - |T_round|) / N
//
// C maps MuJoCo's rates to the twin's. An acceleration a is expressed as the contact force that
// would accelerate a part of the twin as much, with the mode values s_i at the contact and the
// modal masses m_i:
//
//   F = sum |s_i a_i| / sum s_i^2 / m_i    for rotor and ring, N;    F = J |a| / r    for turning.
#pragma once

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"

namespace rotorub {

struct Omission {
  std::string what;   // the sentence up to the size: "the twin leaves out ..., whose force reaches"
  double peak = 0.0;  // maximum over the run: N, or a share
  std::optional<std::string> share_of{};  // " of the clearance", or ""; empty if peak is a force

  // The peak if it is a share, otherwise relative to the mean contact force (N, > 0).
  double share(double contact_force) const { return share_of ? peak : peak / contact_force; }
  // "the twin leaves out ..., whose force reaches 12 N, 8 % of the mean contact force"
  std::string sentence(double contact_force) const;
};

// The setup must belong to a twin. The run ends at `end` (s) or at an interrupt. The result is not
// sorted.
std::vector<Omission> measure_omissions(const MujocoSetup& setup, double end,
                                        const std::atomic<bool>* interrupt = nullptr);

}  // namespace rotorub
