#include "renders/playback.h"

#include <gtest/gtest.h>

#include "tests/renders/samples.h"

namespace rotorub::renders {
namespace {

// Positions of a cubic and its exact velocities at three rows: Hermite interpolation is exact.
double cubic(double t) { return 1e-4 * (1.0 + 20.0 * t - 300.0 * t * t + 900.0 * t * t * t); }
double cubic_rate(double t) { return 1e-4 * (20.0 - 600.0 * t + 2700.0 * t * t); }

Trajectory cubic_run() {
  Trajectory run = made_run(3, [](double t) { return Row{.rotor_x = cubic(t)}; });
  for (const char* name : {"rotor_vx", "vx_1"}) {
    run.series.push_back({name, "m/s", {cubic_rate(0.0), cubic_rate(0.05), cubic_rate(0.1)}});
  }
  return run;
}

constexpr double kLastDigit = 1e-16;  // m, of values of 1e-3 m

TEST(Playback, FollowsPositionAndVelocityBetweenRows) {
  const Trajectory run = cubic_run();
  const Playback playback(run);
  for (const double t : {0.0, 0.013, 0.05, 0.0777, 0.1}) {
    EXPECT_NEAR(playback.at(t).rotor[0], cubic(t), kLastDigit) << t;
    EXPECT_NEAR(playback.at(t).x[0], cubic(t), kLastDigit) << t;
  }
}

TEST(Playback, GoesStraightAcrossAnImpact) {
  Trajectory run = cubic_run();
  run.impacts.push_back({.t = 0.02, .normal_impulse = 1.0, .gap_rate_before = -0.1});
  const Playback playback(run);
  const double straight = 0.8 * cubic(0.0) + 0.2 * cubic(0.05);
  EXPECT_NEAR(playback.at(0.01).rotor[0], straight, kLastDigit);
  EXPECT_NE(playback.at(0.01).rotor[0], cubic(0.01));
  EXPECT_NEAR(playback.at(0.08).rotor[0], cubic(0.08), kLastDigit);  // no impact there
}

TEST(Playback, GoesStraightWhereVelocitiesAreNotGiven) {
  const Trajectory run = made_run(3, [](double t) { return Row{.rotor_y = t * t}; });
  EXPECT_NEAR(Playback(run).at(0.025).rotor[1], 0.5 * 0.05 * 0.05, kLastDigit);
}

TEST(Playback, NeverLeavesTheRingBetweenTwoPointsInIt) {
  // A bounce at the wall between the rows: positions inside, velocities outwards and inwards.
  Trajectory run = made_run(
      3, [](double t) { return Row{.rotor_x = t < 0.04 ? 0.9 * kClearance : 0.8 * kClearance}; });
  run.series.push_back({"rotor_vx", "m/s", {1.0, -0.5, 0.0}});
  run.impacts.push_back({.t = 0.01, .normal_impulse = 1.0, .gap_rate_before = -1.0});
  const Playback playback(run);
  for (double t = 0.0; t <= 0.05; t += 0.001) {
    EXPECT_LE(playback.at(t).rotor.norm(), kClearance) << t;
  }
}

TEST(Playback, HoldsForcesAcrossALiftOff) {
  const Trajectory run = made_run(
      3, [](double t) { return Row{.normal_force = t < 0.01 ? 10.0 : (t < 0.06 ? 30.0 : 0.0)}; });
  const Playback playback(run);
  EXPECT_NEAR(playback.at(0.025).normal_force, 20.0, 1e-12);  // within one contact
  EXPECT_EQ(playback.at(0.075).normal_force, 30.0);           // the row before
  EXPECT_EQ(playback.at(0.075).mode, ContactMode::kSlide);
  EXPECT_EQ(playback.at(0.1).normal_force, 0.0);
  EXPECT_EQ(playback.at(0.1).mode, ContactMode::kFree);
}

TEST(Playback, ClampsToTheRun) {
  const Trajectory run = cubic_run();
  const Playback playback(run);
  EXPECT_EQ(playback.at(-1.0).t, 0.0);
  EXPECT_EQ(playback.at(9.0).t, 0.1);
  EXPECT_NEAR(playback.at(9.0).rotor[0], cubic(0.1), kLastDigit);
}

TEST(Playback, FindsTheFirstContact) {
  Trajectory run =
      made_run(11, [](double t) { return Row{.normal_force = t > 0.055 ? 1.0 : 0.0}; });
  EXPECT_NEAR(*Playback(run).first_touch(), 0.06, 1e-15);
  run.impacts.push_back({.t = 0.031, .normal_impulse = 1.0, .gap_rate_before = -0.1});
  EXPECT_EQ(Playback(run).first_touch(), 0.031);
  EXPECT_FALSE(Playback(resting_run({})).first_touch());
}

TEST(Playback, RemembersWhereImpactsStruck) {
  Trajectory run = resting_run({.rotor_x = 0.0, .rotor_y = -kClearance});
  run.impacts.push_back({.t = 0.05, .normal_impulse = 2.0, .gap_rate_before = -0.1});
  run.impacts.push_back({.t = 0.06, .normal_impulse = 2.0, .gap_rate_before = -1e-6});  // too soft
  const Playback playback(run);
  ASSERT_EQ(playback.strikes().size(), 1u);
  EXPECT_NEAR((playback.strikes()[0].e_r - Eigen::Vector2d(0.0, -1.0)).norm(), 0.0, 1e-12);
}

TEST(Playback, RefusesASeriesWithoutAColumnByItsName) {
  Trajectory run = whirling_run();
  std::erase_if(run.series, [](const Column& column) { return column.name == "stator_y"; });
  expect_thrown<std::runtime_error>([&] { Playback{run}; }, "stator_y");
  EXPECT_THROW(Playback{Trajectory{}}, std::runtime_error);
}

// The rotor's centre on the ring's circle at angle(t), with rows `spacing` s apart. rate: of angle.
template <class Angle, class Rate>
Trajectory on_circle(double spacing, Angle angle, Rate rate) {
  const int rows = static_cast<int>(std::lround(0.1 / spacing)) + 1;
  Trajectory run = made_run(rows, [&](double t) {
    Row row;
    row.rotor_x = kClearance * std::cos(angle(t));
    row.rotor_y = kClearance * std::sin(angle(t));
    row.normal_force = 100.0;
    return row;
  });
  const auto add_rate = [&](const char* name, const char* of, double sign) {
    Column column{name, "", run.column(of)};
    for (std::size_t i = 0; i < column.values.size(); ++i)
      column.values[i] *= sign * rate(run.column("t")[i]);
    run.series.push_back(column);
  };
  add_rate("rotor_vx", "rotor_y", -1.0);
  add_rate("rotor_vy", "rotor_x", 1.0);
  add_rate("stator_vx", "stator_y", 1.0);
  add_rate("stator_vy", "stator_x", 1.0);
  return run;
}

// A whirl of 3000 rad/s with the velocities of the contract, in rows `spacing` s apart.
Trajectory fast_whirl(double spacing) {
  return on_circle(
      spacing, [](double t) { return 3000.0 * t; }, [](double) { return 3000.0; });
}

// A turn lasts 2.1 ms. Rows of 0.1 ms draw it; rows of 1 ms, and frames of 2 ms, make a star of it.
TEST(Playback, KnowsAWhirlThatItsRowsOrItsFramesCannotShow) {
  const Trajectory fine = fast_whirl(1e-4), coarse = fast_whirl(1e-3);
  const Playback shown(fine), star(coarse);
  EXPECT_FALSE(shown.strobe(0.02, 0.05));
  ASSERT_TRUE(shown.strobe(0.02, 0.05, 2e-3));
  ASSERT_TRUE(star.strobe(0.02, 0.05));
  EXPECT_NEAR(star.strobe(0.02, 0.05)->whirl, 3000.0, 1e-9);
  EXPECT_NEAR(star.strobe(0.02, 0.05)->spacing, 1e-3, 1e-12);
}

// A rotor that rocks at the bottom of its ring turns fast, but never far.
TEST(Playback, SaysNothingOfARotorThatRocks) {
  const Trajectory rocks = on_circle(
      1e-4, [](double t) { return 0.2 * std::sin(2e3 * t) - 1.57; },
      [](double t) { return 400.0 * std::cos(2e3 * t); });
  EXPECT_FALSE(Playback(rocks).strobe(0.02, 0.05, 5e-3));
}

TEST(Playback, BetweenRowsTooFarApartARotorStaysWhereItCanBe) {
  const Trajectory coarse = fast_whirl(1e-3);
  const Playback star(coarse);
  for (int k = 0; k <= 1000; ++k)
    EXPECT_LE(star.at(1e-4 * k).rotor.norm(), kClearance * (1.0 + 1e-12)) << k;
}

}  // namespace
}  // namespace rotorub::renders
