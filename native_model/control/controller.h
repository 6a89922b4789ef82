// The controller interface. The native model and the MuJoCo plugin evaluate the same law with the
// same measurements, so both sides get the same command.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "native_model/scene/forward.h"

namespace rotorub {

struct LinearPlant;  // quadratic.h

// The input of a controller at time t. Vectors are in the fixed frame, in the contact plane.
struct Measurement {
  double t = 0.0;                   // s
  std::int64_t sample = 0;          // number of the sample; 0 for a continuous law
  Eigen::Vector2d rotor{0.0, 0.0};  // m, rotor centre at the contact, from the ring's rest centre
  Eigen::Vector2d rotor_velocity{0.0, 0.0};      // m/s
  Eigen::Vector2d rotor_acceleration{0.0, 0.0};  // m/s^2, of the model without contact force
  Eigen::Vector2d stator{0.0, 0.0};              // m, ring centre, relative to its rest position
  Eigen::Vector2d stator_velocity{0.0, 0.0};     // m/s
  double spin_angle = 0.0;                       // rad
  double spin_speed = 0.0;                       // rad/s
  Eigen::Vector2d current{0.0, 0.0};             // A, on the actuator's axes; 0 without magnets
  // The true coordinates of the model and their rates, independent of the sensors.
  const double *q = nullptr, *v = nullptr;
};

// The time at which the law was switched on, and the gap at that time.
struct SwitchOn {
  double t = 0.0;         // s
  double gap = 0.0;       // m
  double gap_rate = 0.0;  // m/s
};

// The controller's knowledge of the plant, which may be wrong.
struct Plant {
  double clearance = 0.0;                      // m
  Eigen::Vector2d stator_mass{1.0, 1.0};       // kg
  Eigen::Vector2d stator_damping{0.0, 0.0};    // N s/m
  Eigen::Vector2d stator_stiffness{0.0, 0.0};  // N/m
  // 1/kg, >= 0, of the rotor at the contact: its acceleration per unit of force there. It uses the
  // same modes as Measurement::rotor_acceleration, which leaves out the contact force.
  Eigen::Vector2d rotor_mobility{0.0, 0.0};
  double force_limit = std::numeric_limits<double>::infinity();  // N, on each axis
  double current_limit = 0.0;                                    // A, of magnets; 0: no magnets
  double coil_lag = 0.0;                                         // s, of magnets
  std::shared_ptr<const LinearPlant> linear = nullptr;           // for laws designed on it
};

// A law failed or returned a command that is not finite. The run ends. The message names the law
// and the time.
class ControllerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A control law. A law without state is a pure function of the measurement: it may be called at any
// time, from any thread, several times per step, and may be continuous. A law with state is
// sampled: command() is called once per sample, in order, and the caller owns the state. The caller
// also samples and holds (control/control_loop.h) and applies the actuator's limit.
class Controller {
 public:
  virtual ~Controller() = default;

  // Number of doubles that the law keeps between samples. start() sets them before the first
  // sample; they are 0 before it.
  virtual std::size_t state_size() const { return 0; }
  virtual void start(double* /*state*/) const {}
  // The requested force on the ring, N, fixed frame, or, if commands_currents(), the requested
  // currents of the actuator's axes, A. Call it only from `on.t` on. state: state_size() numbers.
  // Throws ControllerError.
  virtual Eigen::Vector2d command(const Measurement& now, const SwitchOn& on,
                                  double* state) const = 0;
  virtual bool commands_currents() const { return false; }
  // True if it stands in for a library that is not opened.
  virtual bool is_left_out() const { return false; }

  // Further quantities that a law shows: their names and units, and their values after command() at
  // the same measurement.
  struct Output {
    std::string_view name, unit;
  };
  virtual std::span<const Output> outputs() const { return {}; }
  virtual void output(const Measurement& /*now*/, const SwitchOn& /*on*/, const double* /*state*/,
                      double* /*values*/) const {}

  // True if command() reads rotor_acceleration, which costs a model evaluation.
  virtual bool needs_rotor_acceleration() const { return false; }
  // Upper bounds of the law linearised as a spring (N/m) and a damper (N s/m) on the ring. A time
  // step that treats the command explicitly must resolve them.
  struct Gains {
    double stiffness = 0.0, damping = 0.0;
  };
  virtual Gains ring_gains() const { return {}; }
  // s, times at which a law that is switched on at `on` (s) is not smooth in time.
  virtual std::vector<double> breaks(double /*on*/) const { return {}; }
};

// Largest number of outputs of a law.
inline constexpr std::size_t kMostOutputs = 4;

// Returns null if the auxiliary bearing has no controller, or a passive one without gains and
// without magnets. Throws scene::SceneError if the law rejects the scene.
std::shared_ptr<const Controller> make_controller(const scene::Scene& scene, std::size_t bearing,
                                                  const Plant& plant);

}  // namespace rotorub
