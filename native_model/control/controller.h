// The controller interface: one law, evaluated by the native model and by the MuJoCo plugin with
// the same measurements, so that both sides get the same command.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "native_model/scene/scene.h"

namespace rotorub {

// What a controller sees at time t. Vectors in the fixed frame, contact plane.
struct Measurement {
  double t = 0.0;                                      // s
  Eigen::Vector2d rotor{0.0, 0.0};                     // m, rotor centre at the contact
  Eigen::Vector2d rotor_velocity{0.0, 0.0};            // m/s
  Eigen::Vector2d rotor_acceleration{0.0, 0.0};        // m/s^2, of the model without contact force
  Eigen::Vector2d stator{0.0, 0.0};                    // m, ring centre
  Eigen::Vector2d stator_velocity{0.0, 0.0};           // m/s
  double spin_speed = 0.0;                             // rad/s
};

// What a controller knows of the plant.
struct Plant {
  double clearance = 0.0;                        // m
  Eigen::Vector2d stator_mass{1.0, 1.0};         // kg
  Eigen::Vector2d stator_damping{0.0, 0.0};      // N s/m
  Eigen::Vector2d stator_stiffness{0.0, 0.0};    // N/m
  // 1/kg, >= 0, of the rotor at the contact: what a force there adds to its acceleration. It is of
  // the same modes as Measurement::rotor_acceleration, which does not know the contact's force.
  Eigen::Vector2d rotor_mobility{0.0, 0.0};
};

// A law is a pure function of the measurement: no state, so it may be called at any time, from any
// thread, and more than once a step. Sampling and holding are the caller's (scene controller
// sample_time), and so is the actuator's limit.
class Controller {
 public:
  virtual ~Controller() = default;
  // Force asked of the actuator on the ring, N, fixed frame. Called for t >= on only.
  virtual Eigen::Vector2d force(const Measurement& measurement) const = 0;
  // True where force() reads rotor_acceleration (it costs a model evaluation).
  virtual bool needs_rotor_acceleration() const { return false; }
  // The law linearised as a spring and a damper on the ring, upper bounds: what a step that takes the
  // command explicitly must resolve. N/m, N s/m.
  struct Gains {
    double stiffness = 0.0, damping = 0.0;
  };
  virtual Gains ring_gains() const { return {}; }
  // Instants, s, at which the law is not smooth in time by itself.
  virtual std::vector<double> breaks() const { return {}; }
};

// Null for an absent table and for a passive one without emulated spring and damper.
std::shared_ptr<const Controller> make_controller(const scene::Scene& scene, const Plant& plant);

}  // namespace rotorub
