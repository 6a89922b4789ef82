#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "native_model/control/library_file.h"
#include "native_model/run/run_native.h"
#include "native_model/run/stepwise_run.h"
#include "native_model/trajectory/columns.h"
#include "tests/support/levitated_shaft.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"

namespace rotorub {
namespace {

using test::shipped;

// The outputs that are columns of the run, at a row of it; 0 and -0 are one number.
void expect_row(StepwiseRun& plant, const Trajectory& run, std::size_t row) {
  const std::vector<double>& now = plant.now();
  std::size_t compared = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const std::string& name = plant.outputs()[i].name;
    if (!run.has(name)) continue;
    ++compared;
    ASSERT_EQ(now[i], run.column(name)[row]) << name << " at t = " << plant.time() << " s";
  }
  ASSERT_EQ(compared + 1, run.series.size()) << "all columns but the time";
}

double output(StepwiseRun& plant, const std::string& name) {
  for (std::size_t i = 0; i < plant.outputs().size(); ++i) {
    if (plant.outputs()[i].name == name) return plant.now()[i];
  }
  ADD_FAILURE() << name;
  return NAN;
}

std::size_t input(const StepwiseRun& plant, const std::string& name) {
  for (std::size_t i = 0; i < plant.inputs().size(); ++i) {
    if (plant.inputs()[i].name == name) return i;
  }
  ADD_FAILURE() << name;
  return 0;
}

std::size_t counted(const Trajectory& run) {
  return static_cast<std::size_t>(std::ranges::count_if(
      run.impacts, [](const Impact& i) { return i.gap_rate_before < kCountedGapRate; }));
}

// Every kind of part: contacts that bounce, slide and give, several of them, drives, controllers
// continuous and sampled, magnets with memories, a base that moves.
class StepwiseOfScene : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(StepwiseOfScene, GivesTheRowsOfARunToTheBit) {
  const auto& [name, end] = GetParam();
  const scene::Scene scene = shipped(name, {std::string("run.end=") + end});
  const Trajectory run = test::run_event(scene);
  StepwiseRun plant(scene);
  for (std::size_t row = 0; row < run.rows(); ++row) {
    if (row > 0) {
      // Neither the stops on the way nor reading the outputs there affect the result.
      const double from = run.column("t")[row - 1], to = run.column("t")[row];
      for (const double share : {0.137, 0.5})
        ASSERT_TRUE(plant.advance(from + share * (to - from)));
      plant.now();
      ASSERT_TRUE(plant.advance(to)) << plant.message();
    }
    expect_row(plant, run, row);
    if (HasFatalFailure()) return;
  }
  // A compliant contact counts as an impact when it is over; a run ends those that are not.
  const bool pressing =
      scene.first().contact && scene.first().contact->compliance && output(plant, "mode") != 0.0;
  EXPECT_EQ(output(plant, "impacts"), static_cast<double>(counted(run) - (pressing ? 1 : 0)));
  double impulse = 0.0;
  for (std::size_t k = 0; k < scene.auxiliary.size(); ++k) {
    if (scene.auxiliary[k].contact)
      impulse += output(plant, column_of_contact(k, "normal_impulse"));
  }
  EXPECT_NEAR(impulse, run.statistics.impulse_total, 1e-9 * (1.0 + impulse));
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, StepwiseOfScene,
    testing::Values(std::pair("bench_ring", "0.1"), std::pair("bench_drop", "0.1"),
                    std::pair("paper_passive", "0.1"), std::pair("paper_sliding", "0.1"),
                    std::pair("paper_sliding_sampled", "0.08"),
                    std::pair("paper_two_phase", "0.08"), std::pair("two_catchers", "0.1"),
                    std::pair("compliant_ring", "0.05"), std::pair("amb_machine", "0.05"),
                    std::pair("touchdown", "0.05"), std::pair("earthquake", "0.1"),
                    std::pair("blade_loss", "0.05")),
    [](const auto& scene) { return std::string(scene.param.first); });

TEST(Stepwise, ASavedStateGoesOnAsTheFirstTime) {
  for (const char* name : {"paper_passive", "paper_sliding_sampled", "two_catchers"}) {
    StepwiseRun plant(shipped(name, {"run.end=0.2"}));
    const std::size_t load = input(plant, "load_x");
    plant.set_input(load, 3.0);
    ASSERT_TRUE(plant.advance(0.1307));
    const auto saved = plant.save();
    std::vector<std::vector<double>> first;
    const auto go_on = [&](const auto& at_each) {
      for (int i = 1; i <= 60; ++i) {
        if (i == 20) plant.set_input(load, -40.0);  // in the middle of a step
        ASSERT_TRUE(plant.advance(0.1307 + 1e-3 * i)) << plant.message();
        at_each(plant.now(), static_cast<std::size_t>(i - 1));
      }
    };
    go_on([&](const auto& now, std::size_t) { first.push_back(now); });
    EXPECT_GT(first.back().back(), 0.0) << "it has met its ring";
    for (int again = 0; again < 2; ++again) {
      plant.restore(*saved);
      EXPECT_EQ(plant.time(), 0.1307);
      EXPECT_EQ(plant.input(load), 3.0);
      go_on([&](const auto& now, std::size_t row) { EXPECT_EQ(now, first[row]) << name; });
    }
  }
}

// The same loads and commands, known beforehand: there steps end where they jump, here the steps
// are truncated.
TEST(Stepwise, InputsAreTheForcesAndCommandsOfARun) {
  const scene::Scene scene = shipped("bench_ring", {"run.end=0.04", "contact.clearance=5 mm"});
  scene::Scene loaded = scene;
  loaded.forces.push_back(scene::Force{});
  loaded.forces.back().kind = scene::ForceKind::kConstant;
  loaded.forces.back().vector = {12.0, -7.0};
  loaded.forces.back().on = 0.0102;
  loaded.forces.back().off = 0.0301;
  auto commands = std::make_shared<CommandRecord>();
  commands->add(0.0153, {4.0, 9.0});
  NativeOptions options;
  options.commands = commands;
  options.integrator = scene::Integrator::kEvent;
  options.output_times = {0.04};
  const Trajectory run = run_native(loaded, options);

  StepwiseRun plant(scene);
  const auto set = [&plant](const std::string& name, double x, double y) {
    plant.set_input(input(plant, name + "_x"), x);
    plant.set_input(input(plant, name + "_y"), y);
  };
  ASSERT_TRUE(plant.advance(0.0102));
  set("load", 12.0, -7.0);
  ASSERT_TRUE(plant.advance(0.0153));
  set("command", 4.0, 9.0);
  EXPECT_EQ(output(plant, "control_y"), 9.0) << "at once";
  ASSERT_TRUE(plant.advance(0.0301));
  set("load", 0.0, 0.0);
  ASSERT_TRUE(plant.advance(0.04));
  const Trajectory without = test::run_event(scene);
  for (const char* name : {"rotor_x", "rotor_y", "stator_x", "stator_y"}) {
    EXPECT_NEAR(output(plant, name), run.column(name).back(), 1e-13) << name;
    EXPECT_GT(std::abs(run.column(name).back() - without.column(name).back()), 1e-6) << name;
  }
}

// One law in the scene, a sample late, and outside of it, where a command is taken at the next
// sample: the deflection and its difference to the last sample's, of each port.
TEST(Stepwise, MagneticBearingsTakeTheirCurrentsFromOutside) {
  constexpr double kGain = 22e3, kDifference = 2e5, kSample = 1e-4;
  const std::string bearings = R"(
[[magnetic_bearing]]
station = 0.05
negative_stiffness = 3e4
[magnetic_bearing.control]
kind = "shared"
proportional = 22e3
force_per_current = 40.0
current_limit = 3.0
[[magnetic_bearing]]
station = 0.55
sensor_station = 0.53
negative_stiffness = 3e4
[magnetic_bearing.control]
kind = "shared"
proportional = 22e3
force_per_current = 40.0
current_limit = 3.0
[magnetic_control]
sample_time = 1e-4
)";
  const scene::Scene inside = test::held_shaft(bearings + R"(delay = 1e-4
state_matrix = [0,0,0,0, 0,0,0,0, 0,0,0,0, 0,0,0,0]
input_matrix = [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1]
output_matrix = [-2e5,0,0,0, 0,-2e5,0,0, 0,0,-2e5,0, 0,0,0,-2e5]
feedthrough = [2.22e5,0,0,0, 0,2.22e5,0,0, 0,0,2.22e5,0, 0,0,0,2.22e5]
)",
                                               {"run.end=0.02", "run.output_step=1e-4"}),
                     outside = test::held_shaft(
                         bearings + "kind = \"library\"\nlibrary = \"nowhere.so\"\n",
                         {"run.end=0.02"});
  const Trajectory run = test::run_event(inside);
  set_scene_libraries(SceneLibraries::kLeftOut);
  StepwiseRun plant(outside);
  set_scene_libraries(SceneLibraries::kAsked);
  const std::vector<std::string> ports{"bearing_%_x", "bearing_%_y", "bearing2_%_x",
                                       "bearing2_%_y"};
  const auto named = [](std::string port, const char* what) {
    return port.replace(port.find('%'), 1, what);
  };
  std::map<std::string, double> last;
  for (std::size_t k = 0; k < 200; ++k) {
    for (const char* name : {"rotor_x", "rotor_y", "bearing2_current_y"})
      ASSERT_NEAR(output(plant, name), run.column(name)[k], 1e-12) << name << k;
    for (const std::string& port : ports) {
      const double seen = output(plant, named(port, "sensor"));
      plant.set_input(input(plant, named(port, "command")),
                      -(kGain + kDifference) * seen + kDifference * last[port]);
      last[port] = seen;
    }
    ASSERT_TRUE(plant.advance(static_cast<double>(k + 1) * kSample)) << plant.message();
  }
  EXPECT_GT(std::abs(run.column("bearing2_current_y").back()), 0.1) << "it has something to hold";
}

TEST(Stepwise, StopsAtEventsBeforeAndAfterThem) {
  const scene::Scene scene = shipped("bench_drop", {"run.end=0.05"});
  const Trajectory run = test::run_event(scene);
  const double restitution = scene.first().contact->restitution;
  StepwiseRun plant(scene);
  std::vector<double> met;
  while (plant.time() < 0.05 && met.size() < 5) {
    ASSERT_TRUE(plant.advance(0.05, true));
    if (!plant.event_waits()) break;
    met.push_back(plant.time());
    const double before = output(plant, "gap_rate");
    EXPECT_NEAR(output(plant, "gap"), 0.0, 1e-12);
    EXPECT_LT(before, 0.0);
    ASSERT_TRUE(plant.pass_event());
    EXPECT_EQ(plant.time(), met.back());
    EXPECT_NEAR(output(plant, "gap_rate"), -restitution * before, 1e-9 * std::abs(before));
    EXPECT_EQ(output(plant, "impacts"), static_cast<double>(met.size()));
  }
  ASSERT_EQ(met.size(), 5u);
  for (std::size_t i = 0; i < met.size(); ++i) EXPECT_EQ(met[i], run.impacts[i].t) << "to the bit";
}

TEST(Stepwise, GoesOnBeyondItsEnd) {
  const Trajectory run = test::run_event(shipped("paper_sliding_sampled", {"run.end=0.06"}));
  StepwiseRun plant(shipped("paper_sliding_sampled", {"run.end=0.02"}));
  ASSERT_TRUE(plant.advance(0.06));
  // Its first end is one more break.
  EXPECT_NEAR(output(plant, "rotor_x"), run.column("rotor_x").back(), 1e-10);
  EXPECT_NEAR(output(plant, "rotor_y"), run.column("rotor_y").back(), 1e-10);
}

TEST(Stepwise, AControllerOfTheSceneKeepsItsRing) {
  const auto has_command = [](const scene::Scene& scene) {
    const StepwiseRun plant(scene);
    return std::ranges::any_of(plant.inputs(),
                               [](const auto& port) { return port.name == "command_x"; });
  };
  EXPECT_FALSE(has_command(shipped("paper_sliding")));
  EXPECT_TRUE(has_command(shipped("paper_sliding", {"controller.kind=passive"})));
  EXPECT_FALSE(has_command(shipped("bench_drop"))) << "its ring is fixed";
}

TEST(Stepwise, ImpactsThatTakeTimeAreRefused) {
  EXPECT_EQ(test::refusals([] { StepwiseRun(shipped("finite_impacts")); }).at(0).key,
            "contact.compression_time");
}

}  // namespace
}  // namespace rotorub
