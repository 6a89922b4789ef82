// The periodic rubs to which runs settle in `rotorub modes --periodic`, for machines with weight,
// unlike planes, films, mounts, compliant or several contacts, where no closed form exists. They
// are found by Newton's method on the return map (native_model/periodic), at the scene's speed.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "native_model/periodic/periodic_rub.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct ShootingOptions {
  int most_checks = 7, most_periods = 6;  // of each start (periodic/settled_motion.h)
  std::int64_t most_stretches = 500'000;  // of all starts together, in equal shares
  const std::atomic<bool>* interrupt = nullptr;
};

using periodic::PeriodicRub, periodic::periodic_rub;

// A start whose run settles to no periodic motion.
struct UnsettledStart {
  std::string start, why;
};

struct PeriodicRubs {
  std::vector<std::string> contacts;  // names; one empty name for a single contact
  std::vector<PeriodicRub> rubs;
  std::vector<UnsettledStart> without;
  // The reason why the machine has no periodic motion from any start, or empty.
  std::string refused;
  // A sentence about sample times that differ from the scene's (repeating_model), or empty.
  std::string sampling;
};

// Runs the scene from its own start, from the closed forms' synchronous rub and whip (without
// weight, where they exist), and else from a backward whirl. Throws scene::SceneError as prepare.
PeriodicRubs lasting_rubs_by_shooting(const scene::Scene& scene,
                                      const ShootingOptions& options = {});

}  // namespace rotorub
