// The controller's command, from the law that the native model uses, written to ctrl.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "native_model/model/actuation.h"
#include "plugin/model/actuators.h"
#include "plugin/model/config.h"
#include "plugin/model/generated_rotor.h"

namespace rotorub::plugin {

// Held between the samples k T of a sampled controller. Leaves the user's ctrl alone where the
// scene has no active controller.
void write_command(const Config& config, const mjModel* m, mjData* d, const Coordinates& state);

// The law failed: mju_error with its word, which names the time; the data tell it too
// (ContactEntries::status).
void controller_failed(mjData* d, const std::string& why);

// While one lives in this thread such a failure is not told: MuJoCo's compiler, which takes a pass
// of its own, would refuse the model; a run finds it again in its first step and has a status.
class WhileCompiling {
 public:
  WhileCompiling();
  ~WhileCompiling();
  WhileCompiling(const WhileCompiling&) = delete;
  WhileCompiling& operator=(const WhileCompiling&) = delete;

 private:
  bool outer_;
};

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
// F the law that the native model uses, s the actuator's length. True for an actuator of ours whose
// force is F(s, i).
bool is_magnet(const Config& config, int actuator);

// Current of the coil, A.
double coil_current(const mjModel* m, const mjData* d, int actuator);

// What MuJoCo asks of it: the gain, N/A, the bias, N, or the rate of a lagging coil's activation,
// A/s.
double magnet_answer(ActuatorQuestion asked, const Config& config, const mjModel* m,
                     const mjData* d, int actuator);

}  // namespace rotorub::plugin
