// The controller interface: one law, evaluated by the native model and by the MuJoCo plugin with
// the same measurements, so that both sides get the same command.
#pragma once

#include <Eigen/Core>
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

// What a controller sees at time t. Vectors in the fixed frame, contact plane.
struct Measurement {
  double t = 0.0;           // s
  std::int64_t sample = 0;  // number of the sample; 0 for a continuous law
  Eigen::Vector2d rotor{0.0,
                        0.0};  // m, rotor centre at the contact, from the ring's middle at rest
  Eigen::Vector2d rotor_velocity{0.0, 0.0};      // m/s
  Eigen::Vector2d rotor_acceleration{0.0, 0.0};  // m/s^2, of the model without contact force
  Eigen::Vector2d stator{0.0, 0.0};              // m, ring centre, from its middle at rest
  Eigen::Vector2d stator_velocity{0.0, 0.0};     // m/s
  double spin_angle = 0.0;                       // rad
  double spin_speed = 0.0;                       // rad/s
  Eigen::Vector2d current{0.0, 0.0};             // A, of the actuator's axes; 0 without magnets
  // The model's coordinates and their rates, whatever the sensors show.
  const double *q = nullptr, *v = nullptr;
};

// When the law was switched on, and the gap that it found there.
struct SwitchOn {
  double t = 0.0;         // s
  double gap = 0.0;       // m
  double gap_rate = 0.0;  // m/s
};

// What a controller knows, or thinks to know, of the plant.
struct Plant {
  double clearance = 0.0;                      // m
  Eigen::Vector2d stator_mass{1.0, 1.0};       // kg
  Eigen::Vector2d stator_damping{0.0, 0.0};    // N s/m
  Eigen::Vector2d stator_stiffness{0.0, 0.0};  // N/m
  // 1/kg, >= 0, of the rotor at the contact: what a force there adds to its acceleration. It is of
  // the same modes as Measurement::rotor_acceleration, which does not know the contact's force.
  Eigen::Vector2d rotor_mobility{0.0, 0.0};
  double force_limit = std::numeric_limits<double>::infinity();  // N, on each axis of the actuator
  double current_limit = 0.0;                                    // A, of magnets; 0: none
  double coil_lag = 0.0;                                         // s, of magnets
  std::shared_ptr<const LinearPlant> linear = nullptr;  // of the laws that are designed on it
};

// A law failed, or asked for what is no number: the run ends. The message names law and time.
class ControllerError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// A law. One without a state is a pure function of the measurement: it may be called at any time,
// from any thread, and more than once a step, and may be continuous. One with a state is sampled:
// step() once a sample, in order, the state being the caller's. Sampling and holding are the
// caller's too (control/control_loop.h), and so is the actuator's limit.
class Controller {
 public:
  virtual ~Controller() = default;

  // Numbers that the law remembers from one sample to the next, and what they are before the first
  // one is taken (they come as 0).
  virtual std::size_t state_size() const { return 0; }
  virtual void start(double* /*state*/) const {}
  // What the actuator is asked for: the force on the ring, N, fixed frame, or, where
  // commands_currents(), the currents of its axes, A. From `on` on only. state: state_size()
  // numbers. Throws ControllerError.
  virtual Eigen::Vector2d command(const Measurement& now, const SwitchOn& on,
                                  double* state) const = 0;
  virtual bool commands_currents() const { return false; }

  // What a law shows of itself beside its command: names, units, and the values after command() at
  // the same measurement, as many.
  struct Output {
    std::string_view name, unit;
  };
  virtual std::span<const Output> outputs() const { return {}; }
  virtual void output(const Measurement& /*now*/, const SwitchOn& /*on*/, const double* /*state*/,
                      double* /*values*/) const {}

  // True where command() reads rotor_acceleration (it costs a model evaluation).
  virtual bool needs_rotor_acceleration() const { return false; }
  // The law linearised as a spring and a damper on the ring, upper bounds: what a step that takes
  // the command explicitly must resolve. N/m, N s/m.
  struct Gains {
    double stiffness = 0.0, damping = 0.0;
  };
  virtual Gains ring_gains() const { return {}; }
  // Instants, s, at which a law that is switched on at `on` (s) is not smooth in time by itself.
  virtual std::vector<double> breaks(double /*on*/) const { return {}; }
};

// Bound on the outputs of a law.
inline constexpr std::size_t kMostOutputs = 4;

// Null for an absent table and for a passive one that emulates nothing. Throws scene::SceneError
// for what the law refuses.
std::shared_ptr<const Controller> make_controller(const scene::Scene& scene, const Plant& plant);

}  // namespace rotorub
