#include "compare/bench/soft_contact.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "compare/bench/engines.h"
#include "compare/metrics/metrics.h"
#include "compare/peers/peers.h"
#include "mjcf/soft_contact.h"
#include "native_model/scene/reader.h"

namespace rotorub::bench {
namespace {

// Impact at 0.5 m/s, with enough time for the softest contact to separate.
constexpr const char* kScene = R"([run]
end = 0.2
step = 1e-5
[rotor]
speed = 0.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
damping = [0.0]
[contact]
radius = 0.05
clearance = "20 mm"
friction = 0.0
[initial]
vy = [-0.5]
)";

struct Contender {
  std::string name, setting;
  std::shared_ptr<const Engine> engine;
  double stiffness = 0.0;  // 1/s^2, direct solref; 0: none
  bool knows_the_asked = true;
};

std::vector<Contender> contenders() {
  const std::shared_ptr<const Engine> coulomb = mujoco_engine(scene::ContactModel::kCoulomb);
  const std::string calibrated = "K 1e6";
  std::vector<Contender> all{
      {"native-verlet", "", native_engine(scene::Integrator::kVerlet)},
      {"mujoco-rigid", "", mujoco_engine(scene::ContactModel::kRigid)},
      {"mujoco-coulomb", calibrated, coulomb, kCalibratedStiffness},
      {"mujoco-cone", calibrated, mujoco_engine(scene::ContactModel::kCone), kCalibratedStiffness},
      {"mujoco-coulomb", "stiff as the step", coulomb},
      {"mujoco-coulomb", "default solref", coulomb, DefaultSolref::kStiffness, false}};
  for (const peers::Peer& peer : peers::all_peers()) {
    if (peer.variants.empty() || peer.name == "penalty-per-axis") continue;
    // The first variant is the softest, with the most steps per bounce.
    all.push_back({peer.name, peer.variants[0].setting, peer.variants[0].engine});
  }
  return all;
}

RestitutionRow row(const Contender& contender, double asked, const std::atomic<bool>* interrupt) {
  RestitutionRow r{asked, contender.name, contender.setting, 0.0, ""};
  // The default has its own damping (zeta = 1), whatever restitution is requested.
  const double given =
      contender.knows_the_asked ? asked : soft_restitution(DefaultSolref::kDampingRatio);
  std::vector<std::string> overrides{fmt::format("contact.restitution={:.17g}", given)};
  if (contender.stiffness > 0.0) {
    overrides.push_back(fmt::format("mujoco.solref_stiffness={:g}", contender.stiffness));
  }
  RunRequest request;
  request.interrupt = interrupt;
  try {
    const Trajectory t =
        contender.engine->run(scene::parse_scene(kScene, "restitution.toml", overrides), request);
    if (t.status != Status::kOk) {
      r.failure = t.message;
    } else if (t.impacts.empty()) {
      r.failure = "no impact";
    } else {
      const Impact& first = t.impacts.front();
      r.got = first.gap_rate_after / -first.gap_rate_before;
    }
  } catch (const std::exception& error) {
    r.failure = error.what();
  }
  return r;
}

// The largest friction coefficient of the contacts; for a law that depends on the slip, mu(0).
double largest_friction(const scene::Scene& scene) {
  double largest = 0.0;
  for (const scene::AuxiliaryBearing& bearing : scene.auxiliary) {
    largest = std::max(largest, bearing.contact->friction.sticking());
  }
  return largest;
}

constexpr double kSteps[] = {2e-4, 1e-4, 5e-5, 2e-5, 1e-5, 5e-6};
constexpr double kStiffnesses[] = {DefaultSolref::kStiffness, 1e5, 1e6, 1e7, 1e8, 1e9};

Judgement judged_run(const Engine& engine, const scene::Scene& scene, double step,
                     const Settled& goal, const std::atomic<bool>* interrupt) {
  RunRequest request;
  request.step = step;
  request.interrupt = interrupt;
  try {
    const Trajectory t = engine.run(scene, request);
    return judge(t, t.status == Status::kOk ? settled(t) : Settled{}, goal, contact_facts(scene));
  } catch (const std::exception& error) {
    return {Outcome::kRefused, error.what()};
  }
}

}  // namespace

std::vector<RestitutionRow> restitution_table(const Progress& progress,
                                              const std::atomic<bool>* interrupt) {
  constexpr int kTenths = 10;
  std::vector<RestitutionRow> rows;
  const auto all = contenders();
  for (int k = 0; k <= kTenths; ++k) {
    progress(static_cast<double>(k) / kTenths, "restitution");
    for (const Contender& contender : all) {
      if (stopped(interrupt)) return rows;
      rows.push_back(row(contender, 0.1 * k, interrupt));
    }
  }
  return rows;
}

StabilityMap stability_map(const SceneReader& reader, const scene::Scene& scene,
                           const Progress& progress, const std::atomic<bool>* interrupt) {
  StabilityMap map;
  map.steps.assign(std::begin(kSteps), std::end(kSteps));
  map.stiffnesses.assign(std::begin(kStiffnesses), std::end(kStiffnesses));
  // A single number for all contacts.
  const double mu = largest_friction(scene);
  map.frictions = mu > 0.0 ? std::vector{0.5 * mu, mu, 2.0 * mu} : std::vector{0.0};
  for (const auto& [contact, word] : scene::kContactModels) {
    map.engines.push_back(mujoco_engine(contact)->name());
  }

  const auto soft = map.stiffnesses.size();
  const double whole =
      static_cast<double>(map.frictions.size() * map.steps.size() * (1 + 3 * soft));
  for (const double friction : map.frictions) {
    const std::string with_friction = fmt::format("contact.friction={:.17g}", friction);
    RunRequest request;
    request.interrupt = interrupt;
    const Settled goal =
        settled(event_engine(event_parameters(1e-10))->run(reader({with_friction}), request));
    for (const auto& [contact, word] : scene::kContactModels) {
      const auto engine = mujoco_engine(contact);
      const bool rigid = contact == scene::ContactModel::kRigid;
      for (const double stiffness : rigid ? std::vector{0.0} : map.stiffnesses) {
        std::vector<std::string> overrides{with_friction};
        if (!rigid) overrides.push_back(fmt::format("mujoco.solref_stiffness={:.17g}", stiffness));
        const scene::Scene variant = reader(overrides);
        for (const double step : map.steps) {
          if (stopped(interrupt)) return map;
          progress(static_cast<double>(map.cells.size()) / whole, "stability map");
          map.cells.push_back({engine->name(), friction, step, stiffness,
                               judged_run(*engine, variant, step, goal, interrupt)});
        }
      }
    }
  }
  return map;
}

}  // namespace rotorub::bench
