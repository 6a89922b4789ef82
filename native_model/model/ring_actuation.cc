#include "native_model/model/ring_actuation.h"

#include <algorithm>
#include <cassert>

#include "native_model/bearing/actuator.h"
#include "native_model/model/linear_plant.h"
#include "native_model/model/model_checks.h"
#include "native_model/scene/record.h"

namespace rotorub {

void fill_actuator(const scene::Scene& scene, std::size_t k, Model& model) {
  const scene::Actuator a = scene.auxiliary[k].actuator.value_or(scene::Actuator{});
  model.auxiliary[k].force_limit = a.force_limit;
  if (a.kind == scene::ActuatorKind::kIdeal || !model.auxiliary[k].moves()) return;
  MagneticActuator& magnets = model.auxiliary[k].magnets.emplace();
  double most = a.bias_current;
  if (a.kind == scene::ActuatorKind::kElectromagnet) {
    magnets.law = std::make_shared<Electromagnet>(
        Electromagnet::Parameters{a.force_constant, a.bias_current, a.air_gap, a.stiffness});
  } else {
    const auto table =
        std::make_shared<ForceTable>(ForceGrid{a.table_position, a.table_current, a.table_force});
    const std::string reason = table->refusal();
    if (!reason.empty()) scene::refuse_at(scene, k, "actuator.table_force", reason);
    magnets.law = table;
    most = std::min(-a.table_current.front(), a.table_current.back());
  }
  magnets.current_limit = a.current_limit > 0.0 ? a.current_limit : most;
  // Without a voltage limit any inductance will do.
  magnets.coil = {a.coil_lag, a.current_rate_limit, a.voltage_limit,
                  a.inductance > 0.0 ? a.inductance : 1.0, a.resistance};
}

void fill_control(const scene::Scene& scene, std::size_t k, Model& model) {
  const scene::AuxiliaryBearing& from = scene.auxiliary[k];
  AuxiliaryBearing& to = model.auxiliary[k];
  if (!from.controller || !from.stator) return;
  // Only a law that tracks the rotor needs a contact; scene validation checks this.
  assert(from.contact || from.controller->kind == scene::ControllerKind::kPassive ||
         from.controller->kind == scene::ControllerKind::kLibrary);
  const double clearance = from.contact ? from.contact->clearance : 0.0;
  const int n = model.layout.modes;
  const auto mobility = [&](const Eigen::VectorXd& shape, int at) {
    return shape.cwiseAbs2().dot(model.mass.segment(at, n).cwiseInverse());
  };
  Plant plant;
  plant.clearance = clearance;
  plant.stator_mass = (1.0 + from.controller->mass_error) * from.stator->mass;
  plant.stator_damping = from.stator->damping;
  plant.stator_stiffness = from.stator->stiffness;
  plant.rotor_mobility = {mobility(to.shape.x, model.layout.x()),
                          mobility(to.shape.y, model.layout.y())};
  if (to.magnets) {
    plant.current_limit = to.magnets->current_limit;
    plant.coil_lag = to.magnets->coil.lag;
  } else {
    plant.force_limit = to.force_limit;
  }
  const scene::Controller& c = *from.controller;
  if (c.kind == scene::ControllerKind::kLqr || c.kind == scene::ControllerKind::kLqg) {
    const std::string why = beyond_linear_plant(scene, k, model, c.sample_time);
    if (!why.empty()) {
      scene::refuse_at(scene, k, "controller.kind", why + "; choose another kind of controller");
    }
    plant.linear = std::make_shared<LinearPlant>(plant_of(model, k, scene.rotor.speed));
  }
  to.controller = make_controller(scene, k, plant);
  to.control_on = c.on;
  to.sample_time = c.sample_time;
  if (!to.controller || c.sample_time <= 0.0) return;
  to.loop =
      std::make_shared<ControlLoop>(to.controller, c.sensors, c.trigger, c.sample_time, clearance);
}

}  // namespace rotorub
