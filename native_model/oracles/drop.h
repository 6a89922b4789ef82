// Exact: a body under constant acceleration g falls the height h onto the ring and bounces with
// the restitution eps < 1: impacts at sqrt(2h/g) (1 + 2 eps + 2 eps^2 + ... + 2 eps^k), rest at
// sqrt(2h/g) (1 + eps) / (1 - eps).
#pragma once

namespace rotorub::oracle {

struct Drop {
  double height;       // m, > 0
  double gravity;      // m/s^2, > 0
  double restitution;  // eps_N in [0, 1)

  double fall_time() const;             // s, sqrt(2h/g)
  double impact_time(int index) const;  // s, index from 0
  double rest_time() const;             // s
  double height_at(double t) const;     // m, above the ring
};

}  // namespace rotorub::oracle
