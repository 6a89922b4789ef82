// The command from the controller to the actuator, continuous or sampled, and the force of the
// actuator on the ring.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "native_model/model/model.h"

namespace rotorub {

// The command of a continuous controller at (t, q, v). For an ideal actuator it is the force on the
// ring, N, fixed frame, limited on each axis. For magnets it is the currents of the two axes, A,
// within their limit: those that the law requests, or those whose forces come nearest to the
// requested force at the ring's position (feedback linearisation). The command is 0 before the
// controller is on and for passive bearings. Recorded commands (CommandRecord) are returned
// unchanged. `bearing`: index of the auxiliary bearing, here and below.
Eigen::Vector2d control_command(const Model& model, double t, const double* q, const double* v,
                                std::size_t bearing = 0);

// The command of a sampled controller; call it once per sample, in order. memory: memory of
// AuxiliaryBearing::loop. current: present currents of the magnets' axes, A. Throws
// ControllerError.
Eigen::Vector2d control_sample(const Model& model, double t, const double* q, const double* v,
                               const Eigen::Vector2d& current, double* memory,
                               std::size_t bearing = 0);

// Force and currents of the actuator at (q, v) under `command`.
struct ActuatorState {
  Eigen::Vector2d force{0.0, 0.0};    // N, on the ring, fixed frame
  Eigen::Vector2d current{0.0, 0.0};  // A, of each axis; 0 for an ideal actuator
  // Outputs of a sampled law at its last sample (Controller::outputs). actuator_state() leaves them
  // 0; callers that know them fill them in.
  std::array<double, kMostOutputs> outputs{};
};
ActuatorState actuator_state(const Model& model, const double* q, const double* v,
                             const Eigen::Vector2d& command, std::size_t bearing = 0);

// The outputs of a continuous law (Controller::outputs) at (t, q, v); 0 before it is on.
void control_outputs(const Model& model, double t, const double* q, const double* v, double* values,
                     std::size_t bearing = 0);

// f(t, q, v, commands), nq values: all loads except those of the contacts. commands: one per
// auxiliary bearing; missing ones are 0. Does not allocate.
void smooth_force(const Model& model, double t, const double* q, const double* v,
                  std::span<const Eigen::Vector2d> commands, double* f);
inline void smooth_force(const Model& model, double t, const double* q, const double* v,
                         const Eigen::Vector2d& first_command, double* f) {
  smooth_force(model, t, q, v, std::span(&first_command, 1), f);
}

// f += the part of smooth_force() from the actuators.
void add_actuators(const Model& model, const double* q, const double* v,
                   std::span<const Eigen::Vector2d> commands, double* f);

// N, the force with its component along each axis of the actuator limited.
Eigen::Vector2d limited(const Eigen::Vector2d& force, double limit);

// The command of a sampled controller (AuxiliaryBearing::loop) with its memory, for fixed-step
// integrators and the event integrator. The plugin keeps the same memory in mjData.userdata.
class SampledCommand {
 public:
  // The model must outlive it. Without a sampled law the memory is empty.
  explicit SampledCommand(const Model& model, std::size_t bearing = 0);

  // Restores the state before the first sample.
  void clear();
  // The actuator's command at the sample at t (s); call it once per sample, in order. held: the
  // last command, returned again if the law fails. shown: currents that the sensors show, A; null:
  // the currents of the state.
  Eigen::Vector2d take(double t, const double* q, const double* v, const Eigen::Vector2d& held,
                       const Eigen::Vector2d* shown = nullptr);

  // The law's outputs at the last sample (ActuatorState::outputs).
  std::array<double, kMostOutputs> outputs() const;
  // The first failure of the law; empty if there was none.
  const std::string& failure() const { return failure_; }

  // The memory as an array of doubles. restore() clears the failure.
  static std::size_t memory_size(const Model& model, std::size_t bearing = 0);
  void save(double* to) const;
  void restore(const double* from);

 private:
  const Model* model_;
  std::size_t bearing_;
  std::vector<double> memory_;
  std::string failure_;
};

}  // namespace rotorub
