// The engines that the bench knows, and their settings on a ladder.
#pragma once

#include <string>
#include <vector>

#include "compare/bench/ladder.h"
#include "compare/bench/setting.h"

namespace rotorub::bench {

enum class Family { kNative, kMujoco, kPeer };
const char* to_string(Family family);

// 1/s^2, direct solref of the soft contacts' further setting: what a step of 20 us gives itself.
inline constexpr double kFixedStiffness = 1e8;
inline constexpr const char* kFixedStiffnessName = "Euler, K 1e8";

struct BenchEngine {
  std::string name;
  Family family = Family::kNative;
  std::string what;     // contact law and solver, and whose they are
  std::string missing;  // why it is not here; empty: it is
  std::function<std::vector<Setting>(const SceneReader&, const Ladder&)> settings;
};

// All of them, also those that are not here.
const std::vector<BenchEngine>& bench_engines();

// "native-verlet, ode"; a family's name stands for all of it ("native", "mujoco", "peer"); empty:
// all that are here. Throws std::invalid_argument for a name that none has and for an engine that
// is not here.
std::vector<BenchEngine> chosen_engines(const std::string& list);

}  // namespace rotorub::bench
