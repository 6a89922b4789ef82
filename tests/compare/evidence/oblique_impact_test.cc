// A sphere that strikes a wall obliquely, by every contact model, against the closed form
// (oracles/oblique_impact.h). Printed as the second table of the section Evidence of
// compare/docs/findings.md by
//
//   build/bin/test_compare_evidence --gtest_brief=1
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include "tests/support/mujoco_fixture.h"
#include "tests/support/mujoco_run.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/oblique_impact.h"

namespace rotorub::test {
namespace {

using oracle::ObliqueImpact;

constexpr double kBlowStep = 1e-6, kFlight = 1e-5, kWall = 1.0;  // s, s, m

// The wall is a ring of 1 m clearance, which the sphere meets at an angle of 0. Soft contacts are
// as stiff as the step allows.
scene::Scene scene_of(const ObliqueImpact& x) {
  char text[1000];
  std::snprintf(text, sizeof text, R"(
[run]
end = 1e-4
step = %.17g
[rotor]
speed = 0.0
[rotor.modal]
mass = [%.17g]
stiffness = [0.0]
damping = [0.0]
inertia = %.17g
[drive]
kind = "free"
[contact]
radius = %.17g
clearance = %.17g
friction = %.17g
restitution = %.17g
[mujoco]
solref_stiffness = %.17g
[initial]
x = [%.17g]
y = [%.17g]
vx = [%.17g]
vy = [%.17g]
)",
                kBlowStep, x.mass(), x.inertia(), x.radius, kWall, x.friction, x.restitution,
                std::pow(0.2 / kBlowStep, 2), kWall - kFlight * x.normal_speed(),
                -kFlight * x.tangential_speed(), x.normal_speed(), x.tangential_speed());
  return parsed(text);
}

// The largest differences from the closed form over all angles and restitutions.
struct BlowError {
  double restitution = 0.0;  // of the rebound, 1
  // Relative to the exact spin of the rebound that was reached: where the sphere slides throughout,
  // and where it rolls at the end.
  double sliding = 0.0, rolling = 0.0;
};

struct BlowModel {
  const char* name;
  const char* shared;  // with the closed form
  std::function<Trajectory(const scene::Scene&)> run;
  BlowError limit;
};

void PrintTo(const BlowModel& model, std::ostream* out) { *out << model.name; }

auto by_native(scene::Integrator integrator) {
  return [integrator](const scene::Scene& s) { return run_with(s, integrator, kBlowStep); };
}
auto by_mujoco(scene::ContactModel contact) {
  return [contact](const scene::Scene& s) { return mujoco_run(s, contact); };
}

// The soft models take an impact for several steps: their restitution is that of the damper to some
// per cent, and their contact point lies up to 6 um nearer to the centre, which is their error in
// the spin.
const BlowModel kBlowModels[] = {
    {"native `event`", "the law", run_event, {1e-12, 1e-12, 1e-12}},
    {"native `verlet`", "the law", by_native(scene::Integrator::kVerlet), {1e-12, 1e-12, 1e-12}},
    {"native `euler`", "the law", by_native(scene::Integrator::kEuler), {1e-5, 1e-5, 1e-5}},
    {"MuJoCo `rigid`", "the law", by_mujoco(scene::ContactModel::kRigid), {1e-10, 1e-10, 1e-10}},
    {"MuJoCo `coulomb`",
     "friction by slip",
     by_mujoco(scene::ContactModel::kCoulomb),
     {0.05, 2.5e-3, 2.5e-3}},
    {"MuJoCo `cone-coulomb`",
     "nothing",
     by_mujoco(scene::ContactModel::kConeCoulomb),
     {0.08, 2.5e-3, 2.5e-3}},
    {"MuJoCo `cone`", "nothing", by_mujoco(scene::ContactModel::kCone), {10.0, 10.0, 10.0}},
};

class ObliqueImpacts : public MujocoTest, public testing::WithParamInterface<BlowModel> {};

TEST_P(ObliqueImpacts, AreAsFarFromTheClosedFormAsSaid) {
  const BlowModel& model = GetParam();
  BlowError apart;
  for (const double angle : oracle::kObliqueAngles) {
    for (const double restitution : oracle::kObliqueRestitutions) {
      ObliqueImpact x;
      x.angle = angle * std::numbers::pi / 180.0;
      x.restitution = restitution;
      const Trajectory t = model.run(scene_of(x));
      ASSERT_EQ(t.status, Status::kOk) << t.message;
      ObliqueImpact exact = x;
      exact.restitution = t.statistics.impulse_total / (x.mass() * x.normal_speed()) - 1.0;
      apart.restitution = std::max(apart.restitution, std::abs(exact.restitution - restitution));
      // Friction on the rotor is against +y, so its spin is negative.
      const double spin = -t.column("spin_speed").back();
      double& error = exact.rolls() ? apart.rolling : apart.sliding;
      error = std::max(error, std::abs(spin / exact.spin_after() - 1.0));
    }
  }
  std::printf("| %s | %s | %.1e | %.1e | %.1e |\n", model.name, model.shared, apart.restitution,
              apart.sliding, apart.rolling);
  EXPECT_LT(apart.restitution, model.limit.restitution);
  EXPECT_LT(apart.sliding, model.limit.sliding);
  EXPECT_LT(apart.rolling, model.limit.rolling);
}

INSTANTIATE_TEST_SUITE_P(Models, ObliqueImpacts, testing::ValuesIn(kBlowModels));

}  // namespace
}  // namespace rotorub::test
