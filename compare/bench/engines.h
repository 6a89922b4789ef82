// The engines that the bench knows, and their settings on a ladder.
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

// How far a long piece of work is, and with what; and whether its user has enough of it.
using Progress = std::function<void(double share, const std::string& what)>;
inline bool stopped(const std::atomic<bool>* interrupt) {
  return interrupt && interrupt->load(std::memory_order_relaxed);
}

// The scene with further overrides ("mujoco.integrator=rk4") on top of the user's: MuJoCo's plugin
// reads the scene's text, so that a variant has to be read anew.
using SceneReader = std::function<scene::Scene(const std::vector<std::string>& further)>;

// What a point of the bench is: one engine with one setting on one scene.
struct Setting {
  std::string engine;          // "mujoco-coulomb"
  std::string setting;         // what beside the step tells it from others: "rk4", "tolerance 1e-8"
  std::optional<double> step;  // s; none: the engine chooses its steps
  std::shared_ptr<const Engine> runner;
  std::shared_ptr<const scene::Scene> scene;
  std::string refusal;  // why the scene cannot be had in this setting; empty: it can
};

// The rungs that every engine is put on: steps of the fixed steps, tolerances of the others.
struct Ladder {
  std::vector<double> steps;       // s, > 0
  std::vector<double> tolerances;  // relative, > 0
};

// 1-2-5 from 200 us to 1 us; decades from 1e-4 to 1e-12.
Ladder default_ladder();

// "100us,20us, 1e-6": times separated by commas. Throws std::invalid_argument that says which entry
// is wrong and what is accepted.
std::vector<double> parse_steps(const std::string& list);
// "1e-6,1e-9": numbers in (0, 1).
std::vector<double> parse_tolerances(const std::string& list);

// The settings of `event` for a relative tolerance, of its ladder and of the reference: what is
// distinguished from 0 by the tolerance follows it.
EventParameters event_parameters(double tolerance);

// RunRequest::step is not read: forces are averaged over the bins of the parameters.
std::unique_ptr<Engine> event_engine(const EventParameters& parameters);

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
  struct Variant {
    std::string setting;                   // what beside the step tells it from others
    std::shared_ptr<const Engine> runner;  // null: `event`, which has tolerances in place of steps
    std::vector<std::string> overrides;    // of the scene
  };
  std::vector<Variant> variants;  // none where it is missing

  // Each variant on all rungs of the ladder; what the reader refuses is said of it.
  std::vector<Setting> settings(const SceneReader& reader, const Ladder& ladder) const;
};

// All of them, also those that are not here.
const std::vector<BenchEngine>& bench_engines();

// "native-verlet, ode"; a family's name stands for all of it ("native", "mujoco", "peer"); empty:
// all that are here. Throws std::invalid_argument for a name that none has and for an engine that
// is not here.
std::vector<BenchEngine> chosen_engines(const std::string& list);

}  // namespace rotorub::bench
