// The common interface of all engines that can run a scene. Code that compares and reports runs
// does not depend on a particular engine.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "native_model/control/command_record.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

struct EventParameters;

// A contact in a step of a MuJoCo run.
struct WatchedContact {
  double normal_impulse = 0.0;  // N s, over the step, >= 0
  bool impact = false;          // the impulse comes from an impact of a rigid law
  double impact_time = 0.0;     // s; set for an impact, as is gap_rate_after
  double gap_rate_after = 0.0;  // m/s
};

// A watch receives this for every step k of a MuJoCo run, from t = k h to t + h. MuJoCo's Euler
// step is a leapfrog: its velocities lag its positions by half a step, and a force of the step acts
// around t, from t - h/2 to t + h/2 (native_model/stepping/verlet.h).
struct WatchedStep {
  double t = 0.0, h = 0.0;  // s
  // State at t: nq values of the plugin's model, without coils. The velocities at t are the mean of
  // the two adjacent half-step velocities: second-order accurate unless an impact lies between
  // them.
  const double* q = nullptr;
  const double* v = nullptr;
  Eigen::Vector2d current{0.0, 0.0};  // A, in the coils at t
  // The actuator's command (model/actuation.h) and the time from which it acts, s.
  Eigen::Vector2d command{0.0, 0.0};
  double command_begin = 0.0;
  std::span<const WatchedContact> contacts;  // one for each auxiliary bearing
};
using StepWatch = std::function<void(const WatchedStep&)>;

// How a run differs from the scene.
struct RunRequest {
  std::optional<double> step;                       // s, > 0
  std::optional<std::vector<double>> output_times;  // s, ascending: the times of the recorded rows
  // Moves the first bending coordinate at t = 0 by this many units in the last place of the
  // smallest clearance (of 1 mm without a contact), the smallest possible difference between two
  // runs.
  int perturbation_ulps = 0;
  std::function<void(double)> progress;          // fraction done, in [0, 1]
  const std::atomic<bool>* interrupt = nullptr;  // true: stop and return the result so far
  // Commands recorded in another run, in place of the scene's controller; native engines only.
  std::shared_ptr<const CommandRecord> commands;
  StepWatch watch;  // called after every step; MuJoCo engines only
  // MuJoCo engines write the solref of the first contact here, as in the MJCF attribute ("0.02 1"),
  // if it determines the contact force. It does not for a rigid or a compliant contact.
  std::string* solref = nullptr;
};

class Engine {
 public:
  virtual ~Engine() = default;
  // Used in columns and folder names: "native-verlet", "mujoco-coulomb".
  virtual std::string name() const = 0;
  // Numerical failures are a status of the result; scenes that the engine cannot run at all throw
  // std::runtime_error.
  virtual Trajectory run(const scene::Scene& scene, const RunRequest& request) const = 0;
};

// Sets the status kDiverged if a result is not finite, whatever the integrator reports.
Trajectory finite(Trajectory trajectory);

std::unique_ptr<Engine> native_engine(scene::Integrator integrator);
// `event` with these parameters, over whose bins forces are averaged, whatever RunRequest::step is.
std::unique_ptr<Engine> event_engine(const EventParameters& parameters);
std::unique_ptr<Engine> mujoco_engine(scene::ContactModel contact);
// MuJoCo's default solref: a time constant and a damping ratio.
struct DefaultSolref {
  static constexpr double kTimeConstant = 0.02;  // s
  static constexpr double kDampingRatio = 1.0;
  // The equivalent K and B of a direct solref.
  static constexpr double kDamping = 2.0 / kTimeConstant;  // 1/s
  static constexpr double kStiffness =
      1.0 / (kTimeConstant * kTimeConstant * kDampingRatio * kDampingRatio);  // 1/s^2
};
// "0.02 1"
std::string solref_text(double first, double second);

// MuJoCo's cone with its default solref, whatever the scene sets.
std::unique_ptr<Engine> default_cone_engine();

const char* to_string(scene::Integrator integrator);
// Empty if no integrator has that name.
std::optional<scene::Integrator> integrator_named(std::string_view name);

// The scene with a perturbed initial state (see RunRequest::perturbation_ulps).
scene::Scene perturbed(const scene::Scene& scene, int ulps);

}  // namespace rotorub
