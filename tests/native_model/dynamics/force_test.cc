// Every load of the equations of motion, with its sign, by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "native_model/dynamics/dynamics.h"
#include "native_model/system/actuation.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;

constexpr double kRoundOff = 1e-12;  // relative, of sums of a few products

Eigen::VectorXd smooth(const Model& m, double t, const Eigen::VectorXd& q, const Eigen::VectorXd& v,
                       const Eigen::Vector2d& u = {0.0, 0.0}) {
  // The buffer holds nonsense: every entry must be written.
  Eigen::VectorXd f = Eigen::VectorXd::Constant(m.nq(), std::nan(""));
  smooth_force(m, t, q.data(), v.data(), u, f.data());
  return f;
}

Eigen::VectorXd vec(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  int i = 0;
  for (double x : values) v[i++] = x;
  return v;
}

TEST(SmoothForce, SpringAndDamper) {
  const Model m = make_model(make_scene(Jeffcott{.damping = 40.0, .stiffness = 2e5}));
  const Eigen::VectorXd f = smooth(m, 0.0, vec({1e-3, -2e-3}), vec({0.5, 0.1}));
  EXPECT_DOUBLE_EQ(f[0], -200.0 - 20.0);
  EXPECT_DOUBLE_EQ(f[1], 400.0 - 4.0);
}

TEST(SmoothForce, GyroscopicPartTurnsVelocityIntoForce) {
  scene::Scene s = make_scene(Jeffcott{.speed = 300.0});
  s.rotor.modal->gyroscopic = {0.05};
  const Model m = make_model(s);
  const Eigen::VectorXd none = vec({0.0, 0.0});
  // On x: -Omega g vy, on y: +Omega g vx.
  EXPECT_DOUBLE_EQ(smooth(m, 0.0, none, vec({0.0, 0.2}))[0], -300.0 * 0.05 * 0.2);
  EXPECT_DOUBLE_EQ(smooth(m, 0.0, none, vec({0.2, 0.0}))[1], 300.0 * 0.05 * 0.2);
  // Forward whirl is stiffened, backward whirl softened: at (R, 0) with (0, +-v) the force is
  // towards, and away from, the centre.
  EXPECT_LT(smooth(m, 0.0, none, vec({0.0, 1.0}))[0], 0.0);
  EXPECT_GT(smooth(m, 0.0, none, vec({0.0, -1.0}))[0], 0.0);
}

TEST(SmoothForce, RotatingDampingIsDampingSeenFromTheShaft) {
  const double speed = 300.0, d = 15.0;
  scene::Scene s = make_scene(Jeffcott{.speed = speed});
  s.rotor.modal->internal_damping = {d};
  const Model m = make_model(s);
  // By hand: -d (qdot - Omega e_z x q).
  const Eigen::VectorXd q = vec({1e-3, 2e-3}), v = vec({0.3, -0.1});
  const Eigen::VectorXd f = smooth(m, 0.0, q, v);
  EXPECT_DOUBLE_EQ(f[0], -d * (v[0] + speed * q[1]));
  EXPECT_DOUBLE_EQ(f[1], -d * (v[1] - speed * q[0]));
  // Bent and carried round as a rigid body: nothing.
  const Eigen::VectorXd carried = vec({-speed * q[1], speed * q[0]});
  EXPECT_NEAR(smooth(m, 0.0, q, carried).norm(), 0.0, kRoundOff * d * carried.norm());
  // Forward whirl slower than the shaft is fed, faster is braked: the source of the instability.
  EXPECT_GT(smooth(m, 0.0, q, 0.9 * carried).dot(carried), 0.0);
  EXPECT_LT(smooth(m, 0.0, q, 1.1 * carried).dot(carried), 0.0);
}

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

TEST(SmoothForce, CouplingIsWhatASpringDamperChainLacks) {
  for (const bool drive : {true, false}) {
    const Model m = test::machine(drive);
    const State s = test::random_state(m, 3);
    const Eigen::Vector2d u{7.0, -3.0};
    Eigen::VectorXd coupling(m.nq()), load(m.nq());
    coupling_force(m, s.t, s.q.data(), s.v.data(), coupling.data());
    load_force(m, s.t, s.q.data(), s.v.data(), load.data());
    Eigen::VectorXd expected =
        coupling - m.stiffness.cwiseProduct(s.q) - m.damping.cwiseProduct(s.v);
    expected.segment<2>(m.layout.ring()) += u;
    const Eigen::VectorXd f = smooth(m, s.t, s.q, s.v, u);
    EXPECT_LT((f - expected).norm(), kRoundOff * f.norm());
    // Without the gyroscopic part; that does no work.
    EXPECT_NEAR((coupling - load).dot(s.v), 0.0, kRoundOff * coupling.norm() * s.v.norm());
    EXPECT_GT((coupling - load).head(4).norm(), 0.0);
    EXPECT_EQ((coupling - load).tail(m.nq() - 4).norm(), 0.0);
  }
}

TEST(SmoothForce, MagneticBearingPullsAway) {
  scene::Scene s = make_scene({});
  s.rotor.modal->mass = {2.0, 1.0};
  s.rotor.modal->stiffness = s.rotor.modal->damping = {0.0, 0.0};
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {0.5, -2.0}, 1000.0}};
  const Model m = make_model(s);
  // Deflection 0.5 * 2e-3 - 2 * 1e-3 = -1e-3 in x: 1 N towards -x, through the shape (0.5, -2).
  const Eigen::VectorXd f = smooth(m, 0.0, vec({2e-3, 1e-3, 0.0, 0.0}), Eigen::VectorXd::Zero(4));
  EXPECT_DOUBLE_EQ(f[0], -0.5);
  EXPECT_DOUBLE_EQ(f[1], 2.0);
  EXPECT_EQ(f[2], 0.0);
  EXPECT_EQ(f[3], 0.0);
}

TEST(SmoothForce, DriveActsThroughTheTorsionShapes) {
  scene::Scene s = test::machine_scene(true);
  s.drive->kind = scene::DriveKind::kKloss;
  s.drive->breakdown_torque = 8.0;
  s.drive->breakdown_slip = 0.2;
  s.drive->synchronous_speed = 320.0;
  s.forces.clear();
  const Model m = make_model(s);
  const Layout& l = m.layout;
  Eigen::VectorXd q = Eigen::VectorXd::Zero(m.nq()), v = q;
  v[l.phi()] = 300.0;
  v[l.theta()] = 10.0;
  v[l.theta() + 1] = 4.0;
  // At the motor: 300 + 0.3 * 10 - 0.5 * 4 = 301 rad/s.
  const double torque = Drive(*s.drive).torque(301.0);
  const Eigen::VectorXd f = smooth(m, 0.0, q, v);
  EXPECT_DOUBLE_EQ(f[l.phi()], torque);
  EXPECT_DOUBLE_EQ(f[l.theta()], 0.3 * torque - 0.01 * 10.0);
  EXPECT_DOUBLE_EQ(f[l.theta() + 1], -0.5 * torque - 0.02 * 4.0);
}

TEST(SmoothForce, UnbalanceTurnsWithThePrescribedSpin) {
  Model m = make_model(make_scene(Jeffcott{.speed = 200.0}));
  m.spin_angle = 0.25;
  m.unbalances = {{{vec({0.5}), vec({2.0})}, 3e-5, 0.7}};
  const Eigen::VectorXd none = vec({0.0, 0.0});
  const double t = 0.013, angle = 0.25 + 200.0 * t + 0.7;
  const Eigen::VectorXd f = smooth(m, t, none, none);
  EXPECT_DOUBLE_EQ(f[0], 0.5 * 3e-5 * 200.0 * 200.0 * std::cos(angle));
  EXPECT_DOUBLE_EQ(f[1], 2.0 * 3e-5 * 200.0 * 200.0 * std::sin(angle));
}

TEST(SmoothForce, GravityPullsOnModesAndRing) {
  scene::Scene s = make_scene({});
  test::add_ring(s, 1.5, 0.0, 0.0);
  s.gravity = scene::Gravity{{0.0, -9.81}, {1.9}};
  const Model m = make_model(s);
  const Eigen::VectorXd f = smooth(m, 0.0, Eigen::VectorXd::Zero(4), Eigen::VectorXd::Zero(4));
  EXPECT_EQ(f, vec({0.0, 1.9 * -9.81, 0.0, 1.5 * -9.81}));
  s.gravity->participation.clear();  // a mode then weighs what it is
  EXPECT_DOUBLE_EQ(make_model(s).weight[1], 2.0 * -9.81);
}

}  // namespace
}  // namespace rotorub
