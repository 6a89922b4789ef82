// The contact of the assembled system: signs against numerical derivatives, loads against virtual
// power, and the controller's way to the ring.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "native_model/dynamics/dynamics.h"
#include "native_model/system/actuation.h"
#include "tests/support/jeffcott.h"
#include "tests/support/machine.h"
#include "tests/support/runge_kutta.h"

namespace rotorub {
namespace {

// The state with the coordinates carried on by v for the time h.
ContactPoint moved(const Model& m, const State& s, double h) {
  const Eigen::VectorXd q = s.q + h * s.v;
  return contact_point(m, q.data(), s.v.data());
}

TEST(ContactPoint, RatesAreTheDerivatives) {
  for (const bool drive : {true, false}) {
    const Model m = test::machine(drive);
    for (unsigned seed = 30; seed < 40; ++seed) {
      const State s = test::random_state(m, seed);
      const ContactPoint p = contact_point(m, s.q.data(), s.v.data());
      const double h = 1e-7;  // v h is 1e-4 of the distance: second differences to 1e-8
      const ContactPoint before = moved(m, s, -h), after = moved(m, s, h);
      const double tolerance = 1e-6 * p.dv.norm() * (1e-4 / p.delta);
      EXPECT_NEAR(p.gap_rate, (after.gap - before.gap) / (2 * h), tolerance);
      // Slip: the speed of the contact point on the rotor's rim along e_t, of which the rim's own
      // turning is r times the spin with torsion, and the rest the orbit.
      double turned = 0.0;
      const Layout& l = m.layout;
      turned += l.spin ? s.v[l.phi()] : m.speed;
      turned += s.v[l.theta()] + s.v[l.theta() + 1];
      const double angle =
          std::asin((before.e_r.x() * after.e_r.y() - before.e_r.y() * after.e_r.x()));
      EXPECT_NEAR(p.slip, p.delta * angle / (2 * h) + 0.05 * turned, tolerance);
    }
  }
}

TEST(ContactPoint, SignsByHand) {
  // Ring at (1, 0) mm, rotor at (1.3, 0) mm: the normal is +x, 0.2 mm are left of 0.5.
  scene::Scene s = test::make_scene({.speed = 100.0});
  test::add_ring(s, 1.0, 0.0, 0.0);
  const Model m = make_model(s);
  const Eigen::Vector4d q{1.3e-3, 0.0, 1.0e-3, 0.0}, v{0.4, 0.2, 0.1, -0.1};
  const ContactPoint p = contact_point(m, q.data(), v.data());
  EXPECT_EQ(p.e_r, Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(p.e_t(), Eigen::Vector2d(0.0, 1.0));
  EXPECT_NEAR(p.gap, 0.2e-3, 1e-18);
  EXPECT_DOUBLE_EQ(p.gap_rate, -(0.4 - 0.1)) << "outward is closing";
  EXPECT_DOUBLE_EQ(p.slip, 0.2 + 0.1 + 0.05 * 100.0);
}

TEST(ContactPoint, CentresTogetherHaveNoNormal) {
  const Model m = make_model(test::make_scene({.speed = 100.0}));
  const Eigen::Vector2d q{0.0, 0.0}, v{0.3, -0.4};
  const ContactPoint p = contact_point(m, q.data(), v.data());
  EXPECT_FALSE(p.has_normal);
  EXPECT_EQ(p.gap, 0.5e-3);
  EXPECT_EQ(p.gap_rate, 0.0);
  EXPECT_EQ(p.slip, 0.05 * 100.0);
}

TEST(ContactLoad, DoesTheVirtualPowerOfGapRateAndSlip) {
  for (const bool drive : {true, false}) {
    const Model m = test::machine(drive);
    const State s = test::random_state(m, 41);
    for (unsigned seed = 0; seed < 10; ++seed) {
      const Eigen::VectorXd v = test::random_state(m, 50 + seed).v;
      const ContactPoint p = contact_point(m, s.q.data(), v.data());
      const auto power = [&](double normal, double friction) {
        Eigen::VectorXd f = Eigen::VectorXd::Zero(m.nq());
        add_contact_load(m, contact_load(p.e_r, m.first().contact->radius, normal, friction),
                         f.data());
        return f.dot(v);
      };
      EXPECT_NEAR(power(3.0, 0.0), 3.0 * p.gap_rate, 1e-12) << "W_N^T v = gdot_N";
      // Whatever holds the speed does the rest of the friction's work.
      const double held = drive ? 0.0 : m.first().contact->radius * m.speed;
      EXPECT_NEAR(power(0.0, 2.0), 2.0 * (p.slip - held), 1e-10) << "W_T^T v = gdot_T";
    }
  }
}

TEST(ContactLoad, IsAddedAndActsOnTheRingInReverse) {
  const Model m = test::machine(true);
  const Layout& l = m.layout;
  Eigen::VectorXd f = Eigen::VectorXd::Constant(m.nq(), 10.0);
  add_contact_load(m, {3.0, -4.0, 0.5}, f.data());
  EXPECT_EQ(f.segment<2>(l.ring()), Eigen::Vector2d(7.0, 14.0));
  EXPECT_EQ(f.segment<2>(l.x()), Eigen::Vector2d(13.0, 13.0));
  EXPECT_EQ(f.segment<2>(l.y()), Eigen::Vector2d(6.0, 6.0));
  EXPECT_EQ(f[l.phi()], 10.5);
}

TEST(Actuator, LimitsEachOfItsAxesAt45Degrees) {
  const double h = std::sqrt(0.5);
  const Eigen::Vector2d a1{h, h}, a2{-h, h};
  const auto near = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - b).norm() < 1e-12;
  };
  EXPECT_TRUE(near(limited(900.0 * a1, 600.0), 600.0 * a1));
  EXPECT_TRUE(near(limited(-900.0 * a2, 600.0), -600.0 * a2));
  EXPECT_TRUE(near(limited(900.0 * a1 + 100.0 * a2, 600.0), 600.0 * a1 + 100.0 * a2))
      << "an axis at its limit leaves the other alone";
  // Along x both axes share: more than the limit of one is possible.
  EXPECT_TRUE(near(limited({800.0, 0.0}, 600.0), {800.0, 0.0}));
  EXPECT_TRUE(near(limited({1e9, 0.0}, 600.0), {600.0 * std::sqrt(2.0), 0.0}));
  const double none = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(near(limited({123.0, -45.0}, none), {123.0, -45.0}));
}

// Keeps what it was shown and asks for a fixed force.
struct Spy final : Controller {
  mutable Measurement seen;
  mutable int calls = 0;
  bool acceleration = true;
  Eigen::Vector2d command(const Measurement& measurement, const SwitchOn&, double*) const override {
    seen = measurement;
    ++calls;
    return {1e9, 0.0};
  }
  bool needs_rotor_acceleration() const override { return acceleration; }
};

TEST(ControlForce, ShowsTheLawTheStateAndTheContactFreeAcceleration) {
  Model m = test::machine(true);
  const auto spy = std::make_shared<Spy>();
  m.first().controller = spy;
  m.first().control_on = 0.02;
  m.first().force_limit = 600.0;
  State s = test::random_state(m, 60);
  s.t = 0.0199;
  EXPECT_EQ(control_command(m, s.t, s.q.data(), s.v.data()), Eigen::Vector2d(0.0, 0.0));
  EXPECT_EQ(spy->calls, 0) << "not asked before it is on";
  s.t = 0.02;
  const Eigen::Vector2d u = control_command(m, s.t, s.q.data(), s.v.data());
  EXPECT_NEAR(u.x(), 600.0 * std::sqrt(2.0), 1e-9) << "limited by the actuator";
  const Measurement& seen = spy->seen;
  EXPECT_EQ(seen.t, 0.02);
  EXPECT_EQ(seen.rotor, rotor_point(m, s.q.data()));
  EXPECT_EQ(seen.stator_velocity, s.v.segment<2>(m.layout.ring()));
  EXPECT_EQ(seen.spin_speed, s.v[m.layout.phi()]);
  // The acceleration, from the velocity a moment later and a moment before.
  const int n = m.nq();
  const auto rate = [&](double t, const Eigen::VectorXd& y) {
    Eigen::VectorXd dy(2 * n);
    dy.head(n) = y.tail(n);
    smooth_force(m, t, y.data(), y.data() + n, {0.0, 0.0}, dy.data() + n);
    solve_mass(m, t, y.data(), dy.data() + n, dy.data() + n);
    return dy;
  };
  Eigen::VectorXd y(2 * n);
  y << s.q, s.v;
  const double h = 1e-6;
  const Eigen::VectorXd dv =
      (test::runge_kutta(rate, s.t, h, y) - test::runge_kutta(rate, s.t, -h, y)).tail(n) / (2 * h);
  const Eigen::Vector2d a = rotor_point(m, dv.data());
  EXPECT_LT((seen.rotor_acceleration - a).norm(), 1e-5 * a.norm());
}

TEST(ControlForce, APassiveBearingHasNone) {
  const Model m = test::machine(true);
  const State s = test::random_state(m, 61);
  EXPECT_EQ(control_command(m, s.t, s.q.data(), s.v.data()), Eigen::Vector2d(0.0, 0.0));
}

}  // namespace
}  // namespace rotorub
