// One interface of everything that can run a scene: what compares and reports knows no engine.
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "native_model/control/command_record.h"
#include "native_model/scene/scene.h"
#include "native_model/trajectory/trajectory.h"

namespace rotorub {

// What an onlooker sees of every step of a MuJoCo run: step k, from t = k h to t + h. MuJoCo's
// Euler step is leapfrog: its velocities are those of half a step before its positions, and a force
// of the step acts about t, from t - h/2 to t + h/2 (native_model/stepping/verlet.h).
struct WatchedStep {
  double t = 0.0, h = 0.0;  // s
  // The state of t: nq values of the plugin's model (without coils). Velocities are those of t, the
  // mean of those of the half steps beside it: of second order where no impact is between them.
  const double* q = nullptr;
  const double* v = nullptr;
  Eigen::Vector2d current{0.0, 0.0};  // A, of the coils at t
  // The actuator's command (model/actuation.h), and from when it acts, s.
  Eigen::Vector2d command{0.0, 0.0};
  double command_begin = 0.0;
  double normal_impulse = 0.0;  // N s, of the step, >= 0
  bool impact = false;          // that is an impact's, of a rigid law, with
  double impact_time = 0.0;     // s
  double gap_rate_after = 0.0;  // m/s
};
using StepWatch = std::function<void(const WatchedStep&)>;

// How a run differs from what the scene says.
struct RunRequest {
  std::optional<double> step;                       // s, > 0
  std::optional<std::vector<double>> output_times;  // s, ascending: the rows of the series
  // Moves the first bending coordinate at t = 0 by so many units in the last place of the clearance
  // (of 1 mm without a contact): the least that two runs can differ by.
  int perturbation_ulps = 0;
  std::function<void(double)> progress;          // share done, in [0, 1]
  const std::atomic<bool>* interrupt = nullptr;  // true: stop and keep what there is
  // Commands of another run in the place of the scene's controller; native engines alone.
  std::shared_ptr<const CommandRecord> commands;
  StepWatch watch;  // called after every step; MuJoCo's engines alone
  // MuJoCo's engines write the solref of the first contact here, as the attribute has it ("0.02
  // 1"), if its force comes from one: that of a rigid or a compliant contact does not.
  std::string* solref = nullptr;
};

class Engine {
 public:
  virtual ~Engine() = default;
  // For columns and folders: "native-verlet", "mujoco-coulomb".
  virtual std::string name() const = 0;
  // Failing numerics are a status of the result; scenes that the engine cannot run at all throw
  // std::runtime_error.
  virtual Trajectory run(const scene::Scene& scene, const RunRequest& request) const = 0;
};

// What was asked for is no part of this version; the message names what is.
class NotOffered : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

// What is not finite is no result: diverged, whatever the integrator thinks of its own state.
Trajectory finite(Trajectory trajectory);

std::unique_ptr<Engine> native_engine(scene::Integrator integrator);
// Throws NotOffered.
std::unique_ptr<Engine> mujoco_engine(scene::ContactModel contact);
// MuJoCo's default solref, whose two numbers are a time constant and a damping ratio.
struct DefaultSolref {
  static constexpr double kTimeConstant = 0.02;  // s
  static constexpr double kDampingRatio = 1.0;
  // The same as K and B of a direct solref.
  static constexpr double kDamping = 2.0 / kTimeConstant;  // 1/s
  static constexpr double kStiffness =
      1.0 / (kTimeConstant * kTimeConstant * kDampingRatio * kDampingRatio);  // 1/s^2
};
// "0.02 1"
std::string solref_text(double first, double second);

// The label of MuJoCo's cone with its default solref, whatever the scene says.
inline constexpr const char* kConeDefault = "cone-default";
std::unique_ptr<Engine> default_cone_engine();

const char* to_string(scene::Integrator integrator);
// Nothing where there is none of that name.
std::optional<scene::Integrator> integrator_named(std::string_view name);

// The scene with its initial state moved (see RunRequest::perturbation_ulps).
scene::Scene perturbed(const scene::Scene& scene, int ulps);

}  // namespace rotorub
