#include "native_model/oracles/drop.h"

#include <cmath>

namespace rotorub::oracle {

double Drop::fall_time() const { return std::sqrt(2.0 * height / gravity); }

double Drop::impact_time(int index) const {
  double sum = 1.0, power = 1.0;
  for (int k = 0; k < index; ++k) {
    power *= restitution;
    sum += 2.0 * power;
  }
  return fall_time() * sum;
}

double Drop::rest_time() const { return fall_time() * (1.0 + restitution) / (1.0 - restitution); }

double Drop::height_at(double t) const {
  if (t >= rest_time()) return 0.0;
  if (t < fall_time()) return height - 0.5 * gravity * t * t;
  double speed = restitution * gravity * fall_time(), since = fall_time();
  while (t - since > 2.0 * speed / gravity) {
    since += 2.0 * speed / gravity;
    speed *= restitution;
  }
  const double s = t - since;
  return speed * s - 0.5 * gravity * s * s;
}

}  // namespace rotorub::oracle
