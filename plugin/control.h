// The controller's command, from the law that the native model uses, written to ctrl.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "native_model/system/actuation.h"
#include "plugin/config.h"
#include "plugin/generated_rotor.h"

namespace rotorub::plugin {

// Held between the samples k T of a sampled controller. Leaves the user's ctrl alone where the
// scene has no active controller.
void write_command(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// The law failed: mju_error with its word, which names the time; the data tell it too
// (kContactStatus).
void controller_failed(mjData* d, const std::string& why);

// Force of the actuators on the ring, of the forward pass done last, and the currents now.
ActuatorState actuator_state(const Config& config, const mjModel* m, const mjData* d);

// What the actuators were commanded in the forward pass done last, as control_command has it: the
// force on the ring, N, fixed frame, or with magnets the currents of the two axes, A. Without lag
// it is what acted: with native steps the mean about the pass's instant.
Eigen::Vector2d command_of_pass(const Config& config, const mjModel* m, const mjData* d);

// The magnetic actuator in MuJoCo: two actuators of user gain and bias on the ring's axes. ctrl is
// the current asked for, A; with a coil lag the activation is the coil's current, else ctrl is. The
// force is
//
//   gain i + bias,   bias = F(s, 0),   gain = (F(s, i) - F(s, 0)) / i,
//
// F the law that the native model uses, s the actuator's length.

// True for an actuator of ours whose force is F(s, i).
bool is_magnet(const Config& config, int actuator);

// Current asked for, within MuJoCo's limits, A.
double asked_current(const mjModel* m, const mjData* d, int actuator);

// Current of the coil, A.
double coil_current(const mjModel* m, const mjData* d, int actuator);

double magnet_gain(const Config& config, const mjModel* m, const mjData* d, int actuator);  // N/A
double magnet_bias(const Config& config, const mjModel* m, const mjData* d, int actuator);  // N
// d(activation)/dt of a lagging coil, A/s.
double coil_rate(const Config& config, const mjModel* m, const mjData* d, int actuator);

// Velocities at the time of the positions. MuJoCo's Euler step is semi-implicit,
//   v_k = v_{k-1} + h a,   q_k = q_{k-1} + h v_k,
// so its v_k is the velocity of half a step before t_k. A controller that weighs the gap rate
// against a boundary layer sees the difference: in a whirl it is h/2 v_t^2 / delta. It is given
//   v(t_k) = v_k + (v_k - v_{k-1}) / 2.

// Notes the state's velocities for its time and writes v(t) (nq values) to `now`. Repeated calls at
// one time give the same; without a step of the model's length before it, and for RK4, whose
// velocities are not late, v(t) is the state's.
void velocity_at_time(const Config& config, const mjModel* m, mjData* d, const Coordinates& state,
                      double* now);

}  // namespace rotorub::plugin
