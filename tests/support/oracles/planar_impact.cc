#include "tests/support/oracles/planar_impact.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace rotorub::oracle {

double PlanarImpact::compression(double normal_velocity) const { return -normal_velocity / g_nn; }

bool PlanarImpact::sticks(double normal_velocity, double slip) const {
  return std::abs(slip) <= friction * g_tt * compression(normal_velocity);
}

double PlanarImpact::normal_after(double normal_velocity) const {
  return -restitution * normal_velocity;
}

double PlanarImpact::slip_after(double normal_velocity, double slip) const {
  if (sticks(normal_velocity, slip)) return -restitution * tangential_restitution * slip;
  assert(tangential_restitution == 0.0);
  const double loss = friction * (1.0 + restitution) * g_tt * compression(normal_velocity);
  return std::copysign(std::max(0.0, std::abs(slip) - loss), slip);
}

}  // namespace rotorub::oracle
