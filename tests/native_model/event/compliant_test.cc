// Compliant contacts by `event`, against closed forms and a program written from the equations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "native_model/contact/compliance.h"
#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/oracles/compliant_touch.h"
#include "tests/support/order.h"

namespace rotorub {
namespace {

using test::Jeffcott;
using test::make_scene;
using test::run_event;

scene::Scene thrown(const Jeffcott& rotor, const Compliance& compliance, double speed) {
  scene::Scene s = make_scene(rotor);
  s.first().contact->compliance = compliance;
  s.initial.vx = {speed};
  // One touch, before the rotor reaches the other side.
  const double e = std::max(s.first().contact->restitution, 0.01);
  s.run.end = rotor.clearance / speed * (1.0 + 1.9 / e);
  return s;
}

// Of a mass on the spring k p^n at v: the depth and the force where all of its energy is in it, and
// the time from touch to release, 2 (p/v) integral of du / sqrt(1 - u^(n+1)) from 0 to 1.
struct Undamped {
  double depth, force, time;
};
Undamped undamped(double mass, double k, double n, double v) {
  const double depth = std::pow(0.5 * (n + 1.0) * mass * v * v / k, 1.0 / (n + 1.0));
  const double of_time = std::sqrt(std::numbers::pi) * std::tgamma(1.0 / (n + 1.0)) /
                         ((n + 1.0) * std::tgamma(1.0 / (n + 1.0) + 0.5));
  return {depth, k * std::pow(depth, n), 2.0 * depth / v * of_time};
}

TEST(CompliantContact, TheUndampedSpringsPeakAndTime) {
  for (const double n : {1.0, 1.25, 1.5, 2.0}) {
    const Jeffcott rotor{.restitution = 1.0};
    const double v = 0.3, k = 1e7 * std::pow(1e-4, 1.0 - n);
    const scene::Scene s = thrown(rotor, {.stiffness = k, .exponent = n}, v);
    const Trajectory t = run_event(s);
    const Undamped exact = undamped(rotor.mass, k, n, v);
    ASSERT_EQ(t.impacts.size(), 1u) << n;
    EXPECT_NEAR(t.statistics.peak_force / exact.force, 1.0, 1e-9) << n;
    EXPECT_NEAR(t.statistics.max_penetration / exact.depth, 1.0, 1e-9) << n;
    EXPECT_NEAR(t.statistics.contact_time / exact.time, 1.0, 1e-9) << n;
    EXPECT_NEAR(t.impacts[0].t, rotor.clearance / v, 1e-13);
    EXPECT_NEAR(t.impacts[0].gap_rate_after, v, 1e-10);
    EXPECT_LT(t.statistics.energy_residual(), 1e-10);
  }
  // Figures from textbooks.
  const Undamped line = undamped(2.0, 1e7, 1.0, 0.3), hertz = undamped(2.0, 1e9, 1.5, 0.3);
  EXPECT_NEAR(line.time, std::numbers::pi * std::sqrt(2.0 / 1e7), 1e-15);
  EXPECT_NEAR(line.force, 0.3 * std::sqrt(1e7 * 2.0), 1e-10);
  EXPECT_NEAR(hertz.time * 0.3 / hertz.depth, 2.9432, 1e-4);
}

TEST(CompliantContact, ReboundsWithTheRestitutionThatIsAsked) {
  for (const double n : {1.0, 1.5, 2.0}) {
    for (const double e : {0.01, 0.1, 0.5, 0.9, 0.99}) {
      const double v = 0.25, k = 1e7 * std::pow(1e-4, 1.0 - n);
      scene::Scene s = thrown({.restitution = e}, {.stiffness = k, .exponent = n}, v);
      const Trajectory fixed = run_event(s);
      ASSERT_EQ(fixed.impacts.size(), 1u) << n << " " << e << " " << fixed.message;
      EXPECT_NEAR(fixed.impacts[0].gap_rate_after, e * v, 1e-9) << n << " " << e;
      test::add_ring(s, 0.7, 0.0, 0.0);  // a free mass too
      const Trajectory ring = run_event(s);
      ASSERT_GE(ring.impacts.size(), 1u) << n << " " << e;
      EXPECT_NEAR(ring.impacts[0].gap_rate_after, e * v, 1e-9) << n << " " << e;
    }
  }
}

TEST(CompliantContact, TheReboundHasALimitAndTheSpeedToo) {
  EXPECT_EQ(CompliantLaw::rebound_of(1.0), 0.0);
  EXPECT_EQ(CompliantLaw::rebound_of(0.0), CompliantLaw::kMostRebound);
  EXPECT_NEAR(CompliantLaw::rebound_of(0.01), 100.0, 1e-10);
  const CompliantLaw law({.stiffness = 1e7}, 0.5);
  EXPECT_EQ(law.a_of_touch(1e-9), law.a_of_touch(CompliantLaw::kLeastSpeed));
  EXPECT_EQ(law.a_of_touch(0.0), 0.0);
  const CompliantLaw given({.stiffness = 1e7, .hunt_crossley = 3.0}, 0.5);
  EXPECT_EQ(given.a_of_touch(1.0), 3.0);
  EXPECT_EQ(given.a_of_touch(0.0), 3.0);
}

// m r'' + k r + (k_c (1 - delta_0/|r|))(1 + i mu) r = F e^{i w t} turns with the force: the
// synchronous rub on a spring, by the amplitude at which the sizes of both sides agree.
TEST(CompliantContact, TheSynchronousRubOnASpring) {
  const Jeffcott rotor{
      .damping = 40.0, .stiffness = 2e5, .friction = 0.12, .restitution = 1.0, .speed = 500.0};
  const double contact = 4e6, w = 500.0, force = 400.0;
  const auto side = [&](double rho) {
    const double n = contact * (1.0 - rotor.clearance / rho);
    return rho * std::complex<double>(rotor.stiffness - rotor.mass * w * w + n,
                                      rotor.damping * w + rotor.friction * n);
  };
  double low = rotor.clearance, high = 2.0 * rotor.clearance;
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (std::abs(side(middle)) < force ? low : high) = middle;
  }
  const double rho = low, phase = std::arg(force / side(rho));
  scene::Scene s = make_scene(rotor);
  s.first().contact->compliance = Compliance{.stiffness = contact};
  test::add_rotating_force(s, force, w, -phase);
  s.initial.x = {rho};
  s.initial.vy = {rho * w};
  s.run.end = 0.05;
  const Trajectory t = run_event(s);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double angle = w * t.column("t")[k];
    ASSERT_NEAR(t.column("rotor_x")[k], rho * std::cos(angle), 1e-12) << k;
    ASSERT_NEAR(t.column("rotor_y")[k], rho * std::sin(angle), 1e-12) << k;
    ASSERT_NEAR(t.column("normal_force")[k], contact * (rho - rotor.clearance), 1e-6);
    ASSERT_NEAR(t.column("friction_force")[k], -0.12 * t.column("normal_force")[k], 1e-9);
  }
  EXPECT_NEAR(t.statistics.contact_time, 0.05, 1e-12);
  EXPECT_LT(t.statistics.energy_residual(), 1e-10);
}

// A free rotor with its own spin, against a program in this test: it slides, sticks and separates.
TEST(CompliantContact, SlipThatStopsWithinATouch) {
  for (const double turned : {0.0, 0.7, 2.5}) {
    for (const double n : {1.0, 1.5}) {
      const oracle::CompliantTouch touch{
          .stiffness = 1e7 * std::pow(1e-4, 1.0 - n), .exponent = n, .a = 0.8, .friction = 0.3};
      scene::Scene s = make_scene({.mass = touch.mass,
                                   .clearance = touch.clearance,
                                   .radius = touch.radius,
                                   .friction = touch.friction,
                                   .speed = 4.0});
      s.rotor.modal->inertia = touch.inertia;
      s.drive = scene::Drive{};
      s.drive->kind = scene::DriveKind::kFree;
      s.first().contact->compliance =
          Compliance{.stiffness = touch.stiffness, .exponent = n, .hunt_crossley = touch.a};
      const std::complex<double> v = std::polar(1.0, turned) * std::complex<double>(0.3, 0.15);
      s.initial.vx = {v.real()};
      s.initial.vy = {v.imag()};
      s.run.end = 4e-3;
      const Trajectory t = run_event(s);
      const oracle::CompliantTouch::State end =
          touch.at(4e-3, {0.0, 0.0, v.real(), v.imag(), 4.0}, 40000);
      const std::size_t last = t.rows() - 1;
      EXPECT_GT(touch.stuck, 0.0) << "the program should stick";
      EXPECT_NEAR(t.column("rotor_x")[last], end[0], 1e-12);
      EXPECT_NEAR(t.column("rotor_y")[last], end[1], 1e-12);
      EXPECT_NEAR(t.column("spin_speed")[last], end[4], 1e-7);
      const auto is_stick = [](const Event& e) { return e.kind == EventKind::kStick; };
      EXPECT_TRUE(std::any_of(t.events.begin(), t.events.end(), is_stick));
      EXPECT_LT(t.statistics.energy_residual(), 1e-9);
    }
  }
}

// The contact ends before the wall is left, because N = k p + c p' reaches 0 inside.
TEST(CompliantContact, ASpringAndADamperLetGoInTheWall) {
  const double m = 2.0, k = 1e7, v = 0.3;
  const double zeta = 0.4, c = 2.0 * zeta * std::sqrt(k * m);
  scene::Scene s = thrown({}, {.stiffness = k, .damping = c}, v);
  s.run.end = 5e-3;
  const Trajectory t = run_event(s);
  ASSERT_EQ(t.impacts.size(), 1u);
  // p = v/w_d e^{-zeta w t} sin(w_d t); p'' = 0 where the force is.
  const double w = std::sqrt(k / m), root = std::sqrt(1.0 - zeta * zeta);
  const double end =
      (std::numbers::pi - std::atan2(2.0 * zeta * root, 1.0 - 2.0 * zeta * zeta)) / (w * root);
  EXPECT_NEAR(t.statistics.contact_time / end, 1.0, 1e-10);
  EXPECT_NEAR(t.impacts[0].gap_rate_after / v,
              std::exp(-zeta / root *
                       (std::numbers::pi - std::atan2(2.0 * zeta * root, 1.0 - 2.0 * zeta * zeta))),
              1e-10);
  EXPECT_GT(t.statistics.peak_force, c * v);  // it begins with the damper's force
}

// With little damping the contact ends just before the wall is left, in less time than a step.
TEST(CompliantContact, ALightDamperLetsGoNextToTheSurface) {
  const double m = 2.0, v = 0.3;
  for (const double k : {1e6, 1e7, 1e8, 1e9}) {
    for (const double c : {0.01, 0.1, 1.0, 3.0, 30.0, 300.0}) {
      scene::Scene s = thrown({}, {.stiffness = k, .damping = c}, v);
      s.run.end = 8e-3;
      const Trajectory t = run_event(s);
      ASSERT_GE(t.impacts.size(), 1u);
      const double zeta = 0.5 * c / std::sqrt(k * m), root = std::sqrt(1.0 - zeta * zeta);
      const double turn = std::numbers::pi - std::atan2(2.0 * zeta * root, 1.0 - 2.0 * zeta * zeta);
      EXPECT_NEAR(t.impacts[0].gap_rate_after / v, std::exp(-zeta / root * turn), 1e-9)
          << k << " " << c;
      // A whole rub: impacts, sliding, slip that stops and begins.
      const Trajectory rub = run_event(test::shipped(
          "bench_ring", {"run.end=0.02", "contact.compliance.stiffness=" + std::to_string(k),
                         "contact.compliance.damping=" + std::to_string(c)}));
      EXPECT_LT(rub.statistics.energy_residual(), 1e-9) << k << " " << c;
    }
  }
}

// The load of a catcher bearing is the force of its own contact, not the sum of both.
TEST(CompliantContact, ThePeakIsOfOneContact) {
  const scene::Scene s = test::shipped("two_catchers", {"run.end=0.02", "run.output_step=1e-5",
                                                        "contact[0].compliance.stiffness=1e8",
                                                        "contact[1].compliance.stiffness=1e7"});
  for (const auto integrator : {scene::Integrator::kEvent, scene::Integrator::kVerlet}) {
    const Trajectory t = test::run_with(s, integrator, 1e-6);
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& force = t.column(k == 0 ? "normal_force" : "contact2_normal_force");
      const double seen = *std::max_element(force.begin(), force.end());
      const double peak = t.statistics.contacts[k].peak_force;
      EXPECT_GE(peak, 0.999 * seen) << k;
      EXPECT_LE(peak, 1.05 * seen) << k;
    }
  }
}

// A rigid and a compliant contact on one shaft. The balance closes, and with a stiff one it tends
// to two rigid ones.
TEST(CompliantContact, BesideARigidOne) {
  scene::Scene s = test::shipped("two_catchers", {"run.end=0.02"});
  const Trajectory rigid = run_event(s);
  double error = 1.0;
  for (const double k : {1e8, 1e10, 1e12}) {
    s.auxiliary[1].contact->compliance = Compliance{.stiffness = k};
    const Trajectory t = run_event(s);
    ASSERT_GT(t.statistics.contacts[0].impulse_total, 0.0);
    ASSERT_GT(t.statistics.contacts[1].impulse_total, 0.0);
    EXPECT_LT(t.statistics.energy_residual(), 1e-9) << k;
    error = std::abs(
        t.statistics.contacts[1].impulse_total / rigid.statistics.contacts[1].impulse_total - 1.0);
  }
  EXPECT_LT(error, 3e-5);
}

// A list in fixed steps, all compliant or one of them rigid: as `event`, of second order.
class SeveralInFixedSteps : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(CompliantContact, SeveralInFixedSteps, testing::Values(0, 1, 2),
                         [](const auto& one) {
                           return one.param == 2 ? "AllCompliant"
                                                 : "Rigid" + std::to_string(one.param + 1);
                         });

TEST_P(SeveralInFixedSteps, AreOfSecondOrder) {
  scene::Scene s =
      test::shipped("two_catchers", {"run.end=0.02", "contact.compliance.stiffness=2e7"});
  if (GetParam() < 2) s.auxiliary[GetParam()].contact->compliance.reset();
  const Trajectory exact = run_event(s);
  ASSERT_GT(exact.statistics.contacts[1].contact_time, 1e-4);
  std::vector<double> errors;
  for (const double h : {2e-6, 1e-6, 5e-7}) {
    const Trajectory t = test::run_with(s, scene::Integrator::kVerlet, h);
    errors.push_back(test::rotor_error(t, exact));
  }
  EXPECT_GT(std::log2(errors.front() / errors.back()) / 2.0, 1.8)
      << errors[0] << " " << errors[1] << " " << errors[2];
}

// k -> infinity: the rigid law, for one contact without slip that would reverse (W_NT = 0).
// Friction that falls too: of a rigid impact it is that of the slips that it runs through.
TEST(CompliantContact, TendsToTheRigidLaw) {
  FrictionLaw falling = 0.1;
  falling.excess = 0.15;
  falling.stribeck_speed = 14.95;
  for (const FrictionLaw& friction : {FrictionLaw(0.1), falling}) {
    scene::Scene s = make_scene({.restitution = 0.6, .speed = 300.0});
    s.first().contact->friction = friction;
    s.initial.vx = {0.4};
    s.initial.vy = {0.1};
    s.run.end = 2.4e-3;
    const Trajectory rigid = run_event(s);
    double before = 0.0;
    for (const double k : {1e9, 1e11, 1e13}) {
      s.first().contact->compliance = Compliance{.stiffness = k};
      const Trajectory t = run_event(s);
      ASSERT_EQ(t.impacts.size(), rigid.impacts.size());
      const Impact &soft = t.impacts[0], &hard = rigid.impacts[0];
      const double error = std::abs(soft.friction_impulse - hard.friction_impulse) +
                           std::abs(soft.normal_impulse - hard.normal_impulse);
      // A touch lasts sqrt(m/k), and moves v sqrt(m/k) along the curved wall: order 1/2 in 1/k.
      if (before > 0.0) {
        EXPECT_NEAR(std::log(before / error) / std::log(100.0), 0.5, 0.05) << k;
      }
      before = error;
    }
  }
}

// Lasting contact is lasting contact of any contact, in `event` and in fixed steps: a short touch
// of one during the rub of another does not interrupt it.
TEST(CompliantContact, LastingContactIsOfAnyContact) {
  const scene::Scene s = test::shipped(
      "two_catchers", {"run.end=0.05", "run.output_step=1e-3", "contact.compliance.stiffness=3e7"});
  const auto lasting = [&](scene::Integrator integrator) {
    const Trajectory t = test::run_with(s, integrator, 2e-6);
    return t.statistics.contact_time - t.statistics.impact_time;
  };
  EXPECT_NEAR(lasting(scene::Integrator::kEvent), lasting(scene::Integrator::kVerlet), 5e-4);
}

// A shaft that does not turn has no speed but its slip, so it sticks when that comes to rest.
TEST(CompliantContact, SlipComesToRestOnAShaftThatDoesNotTurn) {
  for (const char* law : {"{stiffness=1.6e6,damping=0.22}", "{stiffness=1.6e6,hunt_crossley=0.5}",
                          "{stiffness=1.6e6}"}) {
    const auto of = [&](const std::string& speed) {
      return run_event(test::shipped(
          "bench_ring",
          {"drive=none", "force=none", "stator=none", "rotor.speed=" + speed,
           "contact.clearance=0.3mm", "contact.friction=0.41", "gravity={acceleration=[8.7,-60.0]}",
           "initial.vx=[0.078]", "run.end=0.05", std::string("contact.compliance=") + law}));
    };
    const Trajectory still = of("0.0"), turning = of("1e-5");
    EXPECT_LT(test::trajectory_error(still, turning), 1e-7) << law;
    const auto sticks = [](const Trajectory& t) {
      return std::ranges::count_if(t.events,
                                   [](const Event& e) { return e.kind == EventKind::kStick; });
    };
    EXPECT_GT(sticks(still), 0) << law;
    EXPECT_EQ(sticks(still), sticks(turning)) << law;
  }
}

}  // namespace
}  // namespace rotorub
