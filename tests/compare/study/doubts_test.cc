#include "compare/run_files/doubts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "native_model/scene/reader.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

scene::Scene scene_with(const std::string& speed, const std::string& contact) {
  return scene::parse_scene(
      "[run]\nend = 0.1\n[rotor]\nspeed = " + speed +
          "\n[rotor.modal]\nmass = [2.0]\nstiffness = [2e5]\ndamping = [40.0]\n"
          "[contact]\nradius = 0.05\nrestitution = 0.5\n" +
          contact,
      "made.toml");
}

// The only doubt in a list of one.
std::string only(const std::vector<std::string>& all) {
  EXPECT_EQ(all.size(), 1U);
  return all.empty() ? "" : all.front();
}

TEST(Doubts, NameWhatIsHardlyMeantWithItsKey) {
  const auto of = [](const std::string& speed, const std::string& contact) {
    return doubts(scene_with(speed, contact));
  };
  EXPECT_TRUE(of("\"50 Hz\"", "clearance = \"0.5 mm\"\nfriction = 0.15\n").empty());
  // 0.4 instead of 0.4 mm.
  EXPECT_TRUE(only(of("\"50 Hz\"", "clearance = 0.4\nfriction = 0.15\n"))
                  .starts_with("contact.clearance = 0.4 m is 8 times"));
  // rpm instead of rad/s.
  EXPECT_TRUE(
      test::contains(only(of("36000", "clearance = \"0.5 mm\"\nfriction = 0.15\n")), "1800 m/s"));
  EXPECT_EQ(of("0.0", "clearance = 0.4\nfriction = 15.0\n").size(), 2U);
}

TEST(Doubts, NameALawThatNeverActs) {
  const auto of = [](const std::string& law) {
    return doubts(scene_with("\"50 Hz\"",
                             "clearance = \"0.5 mm\"\nfriction = 0.15\n[stator]\nmass = 1.0\n"
                             "stiffness = 1e5\ndamping = 100.0\n[controller]\nkind = \"pd\"\n" +
                                 law));
  };
  EXPECT_TRUE(of("on = 0.05\nsample_time = 1e-4\n").empty());
  EXPECT_TRUE(only(of("on = 0.1\n")).starts_with("controller.on = 0.1 s"));
  EXPECT_TRUE(only(of("sample_time = 10.0\n")).starts_with("controller.sample_time = 10 s"));
}

// Seconds instead of milliseconds: "no contact" would be misleading.
TEST(Doubts, NameAnInstantFarBeyondTheEnd) {
  const auto of = [](const std::string& loads) {
    return doubts(scene_with("\"50 Hz\"", "clearance = \"0.5 mm\"\nfriction = 0.15\n" + loads));
  };
  const std::string force = "[[force]]\nkind = \"constant\"\nvector = [1.0, 0.0]\n";
  EXPECT_TRUE(of(force + "on = 0.2\n").empty()) << "a run that is cut short";
  EXPECT_TRUE(
      only(of(force + "on = 20.0\n")).starts_with("force[0].on = 20 s: the run ends at 0.1 s"));
  const std::string fails =
      only(of("[magnetic_bearing]\nnegative_stiffness = 1e4\n[magnetic_bearing.control]\n"
              "force_per_current = 100.0\nproportional = 4000.0\nderivative = 3.0\n"
              "fails_at = 20.0\n"));
  EXPECT_TRUE(fails.starts_with("magnetic_bearing.control.fails_at = 20 s")) << fails;
}

// 4000 rpm instead of rad/s: 1204 rad/s are below the whole table.
TEST(Doubts, NameATableThatTheSpeedIsOutsideOf) {
  const auto of = [](const std::string& speeds) {
    return doubts(scene::parse_scene(
        "[run]\nend = 0.1\n[rotor]\nspeed = 1204.0\nlength = 1.0\nE = 2.1e11\nrho = 7850.0\n"
        "nu = 0.3\nmodes = 2\n[[rotor.section]]\nfrom = 0.0\nto = 1.0\ndiameter = 0.06\n"
        "[[rotor.bearing]]\nz = 0.1\nstiffness = 1e7\n[[rotor.bearing]]\nz = 0.9\n"
        "table_speed = " +
            speeds + "\ntable_kxx = [1e7, 2e7]\n",
        "made.toml"));
  };
  EXPECT_TRUE(of("[\"4000 rpm\", \"14000 rpm\"]").empty());
  EXPECT_TRUE(only(of("[4000.0, 14000.0]"))
                  .starts_with("rotor.bearing[1].table_speed runs from 4000 to 14000 rad/s"));
}

TEST(Doubts, NameAnActuatorAtItsLimit) {
  const scene::Scene scene =
      scene_with("\"50 Hz\"",
                 "clearance = \"0.5 mm\"\nfriction = 0.15\n[stator]\nmass = 1.0\nstiffness = 1e5\n"
                 "damping = 100.0\n[actuator]\nforce_limit = 100.0\n[controller]\nkind = \"pd\"\n");
  Trajectory run;
  const double limit = 100.0 / std::sqrt(2.0);  // along x and y, with one axis at its limit
  run.series = {{"control_x", "N", {0.0, 0.0, limit, 50.0}},
                {"control_y", "N", {0.0, 0.0, -limit, 20.0}}};
  EXPECT_TRUE(doubts(scene, run).empty()) << "half of the time";
  run.series[0].values = {0.0, limit, limit, 50.0};
  run.series[1].values = {0.0, -limit, limit, 20.0};
  EXPECT_EQ(only(doubts(scene, run)),
            "the actuator is at its limit of 100 N (actuator.force_limit) for 67 % of the time "
            "since switch-on");
}

// A shaft of 1.4 m and 90 mm, with one key changed.
std::vector<std::string> doubts_of_shaft(const std::string& change) {
  return doubts(scene::parse_scene(R"(
[run]
end = 0.1
[rotor]
speed = "50 Hz"
length = "1.4 m"
E = "210 GPa"
rho = 7850.0
nu = 0.3
modes = 2
[[rotor.section]]
from = 0.0
to = "1.4 m"
diameter = "90 mm"
[[rotor.disc]]
z = 0.7
diameter = "0.4 m"
thickness = "50 mm"
[[rotor.bearing]]
z = 0.1
stiffness = 1e7
[[rotor.bearing]]
z = 1.3
stiffness = 1e7
[contact]
station = 0.7
radius = "45 mm"
clearance = "0.3 mm"
friction = 0.15
restitution = 0.5
)",
                                   "made.toml", std::vector<std::string>{change}));
}

// Millimetres as metres.
TEST(Doubts, NameALengthWithoutItsUnit) {
  EXPECT_TRUE(doubts_of_shaft("rotor.disc[0].diameter=\"2 m\"").empty()) << "a flywheel";
  EXPECT_EQ(only(doubts_of_shaft("rotor.section[0].diameter=\"90\"")),
            "rotor.section[0].diameter = 90 m is larger than rotor.length = 1.4 m (a unit may be "
            "missing: \"90 mm\")");
  EXPECT_EQ(only(doubts_of_shaft("rotor.section[0].end_diameter=80")),
            "rotor.section[0].end_diameter = 80 m is larger than rotor.length = 1.4 m (a unit may "
            "be missing: \"80 mm\")");
  EXPECT_EQ(only(doubts_of_shaft("rotor.disc[0].diameter=400")),
            "rotor.disc[0].diameter = 400 m is larger than 10 times rotor.length = 1.4 m (a unit "
            "may be missing: \"400 mm\")");
  EXPECT_EQ(only(doubts_of_shaft("rotor.disc[0].thickness=\"50\"")),
            "rotor.disc[0].thickness = 50 m is larger than rotor.length = 1.4 m (a unit may be "
            "missing: \"50 mm\")");
  const auto of_radius = doubts_of_shaft("contact.radius=45.0");
  ASSERT_EQ(of_radius.size(), 2U) << "also for the speed of its surface";
  EXPECT_EQ(of_radius.back(),
            "contact.radius = 45 m is larger than 10 times rotor.length = 1.4 m (a unit may be "
            "missing: \"45 mm\")");
  EXPECT_TRUE(only(doubts_of_shaft("rotor.disc[0].eccentricity=20.0"))
                  .ends_with("(a unit may be missing: \"20 µm\")"));
}

TEST(Doubts, NameAShaftOfAThousandMetres) {
  const auto of = [](const std::string& length) {
    return doubts(scene::parse_scene(
        "[run]\nend = 0.1\n[rotor]\nlength = " + length +
            "\nE = 2.1e11\nrho = 7850.0\nnu = 0.3\nmodes = 2\n[[rotor.section]]\nfrom = 0.0\nto "
            "= " +
            length +
            "\ndiameter = 0.09\n[[rotor.bearing]]\nz = 0.1\nstiffness = 1e7\n"
            "[[rotor.bearing]]\nz = 0.3\nstiffness = 1e7\n",
        "made.toml"));
  };
  EXPECT_TRUE(of("1.4").empty());
  EXPECT_EQ(only(of("1400.0")),
            "rotor.length = 1400 m is unusually long (a unit may be missing: \"1400 mm\")");
}

TEST(Doubts, NameEnergyThatDoesNotAddUp) {
  const auto scene = scene_with("\"50 Hz\"", "clearance = \"0.5 mm\"\nfriction = 0.15\n");
  Trajectory run;
  run.engine = "native";
  run.step = 1e-5;
  run.statistics.energy_scale = 2.0;
  run.statistics.energy_end = 0.01;
  EXPECT_TRUE(doubts(scene, run).empty()) << "0.5 %";
  run.statistics.energy_end = 0.1;
  EXPECT_TRUE(only(doubts(scene, run)).starts_with("energy balance"));
  run.engine = "mujoco";
  EXPECT_TRUE(doubts(scene, run).empty()) << "its soft contacts have an energy of their own";
}

// A run that such a loop ended says which motion grows, and so does one that it has not ended yet.
TEST(Doubts, NameAnUnstableLoopThatARunShows) {
  const auto of = [](const std::string& gain, Status status, double first_touch) {
    const auto scene = scene_with("\"50 Hz\"",
                                  "clearance = \"0.5 mm\"\nfriction = 0.15\n"
                                  "[magnetic_bearing]\nnegative_stiffness = 1e6\n"
                                  "[magnetic_bearing.control]\nforce_per_current = 80\n"
                                  "derivative = 2\nproportional = " +
                                      gain);
    Trajectory run;
    run.engine = "native";
    run.end = 0.1;
    run.status = status;
    run.statistics.first_touch = first_touch;
    return doubts(scene, run);
  };
  for (const auto& [status, touch] :
       {std::pair(Status::kOutOfRange, 0.01), std::pair(Status::kNoSolution, 0.01),
        std::pair(Status::kOk, -1.0)}) {
    const std::string doubt = only(of("100", status, touch));
    EXPECT_TRUE(
        doubt.starts_with("The closed loop of the magnetic bearings is unstable at 3000 "
                          "rpm: a motion without oscillation grows at "))
        << doubt;
    EXPECT_NE(doubt.find("`rotorub modes`"), std::string::npos) << doubt;
    EXPECT_TRUE(of("20000", status, touch).empty()) << "stable";
  }
  EXPECT_TRUE(of("100", Status::kOk, 0.01).empty()) << "it rubs, and its summary shows that";
}

}  // namespace
}  // namespace rotorub
