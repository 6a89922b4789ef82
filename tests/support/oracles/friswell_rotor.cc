#include "tests/support/oracles/friswell_rotor.h"

#include <numbers>

namespace rotorub::oracle {
namespace {

// A steel disc bored for the shaft: mass and inertias of the ring.
scene::Disc bored_disc(double z, double outer, double bore, double thickness, double rho) {
  const double d2 = outer * outer - bore * bore;
  const double s2 = outer * outer + bore * bore;
  const double mass = rho * std::numbers::pi / 4.0 * d2 * thickness;
  return {.z = z,
          .mass = mass,
          .Jt = mass * (s2 / 16.0 + thickness * thickness / 12.0),
          .Jp = mass * s2 / 8.0};
}

}  // namespace

scene::RotorGeometry friswell_rotor() {
  scene::RotorGeometry rotor;
  rotor.length = 1.5;
  rotor.E = 211e9;
  rotor.G = 81.2e9;
  rotor.rho = 7810.0;
  rotor.modes = 3;
  rotor.sections = {{.from = 0.0, .to = 1.5, .diameter = 0.05}};
  rotor.discs = {bored_disc(0.5, 0.28, 0.05, 0.07, rotor.rho),
                 bored_disc(1.0, 0.35, 0.05, 0.07, rotor.rho)};
  const scene::PlanePair stiffness{1e6, 1e6};
  rotor.bearings = {{.z = 0.0, .stiffness = stiffness}, {.z = 1.5, .stiffness = stiffness}};
  return rotor;
}

}  // namespace rotorub::oracle
