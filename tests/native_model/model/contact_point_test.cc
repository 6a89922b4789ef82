// The contact of the assembled system: rates against numerical derivatives, loads against virtual
// power, and the measurements of the controller.
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <array>
#include <cmath>
#include <memory>

#include "native_model/model/actuation.h"
#include "native_model/model/constraint.h"
#include "native_model/model/dynamics.h"
#include "native_model/numerics/linear_solve.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/scene.h"
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
      // The drive that holds the speed does the rest of the friction's work.
      const double held = drive ? 0.0 : m.first().contact->radius * m.speed;
      EXPECT_NEAR(power(0.0, 2.0), 2.0 * (p.slip - held), 1e-10) << "W_T^T v = gdot_T";
    }
  }
}

// Records its measurements and commands a fixed force.
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

// ---------------------------------------------------------------- several contacts
// Contacts of different radii on one rotor, against dense algebra.

Model two_contacts() {
  return prepare(scene::parse_scene(R"(
[run]
end = 0.1
step = 1e-5
[rotor]
speed = 300.0
[rotor.modal]
mass = [2.0, 1.0]
stiffness = [2e5, 4e5]
damping = [40.0, 40.0]
inertia = 1e-3
[drive]
kind = "linear"
gain = 0.5
speed = 300.0
[[contact]]
radius = 0.05
clearance = 5e-4
friction = 0.2
restitution = 0.5
[contact.stator]
mass = 1.0
damping = 200.0
stiffness = 1e5
[[contact]]
shape = [1.0, -0.6]
radius = 0.03
clearance = 4e-4
friction = 0.1
restitution = 0.5
[contact.stator]
mass = 0.5
damping = 100.0
stiffness = 2e5
)",
                                    "made.toml"));
}

// The rows of W^T: gap rate and slip of each contact per unit of each velocity.
Eigen::MatrixXd rate_rows(const Model& m, const State& s,
                          const ContactList<ClosedContact>& closed) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(m.nq());
  Eigen::MatrixXd rows(2 * static_cast<Eigen::Index>(closed.size()), m.nq());
  for (Eigen::Index k = 0; k < rows.rows() / 2; ++k) {
    const std::size_t contact = closed[static_cast<std::size_t>(k)].index;
    const ContactPoint rest = contact_point(m, s.q.data(), none.data(), contact);
    for (int i = 0; i < m.nq(); ++i) {
      const Eigen::VectorXd unit = Eigen::VectorXd::Unit(m.nq(), i);
      const ContactPoint p = contact_point(m, s.q.data(), unit.data(), contact);
      rows(2 * k, i) = p.gap_rate - rest.gap_rate;
      rows(2 * k + 1, i) = p.slip - rest.slip;
    }
  }
  return rows;
}

TEST(DelassusMatrix, OfContactsWithDifferentRadiiAgainstDense) {
  const Model m = two_contacts();
  for (unsigned seed = 0; seed < 10; ++seed) {
    State s = test::random_state(m, seed);
    const std::array<Constraint::Closed, 2> both{{{0}, {1}}};
    const auto closed = closed_points(m, s.q.data(), s.v.data(), both);
    const Eigen::MatrixXd w = rate_rows(m, s, closed);
    const Eigen::MatrixXd exact =
        w * Cholesky(test::mass_matrix(m, s)).solve(Eigen::MatrixXd(w.transpose()));
    const ContactMatrix g = delassus(m, s.t, s.q.data(), closed);
    EXPECT_LT((Eigen::MatrixXd(g) - exact).norm(), 1e-10 * exact.norm());
  }
}

TEST(Constraint, ProjectsContactsOfDifferentRadiiOntoRest) {
  const Model m = two_contacts();
  Constraint constraint(m);
  for (unsigned seed = 0; seed < 10; ++seed) {
    State s = test::random_state(m, seed);
    const std::array<Constraint::Closed, 2> both{
        {{0, Constraint::Velocity::kZero}, {1, Constraint::Velocity::kZero}}};
    constraint.project(s.t, s.q.data(), s.v.data(), both);
    for (const ClosedContact& c : closed_points(m, s.q.data(), s.v.data(), both)) {
      const double speed = c.point.dv.norm() + std::abs(c.point.spin) * 0.05;
      EXPECT_LT(std::abs(c.point.gap_rate) + std::abs(c.point.slip), 1e-11 * (speed + 1.0));
    }
  }
}

}  // namespace
}  // namespace rotorub
