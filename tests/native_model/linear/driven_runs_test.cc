// Effects of torsion and of a weak motor on the reference rig's rubs, in whole runs: none while it
// slides, and in backward rolling the effect that the eigenvalues and the motor's balance predict.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "native_model/linear/driven_rub.h"
#include "tests/native_model/hard/rules.h"
#include "tests/native_model/linear/rubs.h"

namespace rotorub::rub {
namespace {

// Without force and unbalance, the spin held; `torsion` modes.
scene::Scene unloaded_rig(int torsion) {
  scene::Scene s = test::shipped(
      "paper_passive", {"contact.friction=1.2", "drive=none", "rotor.disc[0].eccentricity=0",
                        "initial.steady=false", "rotor.torsion.modes=" + std::to_string(torsion)});
  s.forces.clear();
  return s;
}

SteadyRub rolling_of(const scene::Scene& s) {
  return BackwardCompliance(rub_system(s)).rolling(s.first().contact->friction.coefficient).value();
}

// Started on the rub, with the twist that its friction keeps in the shaft and `off` rad in the
// first mode.
scene::Scene twisted(const scene::Scene& s, const SteadyRub& rub, double off) {
  const DriveTrain train = drive_train(s);
  scene::Scene started = test::started_on(s, rub);
  const double friction = s.first().contact->radius * rub.friction * rub.normal_force;
  for (Eigen::Index k = 0; k < train.modes(); ++k) {
    started.initial.torsion.push_back(-train.at_contact[k] * friction / train.torsion_stiffness[k] +
                                      (k == 0 ? off : 0.0));
  }
  return started;
}

// The spin held without torsion, rolling is stable: -35 1/s. One torsion mode makes it grow, as
// bending and torsion exchange energy through a contact that does not slip. With the sleeve's own
// torsion mode kept, the fourth, it does not: what one mode shows is the truncation's.
TEST(DrivenRuns, FourTorsionModesLetItDecay) {
  for (const int modes : {1, 4, 8}) {
    const scene::Scene s = unloaded_rig(modes);
    EXPECT_LT(stability_of(rub_eigenvalues(rub_system(s), rolling_of(s))).growth, -30.0);
    const std::vector<Complex> values =
        driven_eigenvalues(rub_system(s), drive_train(s), rolling_of(s));
    if (modes == 1) {
      EXPECT_GT(values.front().real(), 500.0);
    } else {
      EXPECT_LT(values.front().real(), 0.0) << modes;
    }
  }
}

// m, the largest distance between two runs' columns.
double apart(const Trajectory& a, const Trajectory& b, const std::string& column) {
  const std::vector<double> one = a.column(column), other = b.column(column);
  EXPECT_EQ(one.size(), other.size());
  double largest = 0.0;
  for (std::size_t k = 0; k < one.size(); ++k)
    largest = std::max(largest, std::abs(one[k] - other[k]));
  return largest;
}

Trajectory run_short(scene::Scene s) {
  s.run.end = 0.02;
  s.run.output_step = 2e-4;
  return test::run_event(s);
}

// Torsion grows at 14 1/s and swings: the friction turns the shaft to and fro, and bending is
// unaffected. In rolling contact the arc of a twist, r theta, moves bending too.
TEST(DrivenRuns, SlidingIsBlindToTorsionRollingIsNot) {
  scene::Scene rigid = test::shipped("paper_passive", {"drive=none", "rotor.torsion=none",
                                                       "force[0].on=0", "initial.steady=false"});
  const RubSystem system = rub_system(rigid);
  RotatingLoad load = rotating_loads(system).front();
  load.load *= 1.001;
  scene::Scene slides = test::started_on(rigid, forced_rubs(system, load).at(0));
  slides.initial.steady = false;
  scene::Scene twists = slides;
  twists.rotor.torsion = unloaded_rig(4).rotor.torsion;
  const Trajectory one = run_short(slides), other = run_short(twists);
  EXPECT_GT(test::largest(other.column("torsion_1")), 1e-5);
  EXPECT_LT(apart(one, other, "rotor_x"), 1e-13);
  EXPECT_NEAR(one.statistics.contact_time, 0.02, 1e-12) << "it slides all the time";

  const scene::Scene rolls = unloaded_rig(4);
  const SteadyRub rub = rolling_of(rolls);
  scene::Scene stiff = test::started_on(rolls, rub);
  stiff.rotor.torsion.reset();
  const double arc = 1e-3 * rolls.first().contact->radius;
  EXPECT_GT(apart(run_short(stiff), run_short(twisted(rolls, rub, 1e-3)), "rotor_x"), 0.1 * arc);
}

// A soft motor does not move the border of sliding, even if all the load is unbalance: torsion and
// spin return only a hundredth to bending.
TEST(DrivenRuns, AMotorThatGivesWayHardlyMovesTheBorderOfSliding) {
  const auto growths = [](const std::string& friction) {
    const scene::Scene s = test::shipped(
        "paper_passive", {"contact.friction=" + friction, "drive.gain=0.001", "drive.inertia=0",
                          "initial.steady=false",
                          "force[0]={kind=\"unbalance\",static_moment=1.52e-3,station=0.42}"});
    const RubSystem system = rub_system(s);
    const SteadyRub rub = forced_rubs(system, rotating_loads(system).front()).at(0);
    return std::pair{rub_eigenvalues(system, rub).front().real(),
                     driven_eigenvalues(system, drive_train(s), rub).front().real()};
  };
  for (const auto& [friction, held] : {std::pair{"0.21", -0.6}, std::pair{"0.217", 0.6}}) {
    const auto [fixed, driven] = growths(friction);
    EXPECT_NEAR(fixed, held, 0.1) << friction;
    EXPECT_NEAR(driven, fixed, 0.5) << friction;
    EXPECT_NE(driven, fixed) << "there is a way through the unbalance";
  }
}

// ---------------------------------------------------------------- paper_rolling
std::vector<DrivenRolling> kept_by_the_motor(const scene::Scene& s) {
  const auto all = driven_rolling(rub_system(s), drive_train(s), s.rotor.speed);
  for (const DrivenRolling& r : all) {
    EXPECT_NEAR(r.torque, Drive(*s.drive).torque(r.speed), 1e-6 * r.torque);
    EXPECT_NEAR(r.rub.whirl * s.first().contact->clearance, -r.speed * s.first().contact->radius,
                1e-9)
        << "locked to the spin";
  }
  return all;
}

// At the rig's own friction, without force and unbalance.
scene::Scene rolling_rig() {
  scene::Scene s = test::shipped(
      "paper_rolling",
      {"contact.friction=0.3", "rotor.disc[0].eccentricity=0", "initial.steady=false"});
  s.forces.clear();
  return s;
}

// A machine and its mirror image, which turns the other way, keep the same rolling.
TEST(DrivenRuns, TheMirroredMotorKeepsTheMirroredRolling) {
  scene::Scene s = rolling_rig();
  const std::vector<DrivenRolling> here = kept_by_the_motor(s);
  s.rotor.speed = -s.rotor.speed;
  s.drive->speed = -s.drive->speed;
  const auto there = driven_rolling(rub_system(s), drive_train(s), s.rotor.speed);
  ASSERT_FALSE(here.empty());
  ASSERT_EQ(there.size(), here.size());
  for (std::size_t k = 0; k < here.size(); ++k) {
    EXPECT_NEAR(there[k].speed, -here[k].speed, 1e-9 * std::abs(here[k].speed));
    EXPECT_NEAR(there[k].rub.whirl, -here[k].rub.whirl, 1e-9 * std::abs(here[k].rub.whirl));
    EXPECT_NEAR(there[k].torque, -here[k].torque, 1e-7 * std::abs(here[k].torque));
    EXPECT_EQ(there[k].stability.stable, here[k].stability.stable);
    EXPECT_NEAR(there[k].stability.growth, here[k].stability.growth,
                1e-6 * std::abs(here[k].stability.growth) + 1e-6);
  }
}

// Under a motor with a falling target speed two of the three rollings meet and disappear: until
// then both are reported, however close they are.
TEST(DrivenRuns, BothRollingsAreReportedUntilTheyMeet) {
  scene::Scene s = rolling_rig();
  const auto all_at = [&s](double speed) {
    s.drive->speed = speed;
    return driven_rolling(rub_system(s), drive_train(s), 400.0);
  };
  double three = 157.0, fewer = 100.0;
  ASSERT_EQ(all_at(three).size(), 3U);
  ASSERT_LT(all_at(fewer).size(), 3U);
  while (three - fewer > 1e-6) {
    const double middle = 0.5 * (three + fewer);
    (all_at(middle).size() == 3 ? three : fewer) = middle;
  }
  EXPECT_EQ(all_at(fewer).size(), 1U);
  const auto last = all_at(three);
  EXPECT_LT(std::min(last[1].speed - last[0].speed, last[2].speed - last[1].speed), 0.01);
}

// The start is on the rub, with `off` rad more twist in the first mode.
scene::Scene started_rolling(scene::Scene s, const DrivenRolling& kept, double off) {
  s.rotor.speed = kept.speed;
  const DriveTrain train = drive_train(s);
  s = test::started_on(s, kept.rub);
  for (Eigen::Index k = 0; k < train.modes(); ++k) {
    s.initial.torsion.push_back((train.at_motor[k] - train.at_contact[k]) * kept.torque /
                                    train.torsion_stiffness[k] +
                                (k == 0 ? off : 0.0));
  }
  return s;
}

// The rolling that the motor keeps also exists at a friction of 0.3; a friction of 1 leads the
// rotor there.
TEST(DrivenRuns, RollingStaysWhereTheMotorKeepsIt) {
  for (const bool soft : {false, true}) {
    scene::Scene s = rolling_rig();
    if (soft) s.drive = test::shipped("run_up_kloss").drive;
    const DrivenRolling kept = kept_by_the_motor(s).back();
    EXPECT_NEAR(kept.speed, soft ? 87.9 : 196.1, 0.05);
    EXPECT_TRUE(kept.stability.stable);
    const Trajectory t = run_short(started_rolling(s, kept, 0.0));
    for (const double speed : t.column("spin_speed"))
      EXPECT_NEAR(speed, kept.speed, 1e-6 * kept.speed);
    for (const double force : t.column("normal_force")) {
      EXPECT_NEAR(force, kept.rub.normal_force, 1e-5 * kept.rub.normal_force);
    }
  }
}

// Above the resonance at which the spin hangs the rub's torque falls with the speed: there it runs
// away from the watershed, and before it swings back, spin, torsion and bending as one.
TEST(DrivenRuns, SpinAndBendingSwingAndRunAwayAsOne) {
  const scene::Scene s = rolling_rig();
  const RubSystem system = rub_system(s);
  const auto all = kept_by_the_motor(s);
  ASSERT_EQ(all.size(), 3U);
  for (const auto& [kept, stable, end, count] :
       {std::tuple{all[1], false, 0.0115, 4}, std::tuple{all[2], true, 0.04, 12}}) {
    EXPECT_EQ(kept.stability.stable, stable);
    scene::Scene started = started_rolling(s, kept, 1e-7);
    constexpr double kRow = 1e-4;
    started.run.end = end;
    started.run.output_step = kRow;
    const Trajectory t = test::run_event(started);
    std::vector<double> off = t.column("spin_speed");
    for (double& speed : off) speed -= kept.speed;
    ASSERT_LT(test::largest(off), 0.01 * (all[1].speed - all[0].speed)) << "little";
    off.erase(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2));
    const Complex expected(kept.stability.growth, kept.stability.frequency);
    double nearest = 1e300;
    for (const Complex& z : test::exponents(off, kRow, count))
      nearest = std::min(nearest, std::abs(z - expected));
    EXPECT_LT(nearest, 0.01 * std::abs(expected.real()) + 1e-4 * std::abs(expected.imag()))
        << expected;
  }
}

// The whole motion: it bounces, turns backward, rolls, and the spin falls to where the motor's line
// meets the rub's.
TEST(DrivenRuns, ThePassiveRigFallsIntoRolling) {
  const scene::Scene s = test::shipped("paper_rolling", {"run.end=0.3"});
  const double expected = kept_by_the_motor(s).back().speed;
  const Trajectory t = test::run_with(s, scene::Integrator::kVerlet, 1e-5);
  const std::vector<double> speed = t.column("spin_speed");
  EXPECT_GT(*std::min_element(speed.begin(), speed.begin() + 400), 308.0) << "it bounces at first";
  double sum = 0.0;
  for (auto x = speed.end() - 200; x != speed.end(); ++x) sum += *x;
  EXPECT_NEAR(sum / 200.0, expected, 2e-3 * expected) << "over the last 60 ms";
}

// The paper blames the speed that is not constant, but at a held speed the result is ten times
// worse.
TEST(DrivenRuns, ASoftMotorSoftensRolling) {
  scene::Scene held =
      test::shipped("paper_rolling", {"contact.friction=1.5", "drive=none", "run.end=0.2"});
  scene::Scene soft = held;
  soft.drive = test::shipped("run_up_kloss").drive;
  const auto impulse = [](const scene::Scene& s) {
    const Trajectory t = test::run_with(s, scene::Integrator::kVerlet, 1e-5);
    return t.statistics.impulse_total;
  };
  EXPECT_GT(impulse(held), 10.0 * impulse(soft));
}

}  // namespace
}  // namespace rotorub::rub
