// The ladder of modes on small scenes.
#include "compare/model_error/model_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "compare/engine/engine.h"
#include "compare/metrics/metrics.h"
#include "compare/metrics/rows.h"
#include "compare/model_error/json.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub {
namespace {

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

const FigureLimit& limit_of(const char* key) {
  for (const FigureLimit& f : rub().figures) {
    if (f.figure == &figure(key)) return f;
  }
  throw std::out_of_range(key);
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
      metrics(native_engine(scene::Integrator::kEvent)->run(rub_scene(), request), std::nullopt);
  for (const FigureLimit& f : rub().figures)
    EXPECT_EQ(f.values[0], f.figure->value(m)) << f.figure->key;
}

// The rotor is lighter at the contact with every mode: so are its impacts.
TEST(ModelError, ImpactsHangOnTheModesAndMeanForceDoesNot) {
  EXPECT_NE(limit_of("window_impulse").convergence, Convergence::kConverged);
  const auto& peak = limit_of("window_impulse").values;
  EXPECT_TRUE(std::is_sorted(peak.rbegin(), peak.rend())) << "lighter with every mode";
  EXPECT_LT(std::abs(limit_of("lasting_fraction").last_change), 0.01);
}

TEST(ModelError, OfModalDataIsNotTold) {
  const ModelError error = model_error(shipped("bench_ring"), {});
  EXPECT_TRUE(error.figures.empty());
  EXPECT_NE(error.reason.find("modal form"), std::string::npos);
  EXPECT_NE(model_error_table(error, "  ").find("not known: modal form"), std::string::npos);
  EXPECT_TRUE(model_error_json(error).contains("reason"));
}

TEST(ModelError, OfAnInterruptedLadderNothingIsTold) {
  const std::atomic<bool> stop{true};
  ModelErrorParameters parameters;
  parameters.interrupt = &stop;
  const ModelError error = model_error(shipped("paper_sliding", {"rotor.modes=2"}), parameters);
  EXPECT_EQ(error.reason, "interrupted");
  EXPECT_TRUE(error.figures.empty());
}

TEST(ModelError, JsonSaysTheSame) {
  const nlohmann::json json = model_error_json(rub());
  EXPECT_EQ(json.at("modes"), nlohmann::json({2, 4, 6, 8}));
  for (const FigureLimit& f : rub().figures) {
    const auto& entry = json.at("figures").at(f.figure->key);
    EXPECT_EQ(entry.at("convergence"), to_string(f.convergence));
    EXPECT_EQ(json.at(f.figure->key).is_null(), !f.error.has_value());
  }
}

}  // namespace
}  // namespace rotorub
