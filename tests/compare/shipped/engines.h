// Every shipped scene by every engine.
#pragma once

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "compare/engine/engine.h"
#include "tests/support/native_run.h"

namespace rotorub::test {

struct NamedEngine {
  std::unique_ptr<Engine> engine;
  const char* override_;  // of the scene
  double floor;           // share of the clearance: what round-off, or MuJoCo's solver, may leave
};

inline constexpr double kRoundOff = 1e-10, kSolver = 1e-6;
inline constexpr double kStep = 2e-5;  // s

inline std::vector<NamedEngine> engines() {
  using scene::ContactModel;
  using scene::Integrator;
  std::vector<NamedEngine> all;
  for (const Integrator i : {Integrator::kEvent, Integrator::kVerlet, Integrator::kEuler}) {
    all.push_back({native_engine(i), "", kRoundOff});
  }
  all.push_back({mujoco_engine(ContactModel::kRigid), "", kRoundOff});
  all.push_back({mujoco_engine(ContactModel::kRigid), "mujoco.rotor=segments", kSolver});
  all.push_back({mujoco_engine(ContactModel::kCoulomb), "", kSolver});
  all.push_back({mujoco_engine(ContactModel::kCone), "", kSolver});
  return all;
}

// The names of the scenes of a folder of mjcf.
inline std::vector<std::string> scenes_of(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(ROTORUB_MJCF_DIR + folder)) {
    if (entry.path().extension() == ".toml")
      names.push_back(folder + "/" + entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// Nothing where the engine refuses the scene.
inline std::optional<Trajectory> run(const NamedEngine& e, const std::string& name,
                                     std::vector<std::string> overrides, int ulps = 0,
                                     double step = kStep) {
  if (*e.override_ != 0) overrides.emplace_back(e.override_);
  RunRequest request;
  request.step = step;
  request.perturbation_ulps = ulps;
  try {
    return e.engine->run(shipped(name, overrides), request);
  } catch (const std::runtime_error&) {
    return {};
  }
}

}  // namespace rotorub::test
