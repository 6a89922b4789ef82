// Lasting rubs on a ring that turns, as an auxiliary ball bearing does: the speed that friction and
// drag keep it at, sliding or rolling, against whole runs.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "native_model/linear/driven_rub.h"
#include "native_model/linear/rub_map.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/exponents.h"
#include "tests/native_model/linear/rubs.h"
#include "tests/support/refusal.h"
#include "tests/support/whip.h"

namespace rotorub::rub {
namespace {

scene::Scene turning(const std::string& name, const std::string& drag,
                     std::vector<std::string> further = {}) {
  further.push_back("stator.spin={inertia=1e-3,drag=" + drag + "}");
  return test::shipped(name, further);
}

// What the run ends in is the rub, to `share` of each figure.
void expect_ends_in(const Trajectory& t, const SteadyRub& rub, double share) {
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  const auto near = [&](const char* column, double value, double whole) {
    EXPECT_NEAR(t.column(column).back(), value, share * std::abs(whole)) << column;
  };
  near("normal_force", rub.normal_force, rub.normal_force);
  near("friction_force", -rub.friction * rub.normal_force, rub.normal_force);  // may be 0
  near("ring_speed", rub.ring_speed, rub.ring_speed);
  EXPECT_NEAR(t.column("slip").back(), rub.slip, share * 20.0);
  EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), rub.whirl, share * std::abs(rub.whirl));
}

struct OnRing {
  const char *scene, *drag;  // N m s
  RubKind kind;
  bool rolls;
};
// Starts with the ring at rest: it is dragged up to where its drag holds it, or up to rolling.
constexpr OnRing kOnRings[] = {{"bench_annular_elastic", "0.015", RubKind::kForced, false},
                               {"bench_annular_elastic", "1e-3", RubKind::kForced, true},
                               {"bench_annular_elastic", "0", RubKind::kForced, true},
                               {"bench_whip", "0.025", RubKind::kWhip, false},
                               {"bench_whip", "0.006", RubKind::kRolling, true}};

TEST(TurningRingRub, IsWhatARunOfVerletSettlesOn) {
  for (const OnRing& c : kOnRings) {
    SCOPED_TRACE(std::string(c.scene) + " " + c.drag);
    const scene::Scene s = turning(c.scene, c.drag, {"run.end=3"});
    const RubSystem system = rub_system(s);
    const RubPoint point = RubStudy(system).at(system.friction);
    const StandingRub* found = point.leading(c.kind);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->stability.stable) << found->stability.growth;
    EXPECT_EQ(found->rub.rolls(), c.rolls);
    expect_ends_in(test::run_with(s, scene::Integrator::kVerlet, 2e-5), found->rub, 1e-4);
  }
}

// [initial] rub: the ring turns from the start, and all stays as it is.
TEST(TurningRingRub, IsAStartThatARunOfEventStaysOn) {
  const char* const words[] = {"synchronous", "whip", "rolling"};
  for (const OnRing& c : kOnRings) {
    SCOPED_TRACE(std::string(c.scene) + " " + c.drag);
    const std::string rub = words[static_cast<int>(c.kind)];
    const scene::Scene s = turning(c.scene, c.drag, {"run.end=0.5", "initial={rub='" + rub + "'}"});
    const RubSystem system = rub_system(s);
    const SteadyRub found = RubStudy(system).at(system.friction).leading(c.kind)->rub;
    const Trajectory t = test::run_event(s);
    EXPECT_NEAR(t.column("ring_speed")[0], found.ring_speed, 1e-12 * std::abs(found.ring_speed));
    expect_ends_in(t, found, 1e-6);
    EXPECT_NEAR(t.statistics.contact_time, 0.5, 1e-12);
  }
  const scene::Scene spun = test::shipped(
      "bench_whip", {"stator.spin={inertia=1e-3,drag=0.025,speed=3}", "initial={rub='whip'}"});
  EXPECT_EQ(test::refusal(spun).key, "stator.spin.speed");
}

// Rolling couples the ring's turning to the whirl: how fast a run comes back.
TEST(TurningRingRub, RollingDecaysAsItsEigenvaluesSay) {
  scene::Scene s = turning("bench_annular_elastic", "1e-3", {"run.end=0.1"});
  constexpr double kStep = 2.5e-4;
  s.run.output_step = kStep;
  const RubSystem system = rub_system(s);
  RotatingLoad load = rotating_loads(system).front();
  const SteadyRub rub = forced_rubs(system, load).front();
  ASSERT_TRUE(rub.rolls());
  const std::vector<Complex> expected = driven_eigenvalues(system, {}, rub);
  ASSERT_EQ(expected.size(), 6U) << "4 of rotor and ring, 2 of the turning";
  load.load *= 1.0 + 1e-4;
  const SteadyRub beside = forced_rubs(system, load).front();
  s.first().stator->spin->speed = beside.ring_speed;
  const Trajectory t = test::run_event(test::started_on(s, beside));
  ASSERT_EQ(t.status, Status::kOk) << t.message;
  std::vector<double> off = t.column("normal_force");
  for (double& force : off) force -= rub.normal_force;
  Complex found(1e300, 0.0);
  for (const Complex& e : test::exponents(off, kStep, 6)) {
    if (std::abs(e - expected.front()) < std::abs(found - expected.front())) found = e;
  }
  const Complex first = expected.front();
  EXPECT_NEAR(found.real(), first.real(), 0.01 * std::abs(first.real()) + 0.01);
  EXPECT_NEAR(found.imag(), first.imag(), 1e-3 * std::abs(first.imag()) + 0.01);
}

// Without drag nothing holds the ring back: it takes no tangential force for long, and no whip
// lasts.
TEST(TurningRingRub, WithoutDragNoWhipLasts) {
  const RubSystem free = rub_system(turning("bench_whip", "0"));
  EXPECT_TRUE(RubStudy(free).at(free.friction).rubs.empty());
  const RubSystem forced = rub_system(turning("bench_annular_elastic", "0"));
  const auto rubs = forced_rubs(forced, rotating_loads(forced).front());
  ASSERT_EQ(rubs.size(), 1U);
  EXPECT_EQ(rubs[0].friction, 0.0);
  EXPECT_NEAR(rubs[0].ring_speed, forced.speed, 1e-12 * forced.speed) << "with the shaft";
}

}  // namespace
}  // namespace rotorub::rub
