#include "compare/model_error/model_error.h"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>
#include <nlohmann/json.hpp>

#include "compare/engine/engine.h"
#include "compare/metrics/metrics.h"
#include "compare/metrics/rows.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

// Limits of figures over the modes: sequences with known limits, and random ones.

constexpr double kPercent = 0.01;
const std::vector<int> kModes{12, 16, 20, 24};

FigureLimit of(const char* key, const std::function<double(int)>& value, double spread = 0.0) {
  std::vector<double> values;
  for (const int n : kModes) values.push_back(value(n));
  return figure_limit(figure(key), kModes, values, kPercent, spread);
}

TEST(FigureLimit, TellsConvergenceFromGrowthAndChance) {
  struct Case {
    const char *what, *key;
    double (*value)(int);
    Convergence expected;
    double spread = 0.0;
  };
  constexpr auto kConverged = Convergence::kConverged, kNoLimit = Convergence::kNoLimit;
  const auto back_and_forth = [](int n) { return n % 8 == 0 ? 950.0 : 1000.0; };
  for (const Case& c : {
           Case{"grows", "hard_impacts", [](int n) { return 80.0 * n; }, kNoLimit},
           Case{"goes back and forth", "hard_impacts", back_and_forth, kNoLimit},
           Case{"so do its twins", "hard_impacts", back_and_forth, kConverged, 0.06},
           Case{"drifts by less than a point each time", "contact_fraction",
                [](int n) { return 0.5677 - 0.0023 * (n - 12); }, kNoLimit},
           Case{"is nothing at all", "hard_impacts", [](int) { return 0.0; }, kConverged},
       }) {
    EXPECT_EQ(of(c.key, c.value, c.spread).convergence, c.expected) << c.what;
  }
}

TEST(FigureLimit, WithinTheToleranceIsConverged) {
  const FigureLimit f = of("mean_force", [](int n) { return 59.6 + 1e-3 * n; });
  EXPECT_EQ(f.convergence, Convergence::kConverged);
  EXPECT_NEAR(f.error.value(), -12e-3 / 59.612, 1e-9) << "the first against the last";
  EXPECT_EQ(f.left, 0.0);
}

// 1 + 3/n: 12 modes leave out 20 % of the first value; beyond 24 a tenth of it remains, exactly
// reported.
TEST(FigureLimit, ASumOverModesIsATrendWithItsRemainder) {
  const FigureLimit f = of("peak_force", [](int n) { return 1.0 + 3.0 / n; });
  EXPECT_EQ(f.convergence, Convergence::kTrend);
  EXPECT_NEAR(f.error.value(), 0.2, 1e-12);
  EXPECT_NEAR(f.left.value(), -0.1, 1e-12);
  EXPECT_NEAR(f.last_change, (3.0 / 24 - 3.0 / 20) / 1.25, 1e-12);
}

// A station without a mass: its effective mass, and every impact, falls to nothing as 1/n.
TEST(FigureLimit, WhatRunsToZeroHasNoLimit) {
  const FigureLimit f = of("peak_force", [](int n) { return 3.0 / n; });
  EXPECT_EQ(f.convergence, Convergence::kNoLimit);
  EXPECT_FALSE(f.error.has_value());
  EXPECT_FALSE(f.left.has_value());
}

TEST(FigureLimit, SharesOfTimeGoByPoints) {
  // From 2 % to 1.4 %: a third of it, but less than a point.
  const auto value = [](int n) { return 0.02 - 0.0005 * (n - 12); };
  EXPECT_EQ(of("contact_fraction", value).convergence, Convergence::kConverged);
  EXPECT_NEAR(of("contact_fraction", value).error.value(), 0.006, 1e-12);
}

// A figure that falls still falls beyond the last count, and the line says so.
TEST(FigureLimit, WhatIsToComeHasTheSignOfTheLimitLessTheLastValue) {
  ModelError error;
  error.modes = kModes;
  error.figures = {of("peak_force", [](int n) { return 1.0 + 3.0 / n; })};
  const std::string text = result::text_of(model_error_section(error));
  EXPECT_NE(
      text.find("estimated further change beyond 24 modes: impulse / step, max\n    -10.00 %"),
      std::string::npos)
      << text;
}

TEST(FigureLimit, FromNothingHasNoShare) {
  const FigureLimit from_nothing = of("hard_impacts", [](int n) { return n - 12.0; });
  EXPECT_EQ(from_nothing.convergence, Convergence::kNoLimit);
  EXPECT_FALSE(from_nothing.error.has_value()) << "no share of nothing";
}

// The ladder of modes on small scenes.

using test::shipped;

TEST(ModeLadder, RisesToTwiceTheModes) {
  EXPECT_EQ(mode_ladder(12), (std::vector<int>{12, 16, 20, 24}));
  EXPECT_EQ(mode_ladder(30), (std::vector<int>{30, 40, 50, 60}));
  EXPECT_EQ(mode_ladder(1), (std::vector<int>{1, 3, 5, 7})) << "never a rung twice";
}

// A soft rub of the rig with two modes, under control.
scene::Scene rub_scene() {
  return shipped("paper_sliding",
                 {"rotor.modes=2", "run.end=0.12", "initial.steady=false", "initial.x=[1e-6,0]"});
}

const ModelError& rub() {
  static const ModelError error = model_error(rub_scene(), {});
  return error;
}

TEST(ModelError, TellsEveryJudgedFigure) {
  ASSERT_EQ(rub().reason, "");
  EXPECT_EQ(rub().modes, (std::vector<int>{2, 4, 6, 8}));
  std::size_t judged = 0;
  for (const Figure& f : figures()) judged += f.is_judged() ? 1 : 0;
  EXPECT_LE(rub().figures.size(), judged);
  EXPECT_GE(rub().figures.size(), 7u)
      << "all but what the scene has not: a ring that turns, a controller, a near miss";
  for (const FigureLimit& f : rub().figures) EXPECT_EQ(f.values.size(), 4U);
}

TEST(ModelError, TheFirstRungIsTheNativeRunOfACompare) {
  RunRequest request;
  request.output_times = dense_times(rub_scene().run, kRows);
  const Metrics m =
      metrics(native_engine(scene::Integrator::kEvent)->run(rub_scene(), request), {});
  for (const FigureLimit& f : rub().figures)
    EXPECT_EQ(f.values[0], f.figure->value(m)) << f.figure->key;
}

TEST(ModelError, OfModalDataIsNotTold) {
  const ModelError error = model_error(shipped("bench_ring"), {});
  EXPECT_TRUE(error.figures.empty());
  EXPECT_NE(error.reason.find("modal form"), std::string::npos);
  const result::Section told = model_error_section(error);
  EXPECT_NE(
      result::text_of(told).find("not checked, because a scene in modal form has no further modes"),
      std::string::npos);
  EXPECT_TRUE(result::json_of(told).contains("reason"));
}

TEST(ModelError, OfAnInterruptedLadderNothingIsTold) {
  const std::atomic<bool> stop{true};
  ModelErrorParameters parameters;
  parameters.interrupt = &stop;
  const ModelError error = model_error(shipped("paper_sliding", {"rotor.modes=2"}), parameters);
  EXPECT_EQ(error.reason, "it was interrupted");
  EXPECT_TRUE(error.figures.empty());
}

TEST(ModelError, JsonSaysTheSame) {
  const nlohmann::json json = result::json_of(model_error_section(rub()));
  EXPECT_EQ(json.at("modes"), nlohmann::json({2, 4, 6, 8}));
  for (const FigureLimit& f : rub().figures) {
    const auto& entry = json.at("figures").at(f.figure->key);
    EXPECT_EQ(entry.at("convergence"), to_string(f.convergence));
    EXPECT_EQ(json.at(f.figure->key).is_null(), !f.error.has_value());
  }
}

}  // namespace
}  // namespace rotorub
