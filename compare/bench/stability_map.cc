#include "compare/bench/stability_map.h"

#include <fmt/format.h>

#include <stdexcept>

#include "compare/bench/event_engine.h"

namespace rotorub::bench {
namespace {

constexpr double kSteps[] = {2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6};
// 1/s^2; MuJoCo's default solref of 20 ms has 2,500.
constexpr double kStiffnesses[] = {2.5e3, 1e5, 1e6, 1e7, 1e8, 1e9};

struct Contact {
  scene::ContactModel model;
  const char* name;
};
constexpr Contact kContacts[] = {{scene::ContactModel::kRigid, "mujoco-rigid"},
                                 {scene::ContactModel::kCoulomb, "mujoco-coulomb"},
                                 {scene::ContactModel::kCone, "mujoco-cone"},
                                 {scene::ContactModel::kConeCoulomb, "mujoco-cone-coulomb"}};

Judgement judged_run(const Engine& engine, const scene::Scene& scene, double step,
                     const Settled& goal, const std::atomic<bool>* interrupt) {
  RunRequest request;
  request.step = step;
  request.interrupt = interrupt;
  try {
    const Trajectory t = engine.run(scene, request);
    return judge(t, t.status == Status::kOk ? settled(t) : Settled{}, goal,
                 scene.first().contact->clearance);
  } catch (const std::exception& error) {
    return {Outcome::kRefused, error.what()};
  }
}

}  // namespace

StabilityMap stability_map(const SceneReader& reader, const scene::Scene& scene,
                           const Progress& progress, const std::atomic<bool>* interrupt) {
  const auto stopped = [&] { return interrupt && interrupt->load(std::memory_order_relaxed); };
  StabilityMap map;
  map.steps.assign(std::begin(kSteps), std::end(kSteps));
  map.stiffnesses.assign(std::begin(kStiffnesses), std::end(kStiffnesses));
  const double mu = scene.first().contact->friction.constant("the stability map");
  map.frictions = mu > 0.0 ? std::vector{0.5 * mu, mu, 2.0 * mu} : std::vector{0.0};
  for (const Contact& contact : kContacts) map.engines.push_back(contact.name);

  const auto soft = map.stiffnesses.size();
  const double whole =
      static_cast<double>(map.frictions.size() * map.steps.size() * (1 + 3 * soft));
  for (const double friction : map.frictions) {
    const std::string with_friction = fmt::format("contact.friction={:.17g}", friction);
    RunRequest request;
    request.interrupt = interrupt;
    const Settled goal =
        settled(event_engine(event_parameters(1e-10))->run(reader({with_friction}), request));
    for (const Contact& contact : kContacts) {
      const auto engine = mujoco_engine(contact.model);
      const bool rigid = contact.model == scene::ContactModel::kRigid;
      for (const double stiffness : rigid ? std::vector{0.0} : map.stiffnesses) {
        std::vector<std::string> overrides{with_friction};
        if (!rigid) overrides.push_back(fmt::format("mujoco.solref_stiffness={:.17g}", stiffness));
        const scene::Scene variant = reader(overrides);
        for (const double step : map.steps) {
          if (stopped()) return map;
          progress(static_cast<double>(map.cells.size()) / whole, "stability map");
          map.cells.push_back({contact.name, friction, step, stiffness,
                               judged_run(*engine, variant, step, goal, interrupt)});
        }
      }
    }
  }
  return map;
}

}  // namespace rotorub::bench
