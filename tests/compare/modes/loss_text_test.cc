// The response of a rotor that loses a blade is told before and after the loss.
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "native_model/scene/reader.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using nlohmann::json;
using test::contains;

// One mode of 2 kg, 2e5 N/m and 40 N s/m at 250 rad/s, 0.1 kg mm of unbalance, and 0.4 kg mm more
// from 20 ms on.
constexpr const char* kScene = R"(
[run]
end = 0.1
[rotor]
speed = 250.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[[force]]
kind = "unbalance"
static_moment = 1e-4
[[force]]
kind = "unbalance"
static_moment = 4e-4
on = 0.02
[contact]
radius = 0.02
clearance = 0.3e-3
friction = 0.1
restitution = 0.3
)";
// m, of an unbalance in kg m.
double deflection(double unbalance) {
  constexpr double kSpeed = 250.0;
  const std::complex<double> stiffness(2e5 - 2.0 * kSpeed * kSpeed, 40.0 * kSpeed);
  return unbalance * kSpeed * kSpeed / std::abs(stiffness);
}

TEST(LossText, HasTheResponseBeforeAndAfter) {
  const scene::Scene scene = scene::parse_scene(kScene, "scene.toml", {});
  const RotorAnalysis analysis = analyse_rotor(scene, {});
  const json response = result::json_of(modes_result("", analysis))["speeds"][0]["response"];
  EXPECT_NEAR(response["orbit"].get<double>(), deflection(5e-4), 1e-9 * deflection(5e-4));
  const json before = response["before_loss"];
  EXPECT_NEAR(before["orbit"].get<double>(), deflection(1e-4), 1e-9 * deflection(1e-4));
  EXPECT_NEAR(before["least_gap"].get<double>(), 0.3e-3 - deflection(1e-4), 1e-12);

  // Without the line breaks.
  std::istringstream words(result::text_of(modes_result("blade", analysis)));
  std::string table;
  for (std::string word; words >> word;) table += word + " ";
  EXPECT_TRUE(contains(
      table, {"free orbit at the contact before the loss: radius 82.6 µm, least gap 217.4 µm",
              "free orbit at the contact after the loss: radius 413 µm, 113 µm "
              "more than the clearance",
              "API 617 allows 25.4 µm (at the probes near the bearings)"}));
  // The limit of API 617 holds for the whole machine.
  EXPECT_EQ(table.find("vibration at the contact"), table.rfind("vibration at the contact"));
}

TEST(LossText, IsOneResponseWhereNothingIsLost) {
  const std::vector<std::string> at_once{"force[1].on=0.0"};
  const scene::Scene scene = scene::parse_scene(kScene, "scene.toml", at_once);
  const RotorAnalysis analysis = analyse_rotor(scene, {});
  EXPECT_EQ(result::json_of(modes_result("", analysis))["speeds"][0]["response"]["before_loss"],
            nullptr);
  EXPECT_TRUE(contains(result::text_of(modes_result("whole", analysis)),
                       "free orbit at the contact: radius 413 µm"));
}

}  // namespace
}  // namespace rotorub
