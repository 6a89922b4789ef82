// A sphere that strikes a plane obliquely (oracles/oblique_impact.h), under the corrected friction
// cone: friction has its whole impulse, whatever the restitution.
#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "mjcf/soft_contact.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/oracles/oblique_impact.h"

namespace rotorub::test {
namespace {

using oracle::ObliqueImpact;

class ObliqueSphere : public HookedTest {
 protected:
  static constexpr double kStep = 1e-6;  // s

  static std::string document(const ObliqueImpact& x, const std::string& custom) {
    const SoftContact soft = soft_contact(x.restitution, kStep);
    const auto text = [](double number) { return std::to_string(number); };
    return R"(<mujoco><option timestep="1e-6" gravity="0 0 0"/><size nuserdata="21"/>
<worldbody><geom name="floor" type="plane" size="1 1 1"/>
<body pos="0 0 )" +
           text(x.radius) + R"("><freejoint/><geom name="ball" type="sphere" size=")" +
           text(x.radius) + "\" density=\"" + text(x.density) + R"("/></body></worldbody>
<contact><pair name="blow" geom1="floor" geom2="ball" condim="3" friction=")" +
           text(x.friction) + " " + text(x.friction) + R"( 0 0 0" solref=")" +
           text(-soft.stiffness) + " " + text(-soft.damping) +
           R"(" solimp="0.9999 0.9999 0.001"/></contact><custom>)" + custom + "</custom></mujoco>";
  }

  struct After {
    double normal, tangential, across;  // m/s
    double spin;                        // rad/s
  };
  static After blow(
      const ObliqueImpact& x, int cone, int solver, double direction,
      const std::string& custom = R"(<text name="rotorub_cone_coulomb_pair" data="blow"/>)") {
    const ModelPointer m = load(document(x, custom));
    m->opt.cone = cone;
    m->opt.solver = solver;
    m->opt.tolerance = 0.0;
    m->opt.iterations = 200;
    const DataPointer d(mj_makeData(m.get()));
    const double c = std::cos(direction), s = std::sin(direction);
    d->qpos[2] += 1e-6;
    d->qvel[0] = x.tangential_speed() * c;
    d->qvel[1] = x.tangential_speed() * s;
    d->qvel[2] = -x.normal_speed();
    for (int k = 0; k < 100; ++k) mj_step(m.get(), d.get());
    mjtNum spin[3];
    mju_rotVecQuat(spin, d->qvel + 3, d->qpos + 3);
    return {d->qvel[2], d->qvel[0] * c + d->qvel[1] * s, d->qvel[1] * c - d->qvel[0] * s,
            spin[1] * c - spin[0] * s};
  }
  // The exact answer for the rebound speed of the run.
  static ObliqueImpact reached(ObliqueImpact x, const After& after) {
    x.restitution = after.normal / x.normal_speed();
    return x;
  }
  static ObliqueImpact at(double degrees, double restitution) {
    ObliqueImpact x;
    x.angle = degrees * std::numbers::pi / 180.0;
    x.restitution = restitution;
    return x;
  }

  // MuJoCo's contact point lies in the middle of the overlap, so the friction's lever is shorter
  // than the radius by half of the depth: by up to 6 um of 2.5 mm at these speeds.
  static constexpr double kLever = 2.5e-3;

  static void for_each_case(const std::vector<double>& angles) {
    for (const int cone : {int{mjCONE_ELLIPTIC}, int{mjCONE_PYRAMIDAL}}) {
      for (const int solver : {int{mjSOL_NEWTON}, int{mjSOL_PGS}}) {
        for (const double angle : angles) {
          for (const double restitution : oracle::kObliqueRestitutions) {
            SCOPED_TRACE(testing::Message() << "cone " << cone << ", solver " << solver << ", "
                                            << angle << " degrees, e " << restitution);
            const ObliqueImpact x = at(angle, restitution);
            const After after = blow(x, cone, solver, 0.0);
            const ObliqueImpact exact = reached(x, after);
            EXPECT_NEAR(exact.restitution, restitution, 0.02);
            EXPECT_NEAR(after.spin, exact.spin_after(), kLever * exact.spin_after());
            EXPECT_NEAR(after.tangential, exact.tangential_speed_after(),
                        kLever * exact.tangential_speed_after());
            EXPECT_NEAR(after.across, 0.0, 1e-6);  // m/s, of the solver's tolerance
          }
        }
      }
    }
  }
};

TEST_F(ObliqueSphere, TheFigureOfTheBenchmark) {
  EXPECT_NEAR(at(60.0, 0.98).spin_after(), 355.2, 0.05);
  EXPECT_NEAR(at(60.0, 0.9).spin_after(), 340.9, 0.05);
  EXPECT_NEAR(at(60.0, 0.8).spin_after(), 322.9, 0.05);
}

TEST_F(ObliqueSphere, SlidingThroughoutItHasTheSpinOfCoulombsLaw) { for_each_case({45.0, 60.0}); }

// During the contact friction must stop the slip, and hold it at 0.
TEST_F(ObliqueSphere, RollingAtTheEndItHasTheSpinOfRolling) { for_each_case({20.0}); }

// The elliptic cone is round.
TEST_F(ObliqueSphere, InAnyDirection) {
  for (const double direction : {0.7, 2.0, -1.0}) {
    const ObliqueImpact x = at(60.0, 0.98);
    const After after = blow(x, mjCONE_ELLIPTIC, mjSOL_NEWTON, direction);
    EXPECT_NEAR(after.spin, reached(x, after).spin_after(), kLever * after.spin) << direction;
    EXPECT_NEAR(after.across, 0.0, 1e-6) << direction;
  }
}

// MuJoCo alone: the friction rows ask for B v_slip, and B is small where e is near 1.
TEST_F(ObliqueSphere, WithoutItMujocoLosesMostOfTheFriction) {
  const ObliqueImpact x = at(60.0, 0.98);
  EXPECT_LT(blow(x, mjCONE_ELLIPTIC, mjSOL_NEWTON, 0.0, "").spin, 0.2 * x.spin_after());
}

}  // namespace
}  // namespace rotorub::test
