// The linear laws against their closed-loop poles, in whole runs: a released ring decays with them.
#include <gtest/gtest.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "native_model/control/radial_tracking.h"
#include "native_model/control/ring_feedback.h"
#include "native_model/linear/rub_stability.h"
#include "native_model/model/dynamics.h"
#include "native_model/model/linear_plant.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/run_native.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

using Complex = std::complex<double>;

// Two modes on a ring, no load, the contact out of reach.
scene::Scene plain_scene() {
  scene::Scene s;
  s.name = "plain";
  s.rotor.speed = 314.0;
  scene::RotorModal modal;
  modal.mass = {2.0, 0.8};
  modal.stiffness = {2e5, 3e6};
  modal.damping = {40.0, 60.0};
  modal.gyroscopic = {0.05, -0.02};
  modal.internal_damping = {5.0, 0.0};
  s.rotor.modal = modal;
  s.first().contact = scene::Contact{};
  s.first().contact->radius = 0.05;
  s.first().contact->clearance = 0.01;
  s.first().stator = scene::Stator{};
  s.first().stator->mass = {1.5, 1.5};
  s.first().stator->damping = {30.0, 30.0};
  s.first().stator->stiffness = {2e5, 2e5};
  s.first().controller = scene::Controller{};
  s.run.end = 0.02;
  s.run.output_step = 1e-3;
  return s;
}

// ------------------------------------------------------------------ cross-coupled feedback

TEST(CrossCoupled, DoesNoWorkAndTurnsWithTheSpin) {
  scene::Controller c;
  c.feedback = {1000.0, 2000.0};
  c.feedback_speed = {100.0, 300.0};
  const CrossCoupled law(c);
  Measurement m;
  m.stator_velocity = {0.3, -0.7};
  m.spin_speed = 200.0;
  const Eigen::Vector2d u = law.command(m, {}, nullptr);
  EXPECT_NEAR(u.dot(m.stator_velocity), 0.0, 1e-12);
  EXPECT_EQ(u, Eigen::Vector2d(1500.0 * -0.7, -1500.0 * 0.3)) << "-k e_z x v, k between the two";
  m.spin_speed = -200.0;
  EXPECT_EQ(law.command(m, {}, nullptr), -u);
  EXPECT_EQ(law.gain(50.0), 1000.0);
  EXPECT_EQ(law.gain(-900.0), 2000.0);
}

// z'' m + (d + i k) z' + K z = 0: the ring's two whirls, each with its own decay.
TEST(CrossCoupled, RingDecaysAsItsClosedLoopPoles) {
  scene::Scene s = plain_scene();
  s.first().controller->kind = scene::ControllerKind::kCrossCoupled;
  s.first().controller->feedback = {900.0};
  const rub::RubSystem system = rub::rub_system(s);
  const auto poles = rub::ring_eigenvalues(system);
  ASSERT_EQ(poles.size(), 2u);
  for (const Complex& p : poles) {
    EXPECT_LT(std::abs(1.5 * p * p + Complex(30.0, 900.0) * p + 2e5), 1e-6);
    // Released in that whirl, it moves as z = a e^{p t}.
    const double a = 1e-4;
    s.first().stator->position = {a, 0.0};
    s.first().stator->velocity = {a * p.real(), a * p.imag()};
    const Trajectory t = test::complete(run_native(s));
    const Complex wanted = a * std::exp(p * s.run.end);
    EXPECT_NEAR(t.column("stator_x").back(), wanted.real(), 1e-9 * a);
    EXPECT_NEAR(t.column("stator_y").back(), wanted.imag(), 1e-9 * a);
  }
}

// ------------------------------------------------------------------ tracking

// A ring before a rotor at rest at X, with a constant wanted gap: M x'' + (D + damping) x' + K x =
// stiffness (X - x).
TEST(TrackingPd, ErrorDecaysAsItsClosedLoopPoles) {
  scene::Scene s = plain_scene();
  s.rotor.modal->mass = {1e12, 1e12};  // at rest
  s.rotor.modal->damping = {0.0, 0.0};
  s.rotor.modal->stiffness = {1e-6, 1e-6};
  s.first().controller->kind = scene::ControllerKind::kPd;
  s.first().controller->stiffness = 4e5;
  s.first().controller->damping = 500.0;
  s.first().controller->preload = 0.0;
  s.first().controller->gap_time = 1e6;
  s.initial.x = {0.5e-3, 0.5e-3};
  s.first().stator->position = {2e-4, 0.0};
  s.run.end = 0.006;
  const Trajectory t = test::complete(run_native(s));
  const double rest = 4e5 / 6e5 * 1e-3, e = 2e-4 - rest;
  const Complex root = std::sqrt(Complex(530.0 * 530.0 - 4.0 * 1.5 * 6e5, 0.0));
  const Complex p = (-530.0 + root) / 3.0, q = (-530.0 - root) / 3.0;
  const Complex a = -q * e / (p - q), b = e - a;
  for (std::size_t row = 1; row <= 6; ++row) {
    const double later = 1e-3 * static_cast<double>(row);
    EXPECT_NEAR(t.column("stator_x")[row] - rest,
                (a * std::exp(p * later) + b * std::exp(q * later)).real(), 1e-8 * std::abs(e))
        << row;
  }
}

// ------------------------------------------------------------------ LQR, LQG

scene::Scene quadratic_scene(scene::ControllerKind kind) {
  scene::Scene s = plain_scene();
  s.first().controller->kind = kind;
  s.first().controller->sample_time = 1e-4;
  s.run.output_step = 1e-4;
  return s;
}

TEST(LinearPlant, IsTheModelWithoutContact) {
  const scene::Scene s = quadratic_scene(scene::ControllerKind::kPassive);
  const Model m = prepare(s);
  const LinearPlant p = plant_of(m, 0, s.rotor.speed);
  ASSERT_EQ(p.a.rows(), 12);
  Eigen::VectorXd q = Eigen::VectorXd::Random(m.nq()), v = Eigen::VectorXd::Random(m.nq());
  Eigen::VectorXd f(m.nq()), x(12);
  unactuated_force(m, 0.0, q.data(), v.data(), f.data());
  solve_mass(m, 0.0, q.data(), f.data(), f.data());
  x << q, v;
  const Eigen::VectorXd rates = p.a * x;
  EXPECT_LT((rates.head(6) - v).norm(), 1e-14 * v.norm());
  EXPECT_LT((rates.tail(6) - f).norm(), 1e-12 * f.norm());
  EXPECT_LT((p.c.topRows(2) * x - rotor_point(m, q.data())).norm(), 1e-15);
  EXPECT_LT((p.c.bottomRows(2) * x - stator_point(m, q.data())).norm(), 1e-15);
  // A step of the sampled plant is the flow of the continuous one: exp over two halves.
  const LinearPlant once = sampled(p, 2e-4), half = sampled(p, 1e-4);
  EXPECT_LT((half.a * half.a - once.a).norm(), 1e-12 * once.a.norm());
  EXPECT_LT((half.a * half.b + half.b - once.b).norm(), 1e-12 * once.b.norm());
}

// After the release it moves as x_{k+1} = (A - B K) x_k, as in a whole run.
TEST(Lqr, ARunIsItsClosedLoop) {
  scene::Scene s = quadratic_scene(scene::ControllerKind::kLqr);
  s.initial.x = {1e-4, 2e-5};
  s.first().stator->position = {-1e-4, 5e-5};
  const Model m = prepare(s);
  const QuadraticDesign d = quadratic_design(s, 0, plant_of(m, 0, s.rotor.speed));
  Eigen::VectorXd x(12);
  x << m.q0, m.v0;
  const Trajectory t = test::complete(run_native(s));
  for (std::size_t k = 0; k <= 200; ++k) {
    ASSERT_NEAR(t.column("stator_x")[k], x[4], 1e-13) << k;
    ASSERT_NEAR(t.column("rotor_x")[k], x[0] + x[1], 1e-13) << k;
    x = ((d.plant.a - d.plant.b * d.gain) * x).eval();
  }
}

// A ring whose centre is off the rotor's line moves to the rotor and stays about it, against its
// springs.
TEST(LqrLqg, StandAboutTheRotorWhereTheRingIsOffset) {
  for (const scene::ControllerKind kind :
       {scene::ControllerKind::kLqr, scene::ControllerKind::kLqg}) {
    scene::Scene s = quadratic_scene(kind);
    s.first().contact->offset = {2e-4, -1e-4};
    s.run.end = 1.0;
    const Trajectory t = test::complete(run_native(s));
    EXPECT_NEAR(t.column("gap").back(), s.first().contact->clearance, 1e-9);
    EXPECT_NEAR(t.column("control_x").back(), -2e5 * 2e-4, 1e-3);
    EXPECT_NEAR(t.column("control_y").back(), 2e5 * 1e-4, 1e-3);
  }
}

// ---------------------------------------------------------------- radial tracking
// The wanted gap: its ends, its smoothness, and that it is never closed before its time.

constexpr double kGap = 0.5e-3, kTime = 0.008;
const SwitchOn kAtRest{0.1, kGap, 0.0};

TEST(GapReference, FallsFromTheGapAtSwitchOnToZero) {
  EXPECT_EQ(gap_reference(kAtRest, 0.0, kTime).gap, kGap);
  EXPECT_EQ(gap_reference(kAtRest, 0.1, kTime).gap, kGap);
  EXPECT_NEAR(gap_reference(kAtRest, 0.104, kTime).gap, 0.5 * kGap, 1e-15);
  EXPECT_NEAR(gap_reference(kAtRest, 0.108, kTime).gap, 0.0, 1e-18);
  EXPECT_NEAR(gap_reference(kAtRest, 5.0, kTime).gap, 0.0, 1e-18);
  EXPECT_EQ(gap_reference(kAtRest, 5.0, kTime).share, 1.0);
  double last = kGap;
  for (double t = 0.1; t < 0.109; t += 1e-5) {
    const GapReference r = gap_reference(kAtRest, t, kTime);
    ASSERT_LE(r.gap, last);
    ASSERT_LE(r.rate, 0.0);
    last = r.gap;
  }
}

void expect_smooth(const SwitchOn& on, double from) {
  const double h = 1e-7, speed = kGap / kTime, acceleration = speed / kTime;
  for (double t = from; t < 0.109; t += 1.3e-5) {
    const auto before = gap_reference(on, t - h, kTime), now = gap_reference(on, t, kTime),
               after = gap_reference(on, t + h, kTime);
    ASSERT_NEAR(now.rate, (after.gap - before.gap) / (2 * h), 1e-6 * speed) << t;
    ASSERT_NEAR(now.acceleration, (after.rate - before.rate) / (2 * h), 2e-3 * acceleration) << t;
    // It never jumps: the third derivative is bounded by 60 g0 / T^3 and 36 rate / T^2.
    ASSERT_LT(std::abs(after.acceleration - before.acceleration), 330.0 * h / kTime * acceleration)
        << t;
  }
}

TEST(GapReference, IsTwiceContinuouslyDifferentiable) { expect_smooth(kAtRest, 0.0995); }

TEST(GapReference, LeavesTheGapAtTheRateItHad) {
  for (const double rate : {-0.1, -0.02, 0.05}) {
    const SwitchOn on{0.1, kGap, rate};
    const GapReference start = gap_reference(on, 0.1, kTime);
    EXPECT_EQ(start.gap, kGap);
    EXPECT_DOUBLE_EQ(start.rate, rate) << "so the error starts without a jump in its rate";
    EXPECT_EQ(start.acceleration, 0.0);
    expect_smooth(on, 0.1 + 1e-6);
    const GapReference end = gap_reference(on, 0.108, kTime);
    EXPECT_NEAR(end.gap, 0.0, 1e-18);
    EXPECT_NEAR(end.rate, 0.0, 1e-15);
  }
}

TEST(GapReference, NeverAsksForAClosedGapBeforeItsTime) {
  for (const double rate : {-0.1, -1.0, -100.0}) {
    for (double t = 0.1; t < 0.108; t += 1e-5) {
      ASSERT_GE(gap_reference({0.1, kGap, rate}, t, kTime).gap, 0.0) << rate << " " << t;
    }
  }
  EXPECT_EQ(gap_reference({0.1, -1e-6, -1.0}, 0.101, kTime).gap, 0.0) << "closed already";
}

// Beyond the clearance the ring would be on the other side of the rotor.
TEST(GapReference, NeverAsksForLessThanHalfTheDistanceAtSwitchOn) {
  for (const double distance : {0.0, 0.01, 0.1, 0.3, 0.5, 0.9}) {
    const double clearance = kGap, gap = (1.0 - distance) * clearance;
    for (const double rate : {0.01, 0.1, 100.0}) {
      for (double t = 0.1; t < 0.108; t += 1e-5) {
        ASSERT_GE(clearance - gap_reference({0.1, gap, rate}, t, kTime, clearance).gap,
                  0.5 * distance * clearance)
            << distance << " " << rate << " " << t;
      }
    }
  }
}

// ------------------------------------------------------------------

// A tracking law that is switched on near the centre, where the normal turns by half a turn at
// once, does not hold the ring there.

constexpr const char* kLaw = "gap_time=TIME,bandwidth=400.0,boundary_layer=0.1,switching_gain=60.0";

// From x (m) at the velocity (m/s), in `bench_ring` on a force of that frequency.
struct Passage {
  std::string law, time, x, vx, vy, frequency;
};

scene::Scene passing(const Passage& p) {
  std::string law = kLaw;
  law.replace(law.find("TIME"), 4, p.time);
  return test::shipped("bench_ring",
                       {"actuator={force_limit=3000.0}", "run.end=0.15", "run.output_step=20us",
                        "controller={" + p.law + "," + law + "}", "initial.x=[" + p.x + "]",
                        "initial.vx=[" + p.vx + "]", "initial.vy=[" + p.vy + "]",
                        "force[0].frequency=\"" + p.frequency + " Hz\""});
}

// s: the longest time for which the centres are together while the law acts.
double held_at_the_centre(const Trajectory& t, double clearance) {
  double longest = 0.0, since = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const bool near = clearance - t.column("gap")[k] < 0.05 * clearance;
    const bool acts = std::hypot(t.column("control_x")[k], t.column("control_y")[k]) > 1.0;
    if (!near || !acts) since = t.column("t")[k];
    longest = std::max(longest, t.column("t")[k] - since);
  }
  return longest;
}

double largest_command(const Trajectory& t) {
  double most = 0.0;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    most = std::max(most, std::hypot(t.column("control_x")[k], t.column("control_y")[k]));
  }
  return most;
}

// The feed-forward of sampled laws is a mean over a turn of 20 ms, which a passage through the
// centre must not fill.
TEST(TrackingAtTheCentre, SampledLawsLetGo) {
  const std::string sampled = "sample_time=20e-6,preload=";
  const std::string sliding = "kind='sliding'," + sampled;
  const std::string handing =
      "kind='two_phase',feedback=[1000.0],damping=300.0,handover_time=0.02," + sampled;
  for (const Passage& p :
       {Passage{sliding + "30.0", "4e-3", "3.45e-5", "-0.312", "0.182", "120"},
        Passage{handing + "0.0", "20e-3", "6.12e-5", "-0.188", "-0.157", "120"},
        Passage{handing + "30.0", "20e-3", "9.93e-5", "-0.018", "-0.154", "120"}}) {
    const scene::Scene scene = passing(p);
    const Trajectory t = test::run_with(scene, scene::Integrator::kVerlet, 1e-5);
    EXPECT_LT(held_at_the_centre(t, scene.first().contact->clearance), 0.01) << p.x << " " << p.vx;
  }
}

TEST(TrackingAtTheCentre, TheContinuousLawNeedsNoForceWithoutEnd) {
  for (const Passage& p :
       {Passage{"kind='sliding',preload=100.0", "20e-3", "1.11e-4", "-0.130", "0.0", "50"},
        Passage{"kind='sliding',preload=30.0", "8e-3", "1e-4", "-0.3", "0.05", "50"}}) {
    const Trajectory t = test::run_event(passing(p));
    EXPECT_LT(largest_command(t), 600.0) << p.x << " " << p.vx;
  }
}

}  // namespace
}  // namespace rotorub
