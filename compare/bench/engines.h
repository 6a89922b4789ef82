// The engines of the bench and their settings on a ladder.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "native_model/event/parameters.h"

namespace rotorub::bench {

// Progress of a long task, and whether the user interrupted it.
using Progress = std::function<void(double share, const std::string& what)>;
inline bool stopped(const std::atomic<bool>* interrupt) {
  return interrupt && interrupt->load(std::memory_order_relaxed);
}

// Reads the scene with further overrides ("mujoco.integrator=rk4") after the user's. A variant must
// be read anew, because MuJoCo's plugin reads the scene's text.
using SceneReader = std::function<scene::Scene(const std::vector<std::string>& further)>;

// A point of the bench: one engine in one setting on one scene.
struct Setting {
  std::string engine;   // "mujoco-coulomb"
  std::string setting;  // distinguishes it from others besides the step: "rk4", "tolerance 1e-8"
  std::optional<double> step;  // s; empty for adaptive steps
  std::shared_ptr<const Engine> runner;
  std::shared_ptr<const scene::Scene> scene;
  std::string refusal;  // why the setting cannot run the scene; empty if it can
};

// The rungs for every engine: time steps, or tolerances for adaptive steps.
struct Ladder {
  std::vector<double> steps;       // s, > 0
  std::vector<double> tolerances;  // relative, > 0
};

// Steps 1-2-5 from 200 us to 1 us; tolerances from 1e-4 to 1e-12 by decades.
Ladder default_ladder();

// "100us,20us, 1e-6": times separated by commas. Throws std::invalid_argument with the wrong entry
// and what is accepted.
std::vector<double> parse_steps(const std::string& list);
// "1e-6,1e-9": numbers in (0, 1).
std::vector<double> parse_tolerances(const std::string& list);

// The parameters of `event` for a relative tolerance, for its ladder and for the reference. The
// thresholds for 0 scale with the tolerance.
EventParameters event_parameters(double tolerance);

enum class Family { kNative, kMujoco, kPeer };
const char* to_string(Family family);

// 1/s^2, direct solref of the additional setting of soft contacts: the value that a step of 20 us
// chooses.
inline constexpr double kFixedStiffness = 1e8;
inline constexpr const char* kFixedStiffnessName = "Euler, K 1e8";

struct BenchEngine {
  std::string name;
  Family family = Family::kNative;
  std::string what;     // contact law and solver, and who provides them
  std::string missing;  // why it is unavailable; empty if it is available
  struct Variant {
    std::string setting;                   // distinguishes it besides the step
    std::shared_ptr<const Engine> runner;  // null: `event`, which has tolerances instead of steps
    std::vector<std::string> overrides;    // of the scene
  };
  std::vector<Variant> variants;  // empty if the engine is unavailable

  // Each variant on all rungs of the ladder. A setting that the reader refuses contains the reason.
  std::vector<Setting> settings(const SceneReader& reader, const Ladder& ladder) const;
};

// All engines, including unavailable ones.
const std::vector<BenchEngine>& bench_engines();

// "native-verlet, ode": a list of names. A family's name ("native", "mujoco", "peer") stands for
// all its engines; an empty list for all available ones. Throws std::invalid_argument for an
// unknown or unavailable engine.
std::vector<BenchEngine> chosen_engines(const std::string& list);

}  // namespace rotorub::bench
