// The interface of a peer's solver, and of the modules that contain one.
#pragma once

#include <cstdint>

#include "tests/bench/peers/planar_system.h"

namespace rotorub::peers {

// The state at the end of a step and the contact's impulses over it.
struct StepRecord {
  Pair position{}, velocity{}, ring_position{}, ring_velocity{};
  double angle = 0.0, speed = 0.0;  // rad, rad/s
  double normal = 0.0;              // N s, on the rotor towards the centre, >= 0
  double friction = 0.0;            // N s, on the rotor along e_t
};

class Stepper {
 public:
  virtual ~Stepper() = default;
  // Computes the next `count` steps into `records`. False: the solver failed (message()).
  virtual bool advance(std::int64_t count, StepRecord* records) = 0;
  virtual const char* message() const = 0;
};

// The interface that a module exports as `rotorub_peer`: the version of its solver, and a function
// that makes one. It returns null if the solver cannot represent the system. The caller deletes the
// solver.
struct ModuleInterface {
  const char* version;
  Stepper* (*make)(const PlanarSystem& system, double step);
};
inline constexpr const char* kModuleSymbol = "rotorub_peer";

}  // namespace rotorub::peers
