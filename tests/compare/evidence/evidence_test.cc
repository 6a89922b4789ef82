// The evidence for the native model and MuJoCo's contact models: for each pair of methods, the
// parts that they share and their difference. Agreement of two methods that share a part is no
// evidence for that part. The table of compare/docs/findings.md is printed by
//
//   build/bin/test_compare_evidence --gtest_brief=1
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>

#include "compare/bench/reference.h"
#include "compare/engine/mujoco_engine.h"
#include "compare/peers/peers.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/elastic_whip.h"
#include "tests/support/whip.h"

namespace rotorub::test {
namespace {

// How far apart two runs are.
struct Apart {
  double position = 0.0;  // of the clearance, the largest over the rows
  double force = 0.0;     // of the mean normal force
};

struct Pair {
  const char* name;
  const char* both;  // what the two share: of this their agreement says nothing
  const char* scene;
  std::function<std::optional<Apart>()> apart;  // none: one of the two is not here
  Apart limit;  // twice what was met, or more where chance has its part
};

void PrintTo(const Pair& pair, std::ostream* out) { *out << pair.name; }

constexpr double kStep = 1e-5;

Apart between(const Trajectory& a, const Trajectory& b, double clearance) {
  return {bench::position_distance(a, b) / clearance,
          std::abs(a.mean_force() / b.mean_force() - 1.0)};
}

// ---------------------------------------------------------------- the bench of impacts and a
// lasting rub
scene::Scene ring() { return shipped("bench_ring", {"run.step=1e-5"}); }

const Trajectory& ring_by_event() {
  static const Trajectory t = run_event(ring());
  return t;
}

std::optional<Apart> on_the_ring(const Trajectory& t) {
  return between(t, ring_by_event(), ring().first().contact->clearance);
}

std::optional<Apart> peer_on_the_ring(const std::string& name) {
  for (const peers::Peer& peer : peers::all_peers()) {
    if (peer.name != name || peer.variants.empty()) continue;
    RunRequest request;
    request.step = kStep;
    return on_the_ring(peer.variants.front().engine->run(ring(), request));
  }
  return {};
}

auto mujoco_on_the_ring(scene::ContactModel contact) {
  return [contact]() { return on_the_ring(mujoco_run(ring(), contact)); };
}

// The same where the ring gives, at its scene's step of 2 us.
auto mujoco_on_the_giving_ring(scene::ContactModel contact) {
  return [contact]() {
    const scene::Scene scene = shipped("compliant_ring");
    return std::optional(
        between(mujoco_run(scene, contact), run_event(scene), scene.first().contact->clearance));
  };
}

// ---------------------------------------------------------------- others
std::optional<Apart> event_and_whip() {
  const scene::Scene scene = shipped("bench_whip");
  const oracle::ElasticWhip whip = whip_of(scene);
  const double nu = whip.slipping_whips(scene.first().contact->friction.coefficient).at(1);
  const Trajectory t = run_event(scene);
  const oracle::CircularWhirl exact = whip.whirl(nu);
  const double size = std::hypot(t.column("rotor_x").back(), t.column("rotor_y").back());
  return Apart{std::abs(size - std::abs(exact.rotor)) / scene.first().contact->clearance,
               std::abs(t.column("normal_force").back() / exact.force - 1.0)};
}

// A lasting rub of the reference rig; the native side has the beam's modes, MuJoCo 20 rigid bodies.
std::optional<Apart> segments_and_event() {
  const scene::Scene scene = shipped(
      "paper_passive", {"mujoco={rotor=\"segments\", segments=20}", "run.step=5e-6", "run.end=0.3",
                        "contact.friction=0.1", "rotor.modes=5", "rotor.torsion.modes=3"});
  const Trajectory bodies = mujoco_run(scene, scene::ContactModel::kRigid),
                   native = run_event(scene);
  const double size = std::hypot(native.column("rotor_x").back(), native.column("rotor_y").back());
  const double other = std::hypot(bodies.column("rotor_x").back(), bodies.column("rotor_y").back());
  return Apart{std::abs(other - size) / scene.first().contact->clearance,
               std::abs(bodies.mean_force() / native.mean_force() - 1.0)};
}

std::optional<Apart> rigid_and_verlet() {
  const Trajectory native = run_with(ring(), scene::Integrator::kVerlet, kStep);
  return between(mujoco_run(ring(), scene::ContactModel::kRigid), native,
                 ring().first().contact->clearance);
}

// ---------------------------------------------------------------- the table; a contact model more
// is a line more
const Pair kPairs[] = {
    {"`rigid` and `verlet`",
     "model, law and step",
     "`bench_ring`",
     rigid_and_verlet,
     {1e-13, 1e-13}},
    {"`verlet` and `event`",
     "model and law; integration and impact search differ",
     "`bench_ring`",
     [] { return on_the_ring(run_with(ring(), scene::Integrator::kVerlet, kStep)); },
     {3e-5, 2e-6}},
    {"`rigid` on segments and `event`",
     "law and step; the rotor is MuJoCo's rigid bodies",
     "the rig at a friction of 0.1",
     segments_and_event,
     {0.02, 0.016}},
    {"closed form and `event`",
     "the scene; no code",
     "`bench_whip`, its end",
     event_and_whip,
     {1e-8, 1e-8}},
    {"Siconos and `event`",
     "free rotor, gap and normal; nothing of the law",
     "`bench_ring`",
     [] { return peer_on_the_ring("siconos"); },
     {5e-3, 2e-4}},
    {"ODE and `event`",
     "free rotor, gap and normal; nothing of the law",
     "`bench_ring`",
     [] { return peer_on_the_ring("ode"); },
     {1.3e-2, 3e-4}},
    {"`coulomb` and `event`",
     "modes, gap and normal, friction by slip; the normal force is MuJoCo's",
     "`bench_ring`",
     mujoco_on_the_ring(scene::ContactModel::kCoulomb),
     {4e-2, 3e-4}},
    {"`cone-coulomb` and `event`",
     "modes, gap and normal; the law is MuJoCo's solver's, its references by the plugin",
     "`bench_ring`",
     mujoco_on_the_ring(scene::ContactModel::kConeCoulomb),
     {8e-2, 6e-4}},
    {"`cone` and `event`",
     "modes, gap and normal; nothing of the law",
     "`bench_ring`",
     mujoco_on_the_ring(scene::ContactModel::kCone),
     {1.4, 0.05}},
    {"`coulomb` and `event`, a ring that gives",
     "modes, gap, normal and law; the step is MuJoCo's",
     "`compliant_ring`",
     mujoco_on_the_giving_ring(scene::ContactModel::kCoulomb),
     {1e-2, 1e-3}},
    {"`cone-coulomb` and `event`, a ring that gives",
     "modes, gap, normal and the formula of the force; MuJoCo's solver finds force and friction",
     "`compliant_ring`",
     mujoco_on_the_giving_ring(scene::ContactModel::kConeCoulomb),
     {1e-2, 1e-3}},
};

class Evidence : public MujocoTest, public testing::WithParamInterface<Pair> {};

TEST_P(Evidence, IsAsFarApartAsSaid) {
  const Pair& pair = GetParam();
  const std::optional<Apart> apart = pair.apart();
  if (!apart) GTEST_SKIP() << pair.name << ": not here";
  std::printf("| %s | %s | %s | %.1e | %.1e |\n", pair.name, pair.both, pair.scene, apart->position,
              apart->force);
  EXPECT_LT(apart->position, pair.limit.position);
  EXPECT_LT(apart->force, pair.limit.force);
}

INSTANTIATE_TEST_SUITE_P(Pairs, Evidence, testing::ValuesIn(kPairs));

}  // namespace
}  // namespace rotorub::test
