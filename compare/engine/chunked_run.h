// A run of MuJoCo in chunks of steps, so that only mj_step and the copying of its results are
// timed.
#pragma once

#include <mujoco/mujoco.h>

#include <chrono>
#include <string>
#include <vector>

#include "compare/engine/mujoco_engine.h"
#include "native_model/model/actuation.h"
#include "native_model/trajectory/trajectory.h"
#include "plugin/contact/contact_memory.h"
#include "plugin/contact/verlet.h"
#include "plugin/model/config.h"

namespace rotorub {

// What a step left behind: the state at its end and the forces that acted over it.
struct StepResult {
  std::vector<plugin::ContactForces> forces;  // of each contact
  ActuatorState actuator;
  Eigen::Vector2d command{0.0, 0.0};  // plugin/model/control.h, where it was asked for
  plugin::StepWorks works{};          // of native steps
};

class ChunkedRun {
 public:
  // The setup must outlive it. `commands`: those of the results are wanted.
  ChunkedRun(const MujocoSetup& setup, bool commands);

  static constexpr std::size_t kChunk = 256;

  // Up to `wanted` steps; the number that were good.
  std::size_t advance(std::size_t wanted);
  // Native steps: the forces and the state now, as of a step of which half is taken.
  StepResult last_half();

  // Of the i-th step since the last call of advance. The state: with native steps that of its
  // begin, velocities of that instant; else MuJoCo's at its end.
  const StepResult& result(std::size_t i) const { return results_[i]; }
  const double* q(std::size_t i) const { return states_.data() + 2 * i * size(); }
  const double* v(std::size_t i) const { return q(i) + size(); }
  const double* start_q() const { return start_.data(); }
  const double* start_v() const { return start_.data() + size(); }
  bool failed() const { return failed_; }
  // What MuJoCo said when it gave up; empty: it did not.
  const std::string& error() const { return error_; }
  // kNoSolution, kAmbiguous: what `rigid` failed by; kControllerFailed.
  Status contact_status() const { return contact_status_; }
  double wall() const { return wall_.count(); }  // s

 private:
  std::size_t size() const { return static_cast<std::size_t>(model_.nq()); }
  void read_state(double* to) const { read_(data_.get(), to, to + size()); }
  void read_forces(std::vector<plugin::ContactForces>& forces) const;
  bool step();               // false: error_
  plugin::StepWorks works_;  // of the last step
  bool bad() const;

  const mjModel* m_;
  const plugin::Config& config_;
  const Model& model_;
  const ReadState& read_;
  const std::function<Eigen::Vector2d(mjData*)>& control_;
  Eigen::Vector2d commanded_{0.0, 0.0};  // by it, N
  bool commands_;
  MujocoData data_;
  std::vector<StepResult> results_;
  std::vector<double> states_, start_;
  bool failed_ = false;
  std::string error_;
  Status contact_status_ = Status::kOk;
  std::chrono::duration<double> wall_{0.0};
};

}  // namespace rotorub
