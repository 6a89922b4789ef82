#include "native_model/control/library.h"

#include "native_model/control/control_loop.h"
#include "native_model/scene/record.h"

namespace rotorub {
namespace {

constexpr std::size_t kLargestState = 1 << 20;  // doubles

}  // namespace

LibraryController::LibraryController(const scene::Scene& scene, std::size_t bearing,
                                     const Plant& plant)
    : law_(scene, scene::place_of(scene, "controller", bearing),
           scene.auxiliary[bearing].controller->library) {
  if (law_.command() > ROTORUB_CURRENT)
    law_.refuse("commands neither ROTORUB_FORCE nor ROTORUB_CURRENT");
  if (commands_currents() && plant.current_limit <= 0.0) {
    law_.refuse("commands currents; set [actuator] kind = \"electromagnet\" or \"table\"");
  }
  const scene::Controller& c = *scene.auxiliary[bearing].controller;
  rotorub_setup setup{};
  setup.abi = ROTORUB_CONTROLLER_ABI;
  setup.measured = Sensors(c.sensors, c.sample_time).measured();
  setup.sample_time = c.sample_time;
  setup.clearance = plant.clearance;
  for (int k = 0; k < 2; ++k) {
    setup.stator_mass[k] = plant.stator_mass[k];
    setup.stator_damping[k] = plant.stator_damping[k];
    setup.stator_stiffness[k] = plant.stator_stiffness[k];
  }
  setup.force_limit = plant.force_limit;
  setup.current_limit = plant.current_limit;
  law_.create(setup, c.config, kLargestState);
}

bool LibraryController::commands_currents() const { return law_.command() == ROTORUB_CURRENT; }

Eigen::Vector2d LibraryController::command(const Measurement& now, const SwitchOn&,
                                           double* state) const {
  rotorub_measurement m{};
  m.t = now.t;
  m.sample = now.sample;
  for (int k = 0; k < 2; ++k) {
    m.rotor[k] = now.rotor[k];
    m.rotor_velocity[k] = now.rotor_velocity[k];
    m.stator[k] = now.stator[k];
    m.stator_velocity[k] = now.stator_velocity[k];
    m.current[k] = now.current[k];
  }
  m.spin_angle = now.spin_angle;
  m.spin_speed = now.spin_speed;
  double output[2] = {0.0, 0.0};
  law_.step(m, state, output, 2);
  return {output[0], output[1]};
}

}  // namespace rotorub
