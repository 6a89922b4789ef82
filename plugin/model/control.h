// The controller's command, computed by the law of the native model and written to ctrl.
#pragma once

#include <mujoco/mujoco.h>

#include <string>

#include "native_model/model/actuation.h"
#include "plugin/model/actuators.h"
#include "plugin/model/config.h"
#include "plugin/model/generated_rotor.h"

namespace rotorub::plugin {

// Writes the command to ctrl. A sampled controller's command is held between the samples k T. Does
// nothing to the user's ctrl if the scene has no active controller.
void write_command(const Config& config, const mjModel* m, mjData* d);

// Reports that the law failed: mju_error with the law's message, which contains the time, and the
// status in mjData (ContactEntries::status).
void controller_failed(mjData* d, const std::string& why);

// While one of these objects exists in this thread, controller_failed() reports nothing: MuJoCo's
// compiler makes a forward pass, and would refuse the model. A run meets the same failure in its
// first step and ends with a status.
class WhileCompiling {
 public:
  WhileCompiling();
  ~WhileCompiling();
  WhileCompiling(const WhileCompiling&) = delete;
  WhileCompiling& operator=(const WhileCompiling&) = delete;

 private:
  bool outer_;
};

// Force of the actuators on the ring in the last forward pass, and their present currents.
ActuatorState actuator_state(const Config& config, const mjModel* m, const mjData* d);

// The command of the actuators in the last forward pass, as in control_command: the force on the
// ring, N, fixed frame, or with magnets the currents of the two axes, A. Without lag it is the
// command that acted; with native steps it is the mean command about the instant of the pass.
Eigen::Vector2d command_of_pass(const Config& config, const mjModel* m, const mjData* d);

// The magnetic actuator consists of two MuJoCo actuators with user gain and bias on the ring's
// axes. ctrl is the requested current, A. With a coil lag the activation is the coil's current;
// otherwise ctrl is. The force is
//
//   gain i + bias,   bias = F(s, 0),   gain = (F(s, i) - F(s, 0)) / i,
//
// where F is the law of the native model and s the actuator's length. is_magnet: true for an
// actuator of the plugin with the force F(s, i).
bool is_magnet(const Config& config, int actuator);

// Current of the coil, A.
double coil_current(const mjModel* m, const mjData* d, int actuator);

// The value that MuJoCo asks for: the gain, N/A, the bias, N, or the rate of a lagging coil's
// activation, A/s.
double magnet_answer(ActuatorQuestion asked, const Config& config, const mjModel* m,
                     const mjData* d, int actuator);

}  // namespace rotorub::plugin
