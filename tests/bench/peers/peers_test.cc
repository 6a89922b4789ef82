// Each peer solves the scenes that it accepts, as accurately as its scheme allows.
#include "compare/peers/peers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "compare/bench/reference.h"
#include "tests/bench/peers/module.h"
#include "tests/bench/peers/penalty.h"
#include "tests/bench/peers/planar_scene.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub::peers {
namespace {

using test::shipped;

const Peer& peer(const std::string& name) {
  return *std::find_if(all_peers().begin(), all_peers().end(),
                       [&](const Peer& p) { return p.name == name; });
}

// Where a peer has to be there (tests/run says so), its absence is a failure.
bool required() {
  const char* value = std::getenv("ROTORUB_REQUIRE_PEERS");
  return value && std::string(value) == "1";
}

double error_of(const PeerVariant& variant, const scene::Scene& scene, double step) {
  RunRequest request;
  request.output_times = bench::common_times(scene.run, {1e-4, 1e-5});
  const bench::Reference r = bench::make_reference(scene, request);
  request.step = step;
  const Trajectory t = variant.engine->run(scene, request);
  EXPECT_EQ(t.status, Status::kOk) << variant.setting << ": " << t.message;
  return bench::position_distance(t, r.trajectory);
}

class EveryPeer : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const Peer& p = peer(GetParam());
    if (!p.variants.empty()) return;
    ASSERT_FALSE(required()) << GetParam() << ": " << p.missing;
    GTEST_SKIP() << GetParam() << " is not here: " << p.missing;
  }
  const Engine& engine() const { return *peer(GetParam()).variants.front().engine; }
  double error(const scene::Scene& scene, double step) const {
    return error_of(peer(GetParam()).variants.front(), scene, step);
  }
};

// The test compares the ranking; the bounds are twice the measured errors.
TEST_P(EveryPeer, ConvergesOnTheRing) {
  const scene::Scene scene = shipped("bench_ring", {"run.end=0.1"});
  const double coarse = error(scene, 1e-4), fine = error(scene, 1e-5);
  EXPECT_LT(fine, 0.3 * coarse);
  EXPECT_LT(fine, GetParam() == "penalty" ? 4e-5 : 7e-6);
}

TEST_P(EveryPeer, ConvergesOnTheAnnularRub) {
  const scene::Scene scene = shipped("bench_annular_elastic", {"run.end=0.05"});
  const double coarse = error(scene, 1e-4), fine = error(scene, 1e-5);
  EXPECT_LT(fine, 0.3 * coarse);
  EXPECT_LT(fine, 1e-5);
}

TEST_P(EveryPeer, PressesAsTheReferenceDoes) {
  const scene::Scene scene = shipped("bench_annular_rigid", {"run.end=0.05"});
  RunRequest request;
  request.step = 1e-5;
  const Trajectory t = engine().run(scene, request);
  // The start of a soft contact rings.
  EXPECT_NEAR(t.column("normal_force").back(), 146.0239, 0.01 * 146.0);
  EXPECT_NEAR(t.column("friction_force").back(), -0.15 * 146.0239, 0.01 * 22.0);
  EXPECT_EQ(t.step, 1e-5);
  EXPECT_EQ(t.steps, 5000);
}

TEST_P(EveryPeer, BouncesWithTheRestitution) {
  const scene::Scene scene = shipped("bench_drop", {"run.end=0.025"});
  RunRequest request;
  request.step = 1e-5;
  const Trajectory t = engine().run(scene, request);
  ASSERT_GE(t.impacts.size(), 2u);
  EXPECT_NEAR(t.impacts[0].t, 10.0964e-3, 3e-5);
  EXPECT_NEAR(t.impacts[1].t, 20.1928e-3, 1e-3) << "a soft bounce lasts";
  EXPECT_NEAR(t.impacts[0].gap_rate_after, -0.5 * t.impacts[0].gap_rate_before,
              0.02 * std::abs(t.impacts[0].gap_rate_before));
}

// A peer names the parts that it does not support, and computes nothing for scenes with them.
TEST_P(EveryPeer, RefusesWhatItCannotHold) {
  struct Case {
    const char *scene, *override, *part;
  };
  for (const Case& c :
       {Case{"paper_passive", "run.end=0.01", "modes"},
        Case{"bench_ring", "rotor.modal.gyroscopic=[0.1]", "gyroscopic"},
        Case{"bench_ring", "rotor.modal.internal_damping=[1.0]", "internal"},
        Case{"bench_ring", "contact.tangential_restitution=0.5", "tangential"},
        Case{"bench_ring", "stator.spin.inertia=1e-4", "turns"},
        Case{"bench_ring", "stator.mount={mass=2.0,stiffness=1e5}", "spring"},
        Case{"bench_ring", "stator.dry_friction={force=9.0,presliding=1e-5}", "spring"},
        Case{"bench_ring", "contact.compliance.stiffness=1e7", "gives"},
        Case{"bench_ring", "gravity.acceleration=[0.0,-9.81]", "gravity"}}) {
    EXPECT_TRUE(test::contains(
        test::message_of([&] { engine().run(shipped(c.scene, {c.override}), {}); }), c.part));
  }
}

INSTANTIATE_TEST_SUITE_P(Peers, EveryPeer, testing::Values("siconos", "ode", "penalty"),
                         [](const auto& one) { return one.param; });

// A missing peer names the package to install, and is not an engine.
TEST(ModulePeer, SaysWhatIsMissing) {
  const Peer none = module_peer("nothing", "made up", "libnothing-dev");
  EXPECT_TRUE(none.variants.empty());
  EXPECT_NE(none.missing.find("libnothing-dev"), std::string::npos) << none.missing;
}

// Every law tends to the rigid contact, up to two steps a bounce, the implicit rule too.
TEST(PenaltyVariants, AllConverge) {
  const scene::Scene scene = shipped("bench_annular_rigid", {"run.end=0.05"});
  ASSERT_EQ(peer("penalty").variants.size(), 6u);
  for (const PeerVariant& v : peer("penalty").variants) {
    const double coarse = error_of(v, scene, 1e-4), fine = error_of(v, scene, 1e-5);
    EXPECT_LT(fine, 0.3 * coarse) << v.setting;
  }
}

// At one step the stiffer law is the nearer to the rigid one in a rub that lasts.
TEST(PenaltyVariants, AStifferLawIsTheBetterOneInALastingRub) {
  const scene::Scene scene = shipped("bench_annular_rigid", {"run.end=0.05"});
  const auto& all = peer("penalty").variants;
  const double soft = error_of(all[0], scene, 2e-5), stiff = error_of(all[3], scene, 2e-5);
  EXPECT_LT(stiff, 0.1 * soft);
}

// One contact from its begin to its end, at one step a thousandth of it: both schemes are the same
// law.
TEST(PenaltyVariants, SchemesAgreeWhereTheStepIsFine) {
  PlanarSystem s;
  s.rotor = {{2.0, 2.0}, {40.0, 40.0}, {2e5, 2e5}};
  s.ring_moves = true;
  s.ring = {{1.0, 1.0}, {200.0, 200.0}, {1e5, 1e5}};
  s.spin_is_free = true;
  s.inertia = 1e-3;
  s.drive_gain = 0.5;
  s.speed = s.drive_speed = 314.0;
  s.radius = 0.05;
  s.clearance = 5e-4;
  s.friction = 0.15;
  s.restitution = 0.5;
  s.position = {4.9e-4, 0.0};
  s.velocity = {0.3, 0.05};
  PenaltyParameters explicit_scheme, implicit_scheme;
  explicit_scheme.step_fraction = implicit_scheme.step_fraction = 3e-3;
  implicit_scheme.scheme = PenaltyScheme::kImplicitMidpoint;
  std::vector<StepRecord> a(2000), b(2000);
  penalty_stepper(s, 1e-6, explicit_scheme)->advance(2000, a.data());
  penalty_stepper(s, 1e-6, implicit_scheme)->advance(2000, b.data());
  const auto pressed = [](const std::vector<StepRecord>& all) {
    double sum = 0.0;
    for (const StepRecord& r : all) sum += r.normal;
    return sum;
  };
  EXPECT_GT(pressed(a), 0.1);
  EXPECT_NEAR(pressed(b), pressed(a), 1e-3 * pressed(a));
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(b.back().velocity[i], a.back().velocity[i], 1e-3);
    EXPECT_NEAR(b.back().ring_velocity[i], a.back().ring_velocity[i], 1e-3);
  }
  EXPECT_NEAR(b.back().speed, a.back().speed, 1e-2);
}

// ---------------------------------------------------------------- the penalty law, by hand
PlanarSystem disc() {
  PlanarSystem s;
  s.clearance = 1e-3;
  s.radius = 0.05;
  s.friction = 0.2;
  return s;
}

// 0.1 mm deep along x, opening at 2 mm/s, sliding at r Omega = 5 m/s.
StepRecord deep() {
  StepRecord y;
  y.position = {1.1e-3, 0.0};
  y.velocity = {-2e-3, 0.0};
  y.speed = 100.0;
  return y;
}

TEST(PenaltyForce, ByHand) {
  const PenaltyForce f = penalty_force(disc(), deep(), 1e6, 1e4, {});
  EXPECT_NEAR(f.normal, 1e6 * 1e-4 - 1e4 * 2e-3, 1e-9);
  EXPECT_NEAR(f.friction, -0.2 * 80.0, 1e-9) << "against the slip, which is positive";
  EXPECT_NEAR(f.force[0], -80.0, 1e-9);
  EXPECT_NEAR(f.force[1], -16.0, 1e-9);
}

TEST(PenaltyForce, NeverPullsAndIsNoneWithoutContact) {
  StepRecord y = deep();
  y.velocity = {-1.0, 0.0};
  EXPECT_EQ(penalty_force(disc(), y, 1e6, 1e4, {}).normal, 0.0);
  y.position = {0.9e-3, 0.0};
  EXPECT_EQ(penalty_force(disc(), y, 1e6, 1e4, {}).force, (Pair{0.0, 0.0}));
}

// Per axis: nothing along the tangent at psi = 0, where all of it should be; at 135 degrees of the
// four odd angles it is right.
TEST(PenaltyForce, PerAxisFrictionIsNotTangential) {
  PenaltyParameters per_axis;
  per_axis.friction = PenaltyFriction::kPerAxis;
  StepRecord y = deep();
  y.velocity = {0.0, 0.0};
  const PenaltyForce f = penalty_force(disc(), y, 1e6, 0.0, per_axis);
  EXPECT_NEAR(f.force[0], -100.0 - 20.0, 1e-9);
  EXPECT_NEAR(f.force[1], 0.0, 1e-9);
  EXPECT_NEAR(f.friction, 0.0, 1e-9);

  int right = 0;
  for (int k = 0; k < 8; ++k) {
    const double psi = k * 0.25 * 3.14159265358979;
    y.position = {1.1e-3 * std::cos(psi), 1.1e-3 * std::sin(psi)};
    const PenaltyForce wrong = penalty_force(disc(), y, 1e6, 0.0, per_axis);
    const PenaltyForce law = penalty_force(disc(), y, 1e6, 0.0, {});
    if (std::hypot(wrong.force[0] - law.force[0], wrong.force[1] - law.force[1]) < 1e-6) ++right;
  }
  EXPECT_EQ(right, 1) << "of 8 angles";
}

// ---------------------------------------------------------------- what is handed over
// Its other numbers show in the runs above.
TEST(PlanarSystem, HasTheStartOfTheScene) {
  const PlanarSystem held = planar_system(shipped("bench_whip"));
  EXPECT_FALSE(held.spin_is_free);
  EXPECT_NEAR(held.speed, 100.0 * 3.141592653589793, 1e-9);
  EXPECT_EQ(held.ring_velocity[0], 0.020349360147386315);
}

TEST(PlanarSystem, LoadsSwitchAndRamp) {
  const PlanarSystem s = planar_system(
      shipped("bench_drop",
              {"force=[{kind=\"constant\", vector=[0.0,-10.0], on=0.01, off=0.03, ramp=0.01}]"}));
  EXPECT_EQ(s.load(0.005)[1], 0.0);
  EXPECT_NEAR(s.load(0.015)[1], -5.0, 1e-12);
  EXPECT_EQ(s.load(0.025)[1], -10.0);
  EXPECT_EQ(s.load(0.03)[1], 0.0);
}

}  // namespace
}  // namespace rotorub::peers
