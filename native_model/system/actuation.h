// What the controller tells the actuator, and what the actuator then does to the ring.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>

#include "native_model/system/model.h"

namespace rotorub {

// The command of a continuous controller at (t, q, v): the force on the ring, N, fixed frame,
// limited on each axis; with magnets the currents of the two axes, A, whose forces come nearest to
// that force at the ring's place (feedback linearisation). 0 before the controller is on and for
// passive bearings. Recorded commands (CommandRecord) are given as they are. `bearing`: the number
// of the auxiliary bearing, here and below.
Eigen::Vector2d control_command(const Model& model, double t, const double* q, const double* v,
                                std::size_t bearing = 0);

// The same of a sampled one, once a sample, in order. memory: Model::loop's; current: of the
// magnets' axes now, A. Throws ControllerError.
Eigen::Vector2d control_sample(const Model& model, double t, const double* q, const double* v,
                               const Eigen::Vector2d& current, double* memory,
                               std::size_t bearing = 0);

// What the actuator does at (q, v) under `command`.
struct ActuatorState {
  Eigen::Vector2d force{0.0, 0.0};    // N, on the ring, fixed frame
  Eigen::Vector2d current{0.0, 0.0};  // A, of each axis; 0 for an ideal actuator
  // Of a sampled law, at its last sample (Controller::outputs); who has them fills them in.
  std::array<double, kMostOutputs> outputs{};
};
ActuatorState actuator_state(const Model& model, const double* q, const double* v,
                             const Eigen::Vector2d& command, std::size_t bearing = 0);

// The outputs of a continuous law (Controller::outputs) at (t, q, v); 0 before it is on.
void control_outputs(const Model& model, double t, const double* q, const double* v, double* values,
                     std::size_t bearing = 0);

// f(t, q, v, commands), nq values: all loads but the contacts'. commands: of each auxiliary
// bearing; of those that are not there 0. No allocation.
void smooth_force(const Model& model, double t, const double* q, const double* v,
                  std::span<const Eigen::Vector2d> commands, double* f);
inline void smooth_force(const Model& model, double t, const double* q, const double* v,
                         const Eigen::Vector2d& first_command, double* f) {
  smooth_force(model, t, q, v, std::span(&first_command, 1), f);
}

// f += the actuators' part of it.
void add_actuators(const Model& model, const double* q, const double* v,
                   std::span<const Eigen::Vector2d> commands, double* f);

// The load on a coil's coordinate beyond -i: the current asked for, brought so near to the present
// one that its rate, load - i over the lag, keeps within the limit and needs no more than the
// voltage. A.
double coil_load(const MagneticActuator& magnets, double asked, double current);

// A force with its part along each axis of the actuator limited. N.
Eigen::Vector2d limited(const Eigen::Vector2d& force, double limit);

}  // namespace rotorub
