// Runs MuJoCo in chunks of steps, so that only mj_step and the copying of its results are timed.
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

// The result of one step: the state at its end and the forces that acted during it.
struct StepResult {
  std::vector<plugin::ContactForces> forces;  // one per contact
  ActuatorState actuator;
  Eigen::Vector2d command{0.0, 0.0};  // see plugin/model/control.h; set only if requested
  plugin::StepWorks works{};          // with native steps only
};

class ChunkedRun {
 public:
  // The setup must outlive this. commands: whether the results need the actuator's command.
  ChunkedRun(const MujocoSetup& setup, bool commands);

  static constexpr std::size_t kChunk = 256;

  // Takes up to `wanted` steps, at most kChunk. Returns the number of successful ones.
  std::size_t advance(std::size_t wanted);
  // With native steps: the forces and the state at the current time, for the half step that
  // completes the run.
  StepResult last_half();

  // The i-th step since the last call of advance. With native steps the state is the one at the
  // step's begin, with the velocities at that instant; otherwise it is MuJoCo's state at the step's
  // end.
  const StepResult& result(std::size_t i) const { return results_[i]; }
  const double* q(std::size_t i) const { return states_.data() + 2 * i * size(); }
  const double* v(std::size_t i) const { return q(i) + size(); }
  const double* start_q() const { return start_.data(); }
  const double* start_v() const { return start_.data() + size(); }
  bool failed() const { return failed_; }
  // MuJoCo's message if it gave up, or the controller's; otherwise empty.
  const std::string& error() const { return error_; }
  // kNoSolution or kAmbiguous if the `rigid` contact failed, kControllerFailed, or kOk.
  Status contact_status() const { return contact_status_; }
  double wall() const { return wall_.count(); }  // s

 private:
  std::size_t size() const { return static_cast<std::size_t>(model_.nq()); }
  void read_state(double* to) const { read_(data_.get(), to, to + size()); }
  void read_forces(std::vector<plugin::ContactForces>& forces) const;
  bool step();               // false: see error_
  plugin::StepWorks works_;  // of the last step
  bool bad() const;

  const mjModel* m_;
  const plugin::Config& config_;
  const Model& model_;
  const ReadState& read_;
  const std::function<Eigen::Vector2d(mjData*)>& control_;
  Eigen::Vector2d commanded_{0.0, 0.0};  // the last force returned by control_, N
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
