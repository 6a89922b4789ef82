#include "tests/support/oracles/shafts.h"

#include <cmath>
#include <numbers>

#include "native_model/rotor/powers.h"

namespace rotorub::oracle {
namespace {

// A steel disc with a bore for the shaft: mass and inertias of this ring.
scene::Disc bored_disc(double z, double outer, double bore, double thickness, double rho) {
  const double d2 = outer * outer - bore * bore;
  const double s2 = outer * outer + bore * bore;
  const double mass = rho * std::numbers::pi / 4.0 * d2 * thickness;
  return {.z = z,
          .mass = mass,
          .Jt = mass * (s2 / 16.0 + thickness * thickness / 12.0),
          .Jp = mass * s2 / 8.0};
}

// The roots of a w^2 - 2 b w - c = 0: w = (b +- sqrt(b^2 + a c)) / a.
struct Quadratic {
  double a, b, c;
};

Quadratic quadratic(const RayleighShaft& shaft, int n, double speed) {
  const double lambda = n * std::numbers::pi / shaft.length;
  const double tilt = shaft.inertia() / shaft.area() * lambda * lambda;  // r^2 lambda^2
  const double stiffness = shaft.E * shaft.inertia() / (shaft.rho * shaft.area()) * fourth(lambda);
  return {1.0 + tilt, speed * tilt, stiffness};
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

scene::Scene friswell_scene() {
  scene::Scene s;
  s.name = "friswell";
  s.rotor.speed = 100.0;
  s.rotor.geometry = friswell_rotor();
  return s;
}

scene::RotorGeometry ross_rotor(int modes) {
  scene::RotorGeometry rotor = friswell_rotor();
  rotor.modes = modes;
  rotor.discs[1] = bored_disc(1.0, 0.28, 0.05, 0.07, rotor.rho);
  for (auto& bearing : rotor.bearings) bearing.stiffness = {1e6, 0.8e6};
  return rotor;
}

double RayleighShaft::area() const {
  return std::numbers::pi / 4.0 * (diameter * diameter - inner_diameter * inner_diameter);
}

double RayleighShaft::inertia() const {
  return std::numbers::pi / 64.0 * (fourth(diameter) - fourth(inner_diameter));
}

double RayleighShaft::forward(int n, double speed) const {
  const Quadratic q = quadratic(*this, n, speed);
  return (q.b + std::sqrt(q.b * q.b + q.a * q.c)) / q.a;
}

double RayleighShaft::backward(int n, double speed) const { return -forward(n, -speed); }

double RayleighShaft::modal_mass(int n) const {
  // int rho A sin^2 + rho I lambda^2 cos^2
  return 0.5 * rho * area() * length * quadratic(*this, n, 0.0).a;
}

double RayleighShaft::critical_speed(int n) const {
  // w = Omega: (1 - r^2 lambda^2) Omega^2 = c.
  const Quadratic q = quadratic(*this, n, 0.0);
  const double left = 2.0 - q.a;
  return left > 0.0 ? std::sqrt(q.c / left) : 0.0;
}

}  // namespace rotorub::oracle
