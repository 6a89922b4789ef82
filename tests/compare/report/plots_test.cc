// The report's figures beyond series: the characteristics, and the laws of each impact.

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "compare/report/plots.h"
#include "compare/study/scene_comparison.h"
#include "tests/support/native_run.h"

namespace rotorub {
namespace {

SceneComparison ring_compared(const std::vector<std::string>& overrides) {
  CompareOptions options;
  options.timing_repeats = 1;
  options.twins = 1;
  options.modes_ladder = false;
  return compare_scene(test::shipped("bench_ring", overrides), options);
}

TEST(Characteristics, AreTheLawsOwn) {
  const scene::Scene magnetic = test::shipped("paper_magnetic");
  const nlohmann::json curves = actuator_curves(magnetic, 0);
  ASSERT_EQ(curves.size(), 5U);
  // F(0, i) = 4 k_m i_0 i / s_0^2 in the middle, exactly linear there.
  const double slope = 4.0 * 416.7e-6 * 3.0 / (5e-3 * 5e-3);
  for (std::size_t k = 0; k < curves[2]["x"].size(); ++k) {
    const double i = curves[2]["x"][k];
    EXPECT_NEAR(curves[2]["y"][k].get<double>(), slope * i, 1e-3) << i;
  }
  EXPECT_EQ(curves[2]["x"].back(), 3.0);
  EXPECT_TRUE(actuator_curves(test::shipped("paper_passive"), 0).empty());
  const nlohmann::json motor = motor_curve(magnetic, 300.0, 320.0);
  const double target = 100.0 * std::numbers::pi;
  EXPECT_NEAR(motor["y"].front().get<double>(), 0.5 * (target - 300.0), 1e-4);
  EXPECT_NEAR(motor["x"].back().get<double>(), 320.0 * 30.0 / std::numbers::pi, 0.01);
  EXPECT_TRUE(motor_curve(test::shipped("run_up"), 300.0, 320.0).is_null())
      << "it follows its reference";
}

// Of a run that slides through all its impacts each lies on Coulomb's law and on Poisson's.
TEST(ImpactPlots, LieOnTheLawsThatTheyAreOf) {
  const SceneComparison c = ring_compared({"run.end=0.012"});
  EXPECT_FALSE(c.uncontrolled) << "no controller";
  const nlohmann::json data = plot_data(shown_runs(c));
  const nlohmann::json& impacts = data["sides"][0]["impacts"][0];
  EXPECT_EQ(data["contacts"][0]["friction"], 0.15);
  ASSERT_GE(impacts["t"].size(), 4U);
  for (std::size_t k = 0; k < impacts["t"].size(); ++k) {
    EXPECT_GT(impacts["slip"][k].get<double>(), 0.0);
    EXPECT_NEAR(impacts["after"][k].get<double>(), -0.5 * impacts["before"][k].get<double>(),
                1e-4 * std::abs(impacts["before"][k].get<double>()) + 1e-9);
    EXPECT_NEAR(impacts["friction"][k].get<double>(), -0.15 * impacts["normal"][k].get<double>(),
                1e-4 * impacts["normal"][k].get<double>());
  }
}

// The run without control is the passive bearing's: nothing is commanded.
TEST(ImpactPlots, ShowTheRunWithoutControl) {
  const SceneComparison c =
      ring_compared({"run.end=0.006", "controller.kind=passive", "controller.stiffness=5e4",
                     "controller.damping=100", "controller.on=0.005"});
  ASSERT_TRUE(c.uncontrolled);
  EXPECT_FALSE(c.uncontrolled->has("control_x") &&
               c.uncontrolled->column("control_x").back() != 0.0);
  EXPECT_FALSE(plot_data(shown_runs(c))["uncontrolled"]["rotor"].empty());
}

}  // namespace
}  // namespace rotorub
