#include "tests/support/oracles/rayleigh_shaft.h"

#include <cmath>
#include <numbers>

#include "native_model/rotor/powers.h"

namespace rotorub::oracle {
namespace {

// w = (b +- sqrt(b^2 + a c)) / a of a w^2 - 2 b w - c = 0.
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
