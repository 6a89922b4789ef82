// The force F(s, i) of one axis of a magnetic actuator on the ring, (2) of the paper: a pure
// function of the ring's displacement s along the axis (m) and of the control current i (A).
#pragma once

#include <limits>

namespace rotorub {

class ForceLaw {
 public:
  virtual ~ForceLaw() = default;
  // N, along the axis. Finite for every finite s and i.
  virtual double force(double s, double i) const = 0;
  // N/A: (F(s, i) - F(s, 0)) / i, at i = 0 its limit.
  virtual double gain(double s, double i) const = 0;
  // The inverse, for feedback linearisation: A, the current within +- limit whose force at s comes
  // nearest to `force` (N).
  virtual double current(double s, double force, double limit) const = 0;
  // m: |s| from which on the axis no longer exists, as the ring would be in a core.
  virtual double reach() const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace rotorub
