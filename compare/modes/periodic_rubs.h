// The periodic rubs to which runs settle in `rotorub modes --periodic`, for machines with weight,
// unlike planes, films, mounts, compliant or several contacts, where no closed form exists. They
// are found by Newton's method on the return map (native_model/periodic), at the scene's speed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "native_model/periodic/period_figures.h"
#include "native_model/periodic/settled_motion.h"
#include "native_model/scene/scene.h"

namespace rotorub {

struct ShootingOptions {
  int most_checks = 7, most_periods = 6;  // of each start (periodic/settled_motion.h)
  std::int64_t most_stretches = 500'000;  // of all starts together, in equal shares
};

// One periodic motion with the starts that lead to it.
struct PeriodicRub {
  // "no contact", "synchronous rub", "backward whip", "forward whirl", "rolling", "sticking",
  // "stick-slip", "rub on one side" (the contact does not go around the ring) or "bouncing", of the
  // contact with the largest mean force.
  std::string kind;
  std::vector<std::string> starts;
  periodic::SettledMotion settled;
  double spin = 0.0;                              // rad/s, at the start of the period
  std::size_t contact = 0;                        // with the largest mean force
  std::vector<periodic::ContactFigures> figures;  // one per auxiliary bearing
  double largest_multiplier() const;              // its absolute value
};

// The rub of a motion, with kind, contact and figures; without starts.
PeriodicRub periodic_rub(const Model& model, periodic::SettledMotion settled);

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
};

// Runs the scene from its own start, from the closed forms' synchronous rub and whip (without
// weight, where they exist), and else from a backward whirl. Throws scene::SceneError as prepare.
PeriodicRubs lasting_rubs_by_shooting(const scene::Scene& scene,
                                      const ShootingOptions& options = {});

}  // namespace rotorub
