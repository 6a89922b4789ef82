#include "compare/bench/restitution.h"

#include <fmt/format.h>

#include <memory>
#include <stdexcept>

#include "compare/peers/peers.h"
#include "mjcf/soft_contact.h"
#include "native_model/scene/reader.h"

namespace rotorub::bench {
namespace {

// Half a metre per second at the ring, and time for the softest contact to let go.
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
// 1/s^2, MuJoCo's default solref: time constant 0.02 s, damping ratio 1.
constexpr double kDefaultStiffness = 2500.0;

struct Contender {
  std::string name, setting;
  std::shared_ptr<const Engine> engine;
  double stiffness = 0.0;  // 1/s^2, direct solref; 0: none given
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
      {"mujoco-coulomb", "default solref", coulomb, kDefaultStiffness, false}};
  for (const peers::Peer& peer : peers::all_peers()) {
    if (peer.variants.empty() || peer.name == "penalty-per-axis") continue;
    // The first is the softest: the most steps a bounce.
    all.push_back({peer.name, peer.variants[0].setting, peer.variants[0].engine});
  }
  return all;
}

RestitutionRow row(const Contender& contender, double asked, const std::atomic<bool>* interrupt) {
  RestitutionRow r{asked, contender.name, contender.setting, 0.0, ""};
  // The default is a contact of its own damping: that of zeta = 1, whatever is asked.
  const double given = contender.knows_the_asked ? asked : soft_restitution(1.0);
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

}  // namespace

std::vector<RestitutionRow> restitution_table(const Progress& progress,
                                              const std::atomic<bool>* interrupt) {
  constexpr int kTenths = 10;
  std::vector<RestitutionRow> rows;
  const auto all = contenders();
  for (int k = 0; k <= kTenths; ++k) {
    progress(static_cast<double>(k) / kTenths, "restitution");
    for (const Contender& contender : all) {
      if (interrupt && interrupt->load(std::memory_order_relaxed)) return rows;
      rows.push_back(row(contender, 0.1 * k, interrupt));
    }
  }
  return rows;
}

}  // namespace rotorub::bench
