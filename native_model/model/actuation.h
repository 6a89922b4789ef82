// What the controller tells the actuator, continuously or once a sample, and what the actuator then
// does to the ring.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "native_model/model/model.h"

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

// The command of a controller that is asked once a sample (Model::loop), with all that it
// remembers: of the fixed steps' hold and of the event integrator. The plugin keeps the same memory
// in mjData.userdata.
class SampledCommand {
 public:
  // The model must outlive it. One without a sampled law has nothing to remember.
  explicit SampledCommand(const Model& model, std::size_t bearing = 0);

  // As before the first sample.
  void clear();
  // The actuator's command at the sample at t (s); once a sample, in order.
  // held: its last command, which stands where the law fails. shown: the currents that the sensors
  // see, A; null: those of the state.
  Eigen::Vector2d take(double t, const double* q, const double* v, const Eigen::Vector2d& held,
                       const Eigen::Vector2d* shown = nullptr);

  // Of the law, at the last sample (ActuatorState::outputs).
  std::array<double, kMostOutputs> outputs() const;
  // Why the law failed first; empty: it did not.
  const std::string& failure() const { return failure_; }

  // The memory as plain numbers. A restored one has not failed.
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
