// Contact model `rigid` of whole runs against the native `event` integrator, which locates its
// events to round-off.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

Trajectory rigid(const scene::Scene& scene, double step) {
  return mujoco_run(scene, scene::ContactModel::kRigid, step);
}

int counted(const Trajectory& t) {
  return static_cast<int>(std::count_if(t.impacts.begin(), t.impacts.end(),
                                        [](const Impact& impact) { return counts(impact); }));
}

// Inertias are up to a thousand times that of MuJoCo's links. The step is still the native one, and
// MuJoCo reaches the state that the plugin requested.
TEST(RigidEngine, KnowsTheStateOfAPartThatWeighsLittle) {
  for (const double inertia : {9.5e-8, 7e-8, 1e-9}) {
    const std::string size = std::to_string(inertia * 1e9) + "e-9";
    for (const std::string& part :
         {"stator.spin={inertia=" + size + ",drag=0.0}",
          "rotor.torsion={inertia=[" + size + "],stiffness=[" + std::to_string(inertia * 4e6) +
              "],damping=[0.0],drive_shape=[0.0]}"}) {
      const scene::Scene scene = shipped("bench_ring", {part, "run.end=0.05"});
      const Trajectory native = run_with(scene, scene::Integrator::kVerlet), t = rigid(scene, 1e-5);
      EXPECT_EQ(counted(t), counted(native)) << part;
      EXPECT_LT(trajectory_error(t, native, scene.first().contact->radius), 1e-11) << part;
    }
  }
}

// Bounces, then an accumulation, then sliding; each impact has one row.
TEST(RigidEngine, HasTheImpactsOfTheRingBench) {
  const Trajectory t = rigid(shipped("bench_ring"), 1e-5);
  ASSERT_GE(t.impacts.size(), 5U);
  const double times[] = {4.0601e-3, 7.5981e-3, 8.9758e-3, 9.5869e-3, 9.8768e-3};
  for (std::size_t i = 0; i < 5; ++i) {
    const Impact& impact = t.impacts[i];
    EXPECT_NEAR(impact.t, times[i], 2e-7) << i;  // as published, to 0.1 us
    EXPECT_NEAR(impact.gap_rate_after, -0.5 * impact.gap_rate_before, 1e-12) << i;
    EXPECT_LT(impact.energy_change, 0.0) << i;
  }
  EXPECT_EQ(t.events.back().kind, EventKind::kSlide);
}

TEST(RigidEngine, ImplicitIntegratorDoesTheSame) {
  const scene::Scene scene = shipped("bench_ring", {"mujoco.integrator=implicit"});
  const Trajectory reference = run_event(scene), t = rigid(scene, 1e-5);
  EXPECT_EQ(t.integrator, "implicit");
  EXPECT_LT(rotor_error(t, reference), 5e-6);
}

// A rub on a rigid and on an elastic ring, and the whip of Black (1968) from its start on.
class RigidRubs : public ::testing::TestWithParam<const char*> {};

TEST_P(RigidRubs, AreOfSecondOrder) {
  scene::Scene scene = shipped(GetParam());
  scene.run.end = 0.1;
  scene.run.output_step = 1e-3;
  const Trajectory exact = run_event(scene);
  ASSERT_EQ(exact.status, Status::kOk) << exact.message;
  const Convergence c = convergence({1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6}, [&](double step) {
    const Trajectory t = rigid(scene, step);
    EXPECT_EQ(t.rows(), exact.rows());
    return rotor_error(t, exact);
  });
  EXPECT_GE(c.order(), 1.95) << c.text();
  EXPECT_LT(c.errors[0], 1e-5) << c.text();
}

INSTANTIATE_TEST_SUITE_P(Shipped, RigidRubs,
                         ::testing::Values("bench_annular_rigid", "bench_annular_elastic",
                                           "bench_whip"));

}  // namespace
}  // namespace rotorub::test
