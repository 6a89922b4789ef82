// The metrics of rules, on trajectories written by hand.
#include "compare/check/metric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compare/check/verdict.h"
#include "tests/compare/hand_made.h"
#include "tests/support/said.h"

namespace rotorub::check {
namespace {

using test::hand_made;
using test::Row;

scene::Scene in_a_ring() {
  scene::Scene scene;
  scene.first().contact = scene::Contact{.radius = 0.05, .clearance = 0.5e-3, .friction = 0.2};
  return scene;
}

Trajectory line(std::size_t rows, double spacing, double slope) {
  return hand_made(rows, spacing, [slope](double t) {
    Row row;
    row.x = slope * t;
    row.gap = 0.5e-3 - std::abs(row.x);
    return row;
  });
}

TEST(CheckMetric, TakesAnyNumberOfTheSummary) {
  Trajectory t = line(11, 0.1, 1e-4);
  t.statistics.max_penetration = 3e-6;
  t.steps = 7;
  EXPECT_EQ(measure("max_penetration", in_a_ring(), t, nullptr), 3e-6);
  EXPECT_EQ(measure("steps", in_a_ring(), t, nullptr), 7.0);
  EXPECT_EQ(measure("end", in_a_ring(), t, nullptr), 1.0);
}

TEST(CheckMetric, LooksAtColumnsAndEvents) {
  Trajectory t = line(11, 0.1, -1e-4);
  t.events = {{0.1, EventKind::kStick}, {0.2, EventKind::kSlide}, {0.3, EventKind::kStick}};
  EXPECT_DOUBLE_EQ(measure("end.rotor_x", in_a_ring(), t, nullptr), -1e-4);
  EXPECT_DOUBLE_EQ(measure("largest.rotor_x", in_a_ring(), t, nullptr), 1e-4);
  EXPECT_EQ(measure("count.stick", in_a_ring(), t, nullptr), 2.0);
  EXPECT_EQ(measure("count.lift_off", in_a_ring(), t, nullptr), 0.0);
}

// Every second row of one run is a row of the other; a run that ended early has fewer rows.
TEST(CheckMetric, TakesTheErrorOverCommonRowsAlone) {
  const Trajectory fine = line(21, 0.05, 1e-4), coarse = line(6, 0.1, 3e-4);
  EXPECT_DOUBLE_EQ(measure("error.rotor_x", in_a_ring(), coarse, &fine), 2e-4 * 0.5);
  EXPECT_DOUBLE_EQ(measure("error.rotor_x", in_a_ring(), fine, &coarse), 2e-4 * 0.5);
  EXPECT_EQ(measure("error.rotor_x", in_a_ring(), fine, &fine), 0.0);
}

TEST(CheckMetric, ReadsResidualsFromTheRows) {
  const Trajectory deep = line(11, 0.1, 1e-3);  // to 1 mm, twice the clearance
  EXPECT_NEAR(measure("residual.penetration", in_a_ring(), deep, nullptr), 1.0, 1e-12);
}

TEST(CheckMetric, RefusesWhatIsNotThereWithWhatIs) {
  const auto said = [](const std::string& metric) {
    return test::message_of<NoSuchMetric>([&] { check_name(metric); });
  };
  for (const char* good : {"energy_residual", "impacts", "error.rotor_x", "end.torsion_1",
                           "largest.gap", "residual.cone", "count.reverse"}) {
    EXPECT_EQ(said(good), "") << good;
  }
  EXPECT_NE(said("energy").find("energy_residual"), std::string::npos);
  EXPECT_NE(said("status").find("choose from"), std::string::npos) << "a word, and no number";
  EXPECT_NE(said("residual.cones").find("cone"), std::string::npos);
  EXPECT_NE(said("count.hit").find("count.impact"), std::string::npos);
  EXPECT_THROW(measure("end.torsion_1", in_a_ring(), line(3, 0.1, 0.0), nullptr), NoSuchMetric);
}

TEST(CheckVerdict, SaysByHowMuch) {
  const Verdict over = limited("max_penetration", 3e-6, std::nullopt, 1e-6);
  EXPECT_EQ(over.outcome, Outcome::kViolates);
  EXPECT_EQ(over.rule, "max_penetration <= 1e-06");
  EXPECT_EQ(over.limit, 1e-6);
  EXPECT_NE(over.reason.find("3e-06"), std::string::npos) << over.reason;
  EXPECT_NE(over.reason.find("by 2e-06 (3 times"), std::string::npos) << over.reason;
  EXPECT_NEAR(excess(over), 2.0, 1e-12);

  const Verdict under = limited("impacts", 2.0, 5.0, 9.0);
  EXPECT_EQ(under.outcome, Outcome::kViolates);
  EXPECT_EQ(under.limit, 5.0);
  EXPECT_NE(under.reason.find("under 5 by 3"), std::string::npos) << under.reason;

  for (const double inside : {5.0, 7.0, 9.0}) {
    EXPECT_EQ(limited("impacts", inside, 5.0, 9.0).outcome, Outcome::kPass) << inside;
  }
  EXPECT_EQ(limited("x", std::nan(""), std::nullopt, 1.0).outcome, Outcome::kViolates);
  EXPECT_EQ(limited("x", std::nan(""), 1.0, std::nullopt).outcome, Outcome::kViolates);
}

// ---------------------------------------------------------------- the rules of every run
bool lawful(const Trajectory& t, bool exact_rows = true) {
  for (const Verdict& v : law_verdicts(t, {ContactFacts{0.5e-3, 0.05, 0.2}}, exact_rows)) {
    if (v.outcome != Outcome::kPass) return false;
  }
  return true;
}

TEST(CheckLaws, HoldForARubThatObeysThem) {
  const test::Whirl whirl;
  const auto rub = [&](double t) { return test::sliding(whirl, t); };
  EXPECT_TRUE(lawful(hand_made(200, 1e-3, rub)));
}

TEST(CheckLaws, EachIsBrokenAlone) {
  const test::Whirl whirl;
  const auto with = [&](auto change) {
    return hand_made(200, 1e-3, [&](double t) {
      Row row = test::sliding(whirl, t);
      change(row);
      return row;
    });
  };
  EXPECT_FALSE(lawful(with([](Row& r) { r.normal = -1.0; }))) << "adhesion";
  EXPECT_FALSE(lawful(with([](Row& r) { r.friction *= 1.1; }))) << "out of the cone";
  EXPECT_FALSE(lawful(with([](Row& r) { r.friction = 0.0; }))) << "slides without friction";
  EXPECT_FALSE(lawful(with([](Row& r) { r.x = std::nan(""); }))) << "not finite";
  const Trajectory apart = with([](Row& r) { r.x *= 0.9, r.y *= 0.9; });
  EXPECT_FALSE(lawful(apart)) << "a force at a distance";
  EXPECT_TRUE(lawful(apart, false)) << "rows of a fixed step are not so exact";

  Trajectory deep = with([](Row&) {});
  deep.statistics.max_penetration = 0.6e-3;
  EXPECT_FALSE(lawful(deep));
}

TEST(CheckLaws, ImpactsPushBrakeAndGiveNothing) {
  const auto with = [](const Impact& impact) {
    Trajectory t = line(11, 0.1, 1e-4);
    t.impacts = {impact};
    return lawful(t);
  };
  //                    t   N s        gap rate     slip        J
  EXPECT_TRUE(with({0.5, 1.0, -0.2, -1.0, 0.5, 3.0, 2.0, -0.7}));
  EXPECT_FALSE(with({0.5, 1.0, -0.2, -1.0, 0.5, 3.0, 2.0, 1e-6})) << "gains energy";
  EXPECT_FALSE(with({0.5, 1.0, -0.3, -1.0, 0.5, 3.0, 2.0, -0.7})) << "out of the cone";
  EXPECT_FALSE(with({0.5, -1.0, 0.0, -1.0, 0.5, 3.0, 2.0, -0.7})) << "pulls";
}

}  // namespace
}  // namespace rotorub::check
