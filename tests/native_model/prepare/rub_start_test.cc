// [initial] rub: a run that starts on a lasting rub which is stable stays on it, with the force,
// whirl and circle of the closed forms, in every integrator.
#include "native_model/prepare/rub_start.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "native_model/linear/rub_map.h"
#include "native_model/oracles/annular_rub.h"
#include "native_model/periodic/motion_record.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/reader.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/rubs.h"
#include "tests/native_model/periodic/sampled_ring.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"
#include "tests/support/whip.h"

namespace rotorub::rub {
namespace {

constexpr double kStays = 1e-6;  // of each figure, over all turns

scene::Scene on(const std::string& name, const std::string& rub,
                std::vector<std::string> overrides = {}) {
  overrides.push_back("initial={rub='" + rub + "'}");
  return test::shipped(name, overrides);
}

// Only the round-off of the start may close the contact, at t = 0.
void expect_no_impact(const Trajectory& t) {
  for (const Impact& impact : t.impacts) {
    EXPECT_GT(impact.gap_rate_before, -1e-13) << impact.t;
    EXPECT_EQ(impact.t, 0.0);
  }
}

// In contact all the time on a circle about the ring's centre, and the rotor's centre on its own.
void expect_stays(const scene::Scene& scene, double whirl, double force, double turns,
                  double share = kStays) {
  const Trajectory t = test::run_event(scene);
  ASSERT_GT(std::abs(whirl) * scene.run.end, turns * 2.0 * std::numbers::pi);
  expect_no_impact(t);
  EXPECT_NEAR(t.statistics.contact_time, scene.run.end, 1e-12 * scene.run.end);
  const double clearance = scene.first().contact->clearance;
  const double own = std::hypot(t.column("rotor_x")[0], t.column("rotor_y")[0]);
  for (std::size_t k = 0; k < t.rows(); ++k) {
    ASSERT_NEAR(t.column("gap")[k], 0.0, share * clearance) << k;
    ASSERT_NEAR(std::hypot(t.column("rotor_x")[k], t.column("rotor_y")[k]), own, share * own) << k;
    ASSERT_NEAR(test::whirl_speed(t, k), whirl, share * std::abs(whirl)) << k;
    ASSERT_NEAR(t.column("normal_force")[k], force, share * force) << k;
  }
}

// ---------------------------------------------------------------- each kind
TEST(RubStart, SynchronousStaysOnTheClosedForm) {
  const scene::Scene s = on("bench_annular_elastic", "synchronous", {"run.end=4.0"});
  const scene::RotorModal& r = *s.rotor.modal;
  const scene::Stator& ring = *s.first().stator;
  const auto exact = oracle::annular_rub({r.mass[0], r.damping[0], r.stiffness[0]},
                                         {ring.mass.x(), ring.damping.x(), ring.stiffness.x()},
                                         0.5e-3, 0.15, 150.0, s.forces[0].frequency);
  ASSERT_TRUE(exact);
  expect_stays(s, s.forces[0].frequency, exact->force, 190.0);
}

TEST(RubStart, WhipStaysOnTheClosedForm) {
  const scene::Scene s = on("bench_whip", "whip", {"run.end=2.0"});
  const oracle::ElasticWhip whip = test::whip_of(s);
  // The other two at this friction are watersheds.
  const std::vector<double> all = whip.slipping_whips(s.first().contact->friction.coefficient);
  ASSERT_EQ(all.size(), 3U);
  expect_stays(s, -all[1], whip.normal_force(all[1]), 150.0);
}

TEST(RubStart, RollingStaysOnTheClosedForm) {
  const scene::Scene s = on("bench_whip", "rolling", {"run.end=0.1", "run.output_step=1e-4"});
  const oracle::ElasticWhip whip = test::whip_of(s);
  const double nu = s.rotor.speed * s.first().contact->radius / s.first().contact->clearance;
  expect_stays(s, -nu, whip.normal_force(nu), 400.0);
  const Trajectory t = test::run_event(s);
  ASSERT_FALSE(t.events.empty());
  EXPECT_EQ(t.events.back().kind, EventKind::kStick);
}

// Gyroscopics, rotating damping, a magnetic bearing and a load of its own shape and phase; either
// sense of the spin.
TEST(RubStart, StaysOnTheRubOfSeveralModes) {
  for (const double turn : {1.0, -1.0}) {
    scene::Scene s = test::three_modes(true);
    s.first().contact->friction = 0.05;
    s.rotor.speed *= turn;
    s.forces[0].frequency *= turn;
    const RubSystem system = rub_system(s);
    const RubPoint point = RubStudy(system).at(system.friction);
    const StandingRub* rub = point.leading(RubKind::kForced);
    ASSERT_TRUE(rub && rub->stability.stable);
    s.initial.rub = scene::StartingRub::kSynchronous;
    s.run.end = 2.0;
    s.run.output_step = 2e-3;
    expect_stays(s, rub->rub.whirl, rub->rub.normal_force, 90.0);
  }
}

// ---------------------------------------------------------------- the accident that has happened
// A free orbit that touches is refused as a steady start, and the refusal names what is taken.
TEST(RubStart, IsWhatASteadyStartThatTouchesNames) {
  scene::Scene s = test::shipped("bench_annular_elastic", {"initial={steady=true}"});
  const scene::Diagnostic d = test::refusal(s);
  EXPECT_EQ(d.key, "initial.steady");
  EXPECT_TRUE(test::contains(d.reason, "initial.rub = \"synchronous\""));
  EXPECT_EQ(rub_system(s).modes(), 1) << "the lasting rubs are known all the same";
  s.initial.steady = false;
  s.initial.rub = scene::StartingRub::kSynchronous;
  EXPECT_EQ(test::refusal(s).reason, "");
}

// A load that begins after t = 0 is not part of the rub: it acts on the rotor that rubs already.
TEST(RubStart, LoadsThatComeLaterAreLeftOut) {
  scene::Scene s = on("bench_annular_elastic", "synchronous");
  const Model alone = prepare(s);
  test::add_rotating_force(s, 40.0, 200.0);
  s.forces.back().on = 0.1;
  test::add_rotating_force(s, 40.0, 250.0);
  s.forces.back().ramp = 0.1;
  scene::Force weight;
  weight.vector = {0.0, -10.0};
  weight.on = 0.05;
  s.forces.push_back(weight);
  const Model later = prepare(s);
  EXPECT_EQ(later.q0, alone.q0);
  EXPECT_EQ(later.v0, alone.v0);
  s.run.end = 0.049;
  expect_stays(s, s.forces[0].frequency, run_native(s, {}).column("normal_force")[0], 2.0, 0.2);
}

// The spin's angle turns the unbalance, and with it the rub.
TEST(RubStart, TurnsWithTheUnbalance) {
  scene::Scene s = on("bench_annular_elastic", "synchronous");
  scene::Force blade;
  blade.kind = scene::ForceKind::kUnbalance;
  blade.static_moment = 150.0 / (s.rotor.speed * s.rotor.speed);
  s.forces = {blade};
  const Model straight = prepare(s);
  s.initial.spin_angle = 0.5 * std::numbers::pi;
  const Model turned = prepare(s);
  EXPECT_NEAR(turned.q0[1], straight.q0[0], 1e-15);
  EXPECT_NEAR(turned.q0[0], -straight.q0[1], 1e-15);
}

// ---------------------------------------------------------------- torsion and motor
// The friction twists the shaft against the spin that is held, and no torsional swing begins.
TEST(RubStart, TorsionRestsUnderTheFriction) {
  const scene::Scene s = on("bench_annular_elastic", "synchronous",
                            {"rotor.torsion={inertia=[4e-4],stiffness=[60.0],damping=[0.0]}",
                             "rotor.modal.inertia=1e-3"});
  const Trajectory t = test::run_event(s);
  const double force = t.column("normal_force")[0];
  const double twist = -s.first().contact->radius * 0.15 * force / 60.0;
  for (const double angle : t.column("torsion_1")) {
    ASSERT_NEAR(angle, twist, 1e-6 * std::abs(twist));
  }
}

// A motor that holds the speed under the friction's torque holds the rub.
TEST(RubStart, AMotorThatCarriesTheFrictionKeepsIt) {
  scene::Scene s = on("bench_annular_elastic", "synchronous", {"rotor.modal.inertia=1e-3"});
  const double force = test::run_event(s).column("normal_force")[0];
  s.drive = scene::Drive{};
  s.drive->kind = scene::DriveKind::kLinear;
  s.drive->gain = 0.5;
  const double friction = s.first().contact->radius * 0.15 * force;
  s.drive->speed = s.rotor.speed + friction / s.drive->gain;
  const Trajectory t = test::run_event(s);
  expect_no_impact(t);
  EXPECT_NEAR(t.column("spin_speed").back(), s.rotor.speed, 1e-6 * s.rotor.speed);
  EXPECT_NEAR(t.column("normal_force").back(), force, kStays * force);
}

// ---------------------------------------------------------------- every integrator
TEST(RubStart, IsTheSameInEveryIntegrator) {
  const scene::Scene s = on("bench_whip", "whip", {"run.end=0.2"});
  const Trajectory event = test::run_event(s);
  const double force = event.column("normal_force")[0];
  for (const auto integrator : {scene::Integrator::kVerlet, scene::Integrator::kEuler}) {
    SCOPED_TRACE(static_cast<int>(integrator));
    const Trajectory t = test::run_with(s, integrator);
    for (const char* column :
         {"rotor_x", "rotor_y", "rotor_vx", "rotor_vy", "stator_x", "stator_vy"}) {
      EXPECT_EQ(t.column(column)[0], event.column(column)[0]) << column;
    }
    EXPECT_NEAR(t.column("normal_force").back(), force, 0.02 * force);
    EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), test::whirl_speed(event, 0), 0.02 * 502.0);
  }
}

// ---------------------------------------------------------------- without a closed form
void expect_refused(const scene::Scene& s, const std::string& key, const std::string& reason) {
  const scene::Diagnostic d = test::refusal(s);
  EXPECT_EQ(d.key, key);
  EXPECT_TRUE(test::contains(d.reason, reason));
}

// Runs the scene over some turns of the whirl and compares its end with its start.
void expect_comes_back(const scene::Scene& scene, double period, double share) {
  const Model m = prepare(scene);
  const Eigen::Index n = m.layout.mechanical();
  const periodic::MotionRecord r = periodic::record_motion(m, initial_state(m), period);
  ASSERT_EQ(r.status, Status::kOk) << r.message;
  const Eigen::Map<const Eigen::VectorXd> q(r.end.data(), n), v(r.end.data() + m.nq(), n);
  EXPECT_LT((q - m.q0.head(n)).norm(), share * m.q0.head(n).norm());
  EXPECT_LT((v - m.v0.head(n)).norm(), share * m.v0.head(n).norm());
  EXPECT_EQ(r.last[0].mode, ContactMode::kSlide);
}

// Weight breaks the symmetry that the closed form needs. Five turns lead back to the start.
TEST(RubStart, UnderWeightIsAPeriodicRub) {
  scene::Scene s = on("bench_annular_elastic", "synchronous");
  test::add_constant_force(s, {0.0, -20.0});
  expect_comes_back(s, 0.1, 1e-7);
  const Trajectory t = test::run_event(s);
  const auto& force = t.column("normal_force");
  EXPECT_GT(*std::ranges::min_element(force), 100.0);
  EXPECT_LT(*std::ranges::max_element(force), 145.0);
}

// The memory of the controller begins empty, so the rub settles first.
TEST(RubStart, WithASampledControllerIsARubOfThisKind) {
  std::vector<std::string> changes = test::sampled_laws()[2];
  changes.emplace_back("initial.rub=\"synchronous\"");
  changes.emplace_back("gravity.acceleration=[0.0, -9.81]");
  const Trajectory t = test::run_event(test::sampled_ring(changes));
  EXPECT_GT(*std::ranges::min_element(t.column("normal_force")), 50.0);
  EXPECT_NEAR(test::whirl_speed(t, t.rows() - 1), 100.0 * std::numbers::pi, 1.0);
}

TEST(RubStart, NamesWhatRunsSettleToIfThereIsNone) {
  scene::Scene s = on("bench_annular_elastic", "whip");
  test::add_constant_force(s, {0.0, -20.0});
  expect_refused(s, "force[1].kind",
                 "; a search for a periodic rub found none either: the run from ");
}

// ---------------------------------------------------------------- refusals
TEST(RubStartRefusal, SaysWhichRubsThereAre) {
  expect_refused(on("bench_whip", "synchronous"), "initial.rub",
                 "there is no synchronous rub at 314.159 rad/s; choose one that exists "
                 "here (whip, rolling), or none");
  scene::Scene gentle = on("bench_annular_elastic", "synchronous");
  gentle.forces[0].amplitude = 1e-3;
  gentle.first().contact->friction = 0.0;
  expect_refused(gentle, "initial.rub", "choose none");
}

TEST(RubStartRefusal, OfLoads) {
  const scene::Scene good = on("bench_annular_elastic", "synchronous");
  // `modes` includes loads that begin later, a start does not.
  scene::Scene s = good;
  s.forces[0].on = 0.1;
  expect_refused(s, "initial.rub", "under what acts at t = 0 (force[0] begins later)");
  s.forces[0].on = -0.01;
  s.forces[0].ramp = 0.02;
  expect_refused(s, "force[0].ramp", "still rising");
  s = good;
  test::add_rotating_force(s, 40.0, 200.0);
  expect_refused(s, "initial.rub", "loads of several frequencies");
}

TEST(RubStartRefusal, AControllerWhoseFirstPhaseIsAnother) {
  scene::Scene s = on("bench_annular_elastic", "synchronous");
  s.first().controller = scene::Controller{};
  s.first().controller->kind = scene::ControllerKind::kTwoPhase;
  expect_refused(s, "controller.kind", "first phase");
  s.first().controller->kind = scene::ControllerKind::kSliding;
  s.first().controller->on = 0.1;
  EXPECT_EQ(test::refusal(s).reason, "") << "it comes later";
}

// Two contacts are refused in any case, but what one of them has is named at that one.
TEST(RubStartRefusal, NamesTheContactInAnyOrder) {
  const std::string rotor = R"([rotor]
speed = 100.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[initial]
rub = "synchronous"
)";
  const std::string plain = R"([[contact]]
radius = 0.05
clearance = 5e-4
friction = 0.1
restitution = 0.5
[contact.stator]
mass = 1.0
damping = 200.0
stiffness = 4e5
)";
  const std::string law =
      "[contact.controller]\nkind = \"two_phase\"\nsample_time = 1e-4\nfeedback = [200.0]\n";
  const std::string spin = "[contact.stator.spin]\ninertia = 1e-4\nspeed = 5.0\n";
  for (const auto& [table, key, reason] :
       {std::array<std::string, 3>{law, "controller.kind", "first phase"},
        std::array<std::string, 3>{spin, "stator.spin.speed", "the rub determines the speed"}}) {
    expect_refused(scene::parse_scene(rotor + plain + table + plain, "two"), "contact[0]." + key,
                   reason);
    expect_refused(scene::parse_scene(rotor + plain + plain + table, "two"), "contact[1]." + key,
                   reason);
  }
}

TEST(RubStartRefusal, AStartBesideIt) {
  for (const char* beside : {"steady=true", "x=[1e-4]", "vy=[0.1]", "stator=[1e-4, 0.0]"}) {
    const auto all = test::refusals([&] {
      test::shipped("bench_annular_elastic",
                    {std::string("initial={rub='synchronous',") + beside + "}"});
    });
    ASSERT_EQ(all.size(), 1U) << beside;
    EXPECT_EQ(all[0].key.rfind("initial.", 0), 0U) << all[0].key;
    EXPECT_TRUE(test::contains(all[0].reason, "initial.rub"));
  }
}

}  // namespace
}  // namespace rotorub::rub
