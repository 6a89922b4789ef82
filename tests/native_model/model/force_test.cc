// Loads of the equations of motion, with their signs, by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

using test::make_scene;

constexpr double kRoundOff = 1e-12;  // relative, of sums of a few products

TEST(SmoothForce, FullMatricesKeepTheirSides) {
  // x: Omega g y', Omega D_xy y; y: -Omega g^T x', -Omega D_xy^T x on the left side of (1).
  const Model m = test::machine(false);
  const Eigen::Matrix2d g = m.gyroscopic.dense(2), xx = m.internal_xx.dense(2),
                        xy = m.internal_xy.dense(2), yy = m.internal_yy.dense(2);
  const State s = test::random_state(m, 1), o = test::random_state(m, 2);
  // The difference of two states leaves the loads that do not depend on q, v.
  const auto coupling = [&](const State& at) {
    Eigen::VectorXd f(m.nq());
    coupling_force(m, 0.0, at.q.data(), at.v.data(), f.data());
    return f;
  };
  const Eigen::Vector4d dq = (s.q - o.q).head<4>(), dv = (s.v - o.v).head<4>();
  Eigen::Vector4d expected;
  expected.head<2>() = -m.speed * (g * dv.tail<2>() + xy * dq.tail<2>()) - xx * dv.head<2>();
  expected.tail<2>() =
      m.speed * (g.transpose() * dv.head<2>() + xy.transpose() * dq.head<2>()) - yy * dv.tail<2>();
  for (int plane = 0; plane < 2; ++plane) {
    const StationDamper& b = m.dampers[0];
    const StationSpring& k = m.springs[0];
    const Eigen::VectorXd& damper = plane == 0 ? b.shape.x : b.shape.y;
    const Eigen::VectorXd& spring = plane == 0 ? k.shape.x : k.shape.y;
    expected.segment<2>(2 * plane) -=
        b.damping[plane] * damper * damper.dot(dv.segment<2>(2 * plane)) +
        k.stiffness[plane] * spring * spring.dot(dq.segment<2>(2 * plane));
  }
  const Eigen::Vector4d actual = (coupling(s) - coupling(o)).head<4>();
  EXPECT_LT((actual - expected).norm(), kRoundOff * expected.norm());
}

TEST(SmoothForce, GravityPullsOnModesAndRing) {
  scene::Scene s = make_scene({});
  test::add_ring(s, 1.5, 0.0, 0.0);
  s.gravity = scene::Gravity{{0.0, -9.81}, {1.9}};
  const Model m = prepare(s);
  // The buffer contains garbage, so every entry must be written.
  Eigen::Vector4d rest = Eigen::Vector4d::Zero(), f = Eigen::Vector4d::Constant(std::nan(""));
  smooth_force(m, 0.0, rest.data(), rest.data(), {0.0, 0.0}, f.data());
  EXPECT_EQ(f, Eigen::Vector4d(0.0, 1.9 * -9.81, 0.0, 1.5 * -9.81));
  s.gravity->participation.clear();  // a mode then weighs what it is
  EXPECT_DOUBLE_EQ(prepare(s).weight[1], 2.0 * -9.81);
}

// ---------------------------------------------------------------- applied forces
// Forces in time: constant and rotating, on, off and ramp.

AppliedForce constant(double on, double off, double ramp) {
  return {scene::ForceKind::kConstant, 0.0, 0.0, 0.0, {4.0, -2.0}, on, off, ramp, {}};
}

TEST(AppliedForce, ActsFromOnToBeforeOff) {
  const AppliedForce f = constant(0.1, 0.3, 0.0);
  const double just = std::numeric_limits<double>::infinity();
  EXPECT_EQ(f.at(std::nextafter(0.1, -just), 0.0), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(f.at(0.1, 0.0), Eigen::Vector2d(4.0, -2.0));
  EXPECT_EQ(f.at(std::nextafter(0.3, -just), 0.0), Eigen::Vector2d(4.0, -2.0));
  EXPECT_EQ(f.at(0.3, 0.0), Eigen::Vector2d(0.0, 0.0));
}

TEST(AppliedForce, RampsUpLinearlyAndDropsAtOnce) {
  const AppliedForce f = constant(0.1, 0.5, 0.2);
  EXPECT_EQ(f.envelope(0.1), 0.0);
  EXPECT_NEAR(f.envelope(0.15), 0.25, 1e-15);
  EXPECT_NEAR(f.envelope(0.3), 1.0, 1e-15);
  EXPECT_EQ(f.envelope(0.4999), 1.0);
  EXPECT_EQ(f.envelope(0.5), 0.0);
  // The force is switched off within the ramp, before its full value.
  EXPECT_NEAR(constant(0.1, 0.2, 0.4).envelope(0.1999999), 0.25, 1e-6);
}

}  // namespace
}  // namespace rotorub
