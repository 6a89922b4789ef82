// The command of a controller that is asked once a sample (Model::loop), with all that it
// remembers: of the fixed steps' hold and of the event integrator. The plugin keeps the same memory
// in mjData.userdata.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "native_model/system/model.h"

namespace rotorub {

class SampledCommand {
 public:
  // The model must outlive it. One without a sampled law has nothing to remember.
  explicit SampledCommand(const Model& model, std::size_t bearing = 0);

  // As before the first sample.
  void clear();
  // The actuator's command (system/actuation.h) at the sample at t (s); once a sample, in order.
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
