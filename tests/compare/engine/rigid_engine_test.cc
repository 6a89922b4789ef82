// Contact model `rigid` of whole runs against the native `event` integrator, which locates its
// events to round-off.
#include <gtest/gtest.h>

#include <algorithm>

#include "compare/engine/mujoco_engine.h"
#include "native_model/run/run_native.h"
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

// Inertias that are no more than a thousand times that of MuJoCo's links: the step is still the
// native one, and the state that MuJoCo comes to the one it was sent to.
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

TEST(RigidEngine, FollowsTheRingBench) {
  const scene::Scene scene = shipped("bench_ring");
  const Trajectory reference = run_event(scene), t = rigid(scene, 1e-5);
  EXPECT_EQ(t.contact_model, "rigid");
  EXPECT_LT(rotor_error(t, reference), 1.4e-8);
  EXPECT_GT(t.contact_fraction(), 0.98);
  EXPECT_NEAR(t.mean_force(), reference.mean_force(), 1e-3 * reference.mean_force());
  // Bounces, then an accumulation, then sliding: one row an impact.
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

TEST(RigidEngine, IsOfSecondOrderOnTheRingBench) {
  const scene::Scene scene = shipped("bench_ring", {"run.end=0.1"});
  const Trajectory reference = run_event(scene);
  const double coarse = rotor_error(rigid(scene, 1e-4), reference);
  const double middle = rotor_error(rigid(scene, 1e-5), reference);
  const double fine = rotor_error(rigid(scene, 1e-6), reference);
  EXPECT_LT(coarse, 1.5e-6);
  EXPECT_LT(middle, 0.0125 * coarse);  // order 1.9
  EXPECT_LT(fine, 0.0125 * middle);
}

TEST(RigidEngine, KeepsABilliardsEnergy) {
  const Trajectory t = rigid(shipped("bench_billiard"), 1e-5);
  EXPECT_GE(counted(t), 100);
  EXPECT_LE(counted(t), 102);
  const Statistics& s = t.statistics;
  EXPECT_NEAR(s.energy_end, s.energy_start, 1e-9 * s.energy_start);
  EXPECT_LT(s.energy_residual(), 1e-9);
}

TEST(RigidEngine, BouncesToRest) {
  const scene::Scene scene = shipped("bench_drop");
  const Trajectory reference = run_event(scene), t = rigid(scene, 1e-5);
  EXPECT_LT(rotor_error(t, reference), 2e-6);
  EXPECT_NEAR(t.impacts[0].t, 10.0964e-3, 2e-5);
  EXPECT_NEAR(t.impacts[1].t, 20.1928e-3, 4e-5);
  EXPECT_NEAR(t.column("normal_force").back(), 19.62, 1e-6 * 19.62);
}

// The paper's scenes at their own step. What a bouncing rotor does is compared by its means.
TEST(RigidEngine, FollowsThePapersScenes) {
  for (const char* name : {"paper_sliding", "paper_passive", "paper_magnetic"}) {
    SCOPED_TRACE(name);
    const scene::Scene scene = shipped(name, {"rotor.modes=2"});
    const Trajectory reference = run_event(scene), t = rigid(scene, 1e-5);
    EXPECT_NEAR(t.mean_force(), reference.mean_force(), 0.01 * reference.mean_force());
    // A bounce that is shorter than a step counts as contact.
    EXPECT_NEAR(t.contact_fraction(), reference.contact_fraction(), 0.025);
    EXPECT_LT(t.statistics.max_penetration, 1e-8);
  }
}

// Rankings: what the model is for.
TEST(RigidEngine, IsNearerThanCoulombThanCone) {
  const scene::Scene scene = shipped("bench_ring");
  const Trajectory reference = run_event(scene);
  const auto error = [&](scene::ContactModel contact) {
    return rotor_error(mujoco_run(scene, contact), reference);
  };
  const double rigid_error = error(scene::ContactModel::kRigid);
  const double coulomb_error = error(scene::ContactModel::kCoulomb);
  EXPECT_LT(rigid_error, coulomb_error);
  EXPECT_LT(coulomb_error, error(scene::ContactModel::kCone));
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
  Convergence c;
  for (const double step : {1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6}) {
    const Trajectory t = rigid(scene, step);
    ASSERT_EQ(t.rows(), exact.rows());
    c.steps.push_back(step);
    c.errors.push_back(rotor_error(t, exact));
  }
  EXPECT_GE(c.order(), 1.95) << c.text();
  EXPECT_LT(c.errors[0], 1e-5) << c.text();
}

INSTANTIATE_TEST_SUITE_P(Shipped, RigidRubs,
                         ::testing::Values("bench_annular_rigid", "bench_annular_elastic",
                                           "bench_whip"));

}  // namespace
}  // namespace rotorub::test
