// `verlet` is second order through impacts, their accumulation and lasting contact: against `event`
// and against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "native_model/oracles/annular_rub.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "native_model/stepping/stepper.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"
#include "tests/support/whip.h"

namespace rotorub {
namespace {

using test::Convergence;
using test::run_with;
using test::shipped;

// s; the rows of every scene here stand at whole numbers of each.
const std::vector<double> kSteps{1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6, 2.5e-6, 1e-6};
constexpr double kOrder = 1.9;
// m: round-off of 500,000 steps, and that of rows that are interpolated at the end of a step.
constexpr double kFloor = 2e-13;

Trajectory verlet(const scene::Scene& scene, double step) {
  return run_with(scene, scene::Integrator::kVerlet, step);
}

// error: of a trajectory, m.
template <class Error>
Convergence converge(const scene::Scene& scene, const Error& error) {
  return test::convergence(kSteps, [&](double step) { return error(verlet(scene, step)); });
}

void expect_second_order(const Convergence& all) {
  const Convergence c = all.above(kFloor);
  EXPECT_GE(c.steps.size(), 5U) << all.text();
  EXPECT_GE(c.order(), kOrder) << all.text();
}

// ---------------------------------------------------------------- against `event`
// Without rebound the first impact is the last, and it is still located.
TEST(Verlet, BenchRingOverTheWholeRunWithAndWithoutRestitution) {
  for (const char* restitution : {"contact.restitution=0.5", "contact.restitution=0.0"}) {
    SCOPED_TRACE(restitution);
    const scene::Scene scene = shipped("bench_ring", {restitution});
    const Trajectory exact = run_with(scene, scene::Integrator::kEvent);
    const Convergence c =
        converge(scene, [&](const Trajectory& t) { return test::rotor_error(t, exact); });
    expect_second_order(c);
    EXPECT_LT(c.errors[0], 1e-6) << "at 1e-4: " << c.text();
    EXPECT_LT(c.errors[3], 1.2e-8) << "at 1e-5: " << c.text();
  }
}

// With straight flights and located impacts only round-off is left.
TEST(Verlet, BenchBilliardIsExact) {
  const scene::Scene scene = shipped("bench_billiard");
  const Trajectory exact = run_with(scene, scene::Integrator::kEvent);
  EXPECT_LT(test::rotor_error(verlet(scene, 1e-5), exact), 1e-12);
}

// ---------------------------------------------------------------- annular rubs
constexpr double kWhirl = 100.0 * std::numbers::pi;  // rad/s

// A rotor on a force of 150 N at 50 Hz, started on the exact rub.
scene::Scene rubbing(const oracle::AnnularRub& rub, bool elastic) {
  scene::Scene s = test::make_scene(
      {.mass = 2.0, .damping = 40.0, .stiffness = 2e5, .friction = 0.15, .speed = kWhirl});
  test::add_rotating_force(s, 150.0, kWhirl);
  const std::complex<double> rate{0.0, kWhirl};
  const std::complex<double> v = rate * rub.rotor, w = rate * rub.stator;
  s.initial.x = {rub.rotor.real()};
  s.initial.y = {rub.rotor.imag()};
  s.initial.vx = {v.real()};
  s.initial.vy = {v.imag()};
  if (elastic) {
    test::add_ring(s, 1.0, 200.0, 1e5);
    s.first().stator->position = {rub.stator.real(), rub.stator.imag()};
    s.first().stator->velocity = {w.real(), w.imag()};
  }
  s.run.end = 0.1;
  s.run.output_step = 1e-3;
  return s;
}

TEST(Verlet, AnnularRubs) {
  const oracle::Support rotor{2.0, 40.0, 2e5}, ring{1.0, 200.0, 1e5};
  for (const bool elastic : {false, true}) {
    SCOPED_TRACE(elastic ? "elastic ring" : "rigid ring");
    const auto rub = elastic ? oracle::annular_rub(rotor, ring, 0.5e-3, 0.15, 150.0, kWhirl)
                             : oracle::annular_rub(rotor, 0.5e-3, 0.15, 150.0, kWhirl);
    ASSERT_TRUE(rub);
    const auto off_the_rub = [&](const Trajectory& t) {
      return test::orbit_error(
          t, [&](double time) { return rub->rotor * std::polar(1.0, kWhirl * time); });
    };
    const scene::Scene scene = rubbing(*rub, elastic);
    const Trajectory event = run_with(scene, scene::Integrator::kEvent);
    ASSERT_LT(off_the_rub(event), 1e-13) << "is it stable?";
    EXPECT_NEAR(event.column("normal_force").back(), rub->force, 1e-9 * rub->force);
    EXPECT_EQ(event.contact_fraction(), 1.0);
    expect_second_order(converge(scene, off_the_rub));
  }
}

// ---------------------------------------------------------------- the whip
// Where the whip settles; at 1e-5 the scheme is 1.2e-3 rad/s and 1.2e-3 N off.
TEST(Verlet, SettlesOnTheWhip) {
  const scene::Scene scene = shipped("bench_whip");
  const double nu =
      test::whip_of(scene).slipping_whips(scene.first().contact->friction.coefficient)[1];
  Convergence speed, force;
  for (const double step : {1e-4, 5e-5, 2.5e-5, 1e-5, 5e-6}) {
    const Trajectory t = verlet(scene, step);
    speed.steps.push_back(step);
    speed.errors.push_back(std::abs(-test::whirl_speed(t, t.rows() - 1) - nu));
    force.steps.push_back(step);
    force.errors.push_back(
        std::abs(t.column("normal_force").back() - test::whip_of(scene).normal_force(nu)));
  }
  EXPECT_GE(speed.order(), kOrder) << "rad/s: " << speed.text();
  EXPECT_GE(force.order(), kOrder) << "N: " << force.text();
  EXPECT_LT(speed.errors[3], 2e-3) << "rad/s: " << speed.text();
  EXPECT_LT(force.errors[3], 2e-3) << "N: " << force.text();
}

// ---------------------------------------------------------------- impacts that take time
// As in `event`: the same impulses, the contact time of their phases, a balance that closes, and
// rows within them.
TEST(Verlet, FollowsImpactsThatTakeTime) {
  scene::Scene scene =
      shipped("bench_ring", {"contact.compression_time=1e-3", "contact.expansion_time=5e-4",
                             "run.end=0.02", "run.output_step=1e-4"});
  const Trajectory exact = run_with(scene, scene::Integrator::kEvent);
  const Trajectory t = verlet(scene, 1e-6);
  ASSERT_EQ(t.impacts.size(), exact.impacts.size());
  ASSERT_GE(t.impacts.size(), 3u);
  for (std::size_t k = 0; k < t.impacts.size(); ++k) {
    EXPECT_NEAR(t.impacts[k].t, exact.impacts[k].t, 1e-9);
    EXPECT_NEAR(t.impacts[k].normal_impulse, exact.impacts[k].normal_impulse, 1e-7);
    EXPECT_NEAR(t.impacts[k].energy_change, exact.impacts[k].energy_change, 1e-6);
  }
  EXPECT_NEAR(t.statistics.impulse_total, exact.statistics.impulse_total, 1e-6);
  EXPECT_NEAR(t.statistics.contact_time, exact.statistics.contact_time, 5e-6);
  EXPECT_LT(t.statistics.energy_residual(), 1e-9);
  const double first = exact.impacts[0].t;
  bool within = false;
  for (std::size_t k = 0; k < t.rows(); ++k) {
    const double since = t.column("t")[k] - first;
    if (since < 1e-5 || since > 1.5e-3 - 1e-5 || std::abs(since - 1e-3) < 1e-5) continue;
    within = true;
    EXPECT_NEAR(t.column("normal_force")[k], exact.column("normal_force")[k], 1e-3);
    EXPECT_NEAR(t.column("rotor_vx")[k], exact.column("rotor_vx")[k], 1e-5);
  }
  EXPECT_TRUE(within);
}

// Without restitution, closing after an impact is round-off and not a second impact.
TEST(Verlet, AnImpactWithoutRestitutionIsOne) {
  const scene::Scene s = scene::parse_scene(R"(
[run]
end = 0.0035
[rotor]
speed = 135.9243135162401
[rotor.modal]
mass = [2.4330058397627643]
stiffness = [3244762.5815690733]
stiffness_y = [3123111.251252408]
damping = [112.38879879846574]
damping_y = [317.95159890414146]
inertia = 0.0022061069834187633
[drive]
kind = "linear"
gain = 0.6639817011246621
speed = 257.8798404972367
[contact]
radius = 0.05569039072105968
clearance = 0.00020753171530015478
friction = 1.2904713403250547
restitution = 0.0
offset = [-2.0086521895142388e-05, 4.320342088882578e-05]
[[force]]
kind = "rotating"
amplitude = 205.16844816551227
phase = -2.5108107689208694
frequency = -24.16170443220176
[[force]]
kind = "chirp"
amplitude = 205.16844816551227
phase = 2.884959769521245
frequency = 406.7459228909388
frequency_end = -921.9933401421716
on = 0.002141703404162607
off = 0.029145276681986975
[initial]
x = [3.61474832090198e-05]
y = [4.006187084584459e-05]
vx = [0.026385343035084385]
vy = [0.06152817293590768]
)",
                                            "slack");
  const std::size_t exact = test::run_event(s).impacts.size();
  ASSERT_GE(exact, 1u);
  for (const double step : {8e-6, 4e-6, 2e-6, 1e-6, 5e-7}) {
    const Trajectory t = run_with(s, scene::Integrator::kVerlet, step);
    EXPECT_EQ(t.impacts.size(), exact) << step;
  }
}

// A whirl whose bounces have become so low that the step's chord begins a trifle outside: it leads
// in, and comes out within the step. It was taken for a flight, and the rotor went on outside, with
// an impact every few steps for ever instead of lasting contact. A chord that never comes inside is
// brought back by lasting contact.
TEST(Verlet, AChordThatBeginsOutsideIsNoFlight) {
  scene::Scene s = test::make_scene({.mass = 1.0, .restitution = 0.4});
  test::add_constant_force(s, {180.0, 0.0});
  const Model model = make_model(s);
  const double circle = model.first().contact->clearance, h = 5e-7;
  for (const double outside : {1.9e-12, 1e-10}) {
    State start = initial_state(model);
    start.q = Eigen::Vector2d(circle + outside, 0.0);
    start.v = Eigen::Vector2d(-3.737e-5, 0.28);
    VerletStepper stepper(model, h, start);
    bool touches = stepper.step(0).contacts[0].normal_impulse > 0.0;
    touches = stepper.step(1).contacts[0].normal_impulse > 0.0 || touches;
    EXPECT_TRUE(touches) << outside;
    EXPECT_NEAR(std::hypot(stepper.q()[0], stepper.q()[1]), circle, 1e-14) << outside;
  }
}

// ---------------------------------------------------------------- at rest
// A rotor that rests under its weight: its loads are in balance, and what round-off leaves of them
// is no motion. Perfectly balanced, held by a magnetic bearing: every step is iterated.
TEST(AtRest, TheEquationsOfAStepConverge) {
  const scene::Scene scene = shipped("touchdown", {"rotor.disc[0].eccentricity=0", "run.end=0.02"});
  for (const double step : {2e-5, 1e-5, 5e-6}) {
    const Trajectory t = run_with(scene, scene::Integrator::kVerlet, step);
    EXPECT_NEAR(t.column("rotor_y").back(), t.column("rotor_y").front(), 1e-12) << step;
  }
}

}  // namespace
}  // namespace rotorub
