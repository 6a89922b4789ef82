#include "compare/modes/response_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/optimise/goal.h"
#include "native_model/scene/reader.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using nlohmann::json;
using test::contains;
using Complex = std::complex<double>;

// One mode.
const std::string kRotor = R"(
[run]
end = 0.1
[rotor]
speed = 250.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
)";
// Under 30 N that turn at 200 rad/s; at the second contact it is three times as large.
const std::string kTwoContacts = kRotor + R"(
[[force]]
kind = "rotating"
amplitude = 30.0
frequency = 200.0
[[contact]]
name = "near"
radius = 0.02
clearance = 0.5e-3
friction = 0.1
restitution = 0.3
[[contact]]
name = "far"
radius = 0.02
clearance = 0.6e-3
friction = 0.1
restitution = 0.3
shape = [3.0]
)";
const double kNear = 30.0 / std::abs(Complex(2e5 - 2.0 * 200.0 * 200.0, 40.0 * 200.0));
constexpr double kExact = 1e-9;  // relative

RotorAnalysis analysis_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return analyse_rotor(scene::parse_scene(text, "scene.toml", overrides), {});
}

TEST(ResponseText, OfSeveralContactsGivesEach) {
  ASSERT_LT(kNear, 0.5e-3);
  ASSERT_GT(3.0 * kNear, 0.6e-3) << "struck";
  const RotorAnalysis analysis = analysis_of(kTwoContacts);
  const json all = result::json_of(modes_result("", analysis)), speed = all["speeds"][0];
  ASSERT_EQ(speed["contacts"].size(), 2u);
  const json near = speed["contacts"][0]["response"], far = speed["contacts"][1]["response"];
  EXPECT_NEAR(near["orbit"].get<double>() / kNear, 1.0, kExact);
  EXPECT_NEAR(far["orbit"].get<double>() / kNear, 3.0, 3.0 * kExact);
  EXPECT_NEAR(far["least_gap"].get<double>(), 0.6e-3 - 3.0 * kNear, kExact);
  EXPECT_NEAR(far["vibration"].get<double>() / kNear, 6.0, 6.0 * kExact);
  EXPECT_EQ(speed["response"], near) << "the first contact's, as ever";
  EXPECT_EQ(speed["notes"], json::array());
  // What an optimisation sees: the worst of all.
  const auto path = optimise::parse_figure("modes.speeds.*.contacts.*.response.least_gap");
  EXPECT_EQ(optimise::figure_value(path, all, false), far["least_gap"].get<double>());

  const std::string table = result::text_of(modes_result("two", analysis));
  const auto near_at = table.find("free orbit at contact \"near\""),
             far_at = table.find("free orbit at contact \"far\"");
  ASSERT_TRUE(near_at != std::string::npos && far_at != std::string::npos) << table;
  EXPECT_GT(table.substr(near_at, far_at - near_at).find("more than the"), far_at) << table;
  EXPECT_NE(table.find("more than the", far_at), std::string::npos) << table;
}

TEST(ResponseText, OfOneContactIsAsItWas) {
  std::string one = kTwoContacts;
  one = one.substr(0, one.rfind("[[contact]]"));
  const RotorAnalysis analysis = analysis_of(one);
  EXPECT_FALSE(result::json_of(modes_result("", analysis))["speeds"][0].contains("contacts"));
  const std::string table = result::text_of(modes_result("one", analysis));
  EXPECT_NE(table.find("free orbit at the contact: "), std::string::npos) << table;
}

// P x + D x' under a force that turns at 200 rad/s: |P + i nu D| F / |m s^2 + k_i D s + k_i P -
// k_s|, whether there is a contact or not.
TEST(ResponseText, SaysWhereTheMagnetsCannotFollow) {
  const Complex s(0.0, 200.0);
  const double current =
      std::abs(4000.0 + 10.0 * s) * 30.0 / std::abs(2.0 * s * s + 800.0 * s + 80.0 * 4000.0 - 1e5);
  const auto notes = [&](double limit) {
    const std::string text = fmt::format(R"(
[run]
end = 0.01
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
[[force]]
kind = "rotating"
amplitude = 30.0
frequency = 200.0
[magnetic_bearing]
negative_stiffness = 1e5
[magnetic_bearing.control]
force_per_current = 80.0
proportional = 4000.0
derivative = 10.0
current_limit = {}
)",
                                         limit);
    const RotorAnalysis analysis = analysis_of(text);
    const json all = result::json_of(modes_result("", analysis))["speeds"][0]["notes"];
    EXPECT_EQ(result::text_of(modes_result("hung", analysis)).find("note: ") != std::string::npos,
              !all.empty());
    return all;
  };
  EXPECT_EQ(notes(1.001 * current), json::array());
  const json beyond = notes(0.999 * current);
  ASSERT_EQ(beyond.size(), 1u);
  const std::string note = beyond[0];
  EXPECT_EQ(note.find("the response asks the magnetic bearing for up to "), 0u) << note;
  EXPECT_NE(note.find("magnetic_bearing.control.current_limit"), std::string::npos) << note;
  EXPECT_NE(note.find("where its law is not linear"), std::string::npos) << note;
}

// A bearing that is switched on late holds the rotor as one that always works: the list of whirl
// frequencies has it, too.
TEST(ResponseText, IsOfTheMachineInOperation) {
  const auto orbit = [](const std::string& works) {
    const std::string scene = std::string(R"(
[run]
end = 0.01
[rotor]
speed = 250.0
[rotor.modal]
mass = [2.0]
stiffness = [0.0]
[gravity]
acceleration = [0.0, -9.81]
[magnetic_bearing]
negative_stiffness = 1e5
[magnetic_bearing.control]
force_per_current = 100.0
proportional = 3e3
derivative = 2.0
)") + works + R"(
[contact]
radius = 0.02
clearance = 0.5e-3
friction = 0.1
restitution = 0.3
)";
    return result::json_of(modes_result("", analysis_of(scene)))["speeds"][0]["response"]["orbit"];
  };
  const json always = orbit("");
  EXPECT_NEAR(always.get<double>(), 2.0 * 9.81 / 2e5, kExact * always.get<double>());
  EXPECT_EQ(orbit("on = 0.001"), always);
  EXPECT_EQ(orbit("fails_at = 0.002\nreturns_at = 0.004"), always);
  EXPECT_EQ(orbit("on = 0.01\nfails_at = 0.01"), nullptr) << "it never works";
}

// 0.1 kg mm of unbalance, and 0.4 kg mm more from 20 ms on.
const std::string kLostBlade = kRotor + R"(
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
  const Complex stiffness(2e5 - 2.0 * kSpeed * kSpeed, 40.0 * kSpeed);
  return unbalance * kSpeed * kSpeed / std::abs(stiffness);
}

TEST(LossText, HasTheResponseBeforeAndAfter) {
  const RotorAnalysis analysis = analysis_of(kLostBlade);
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
  const RotorAnalysis analysis = analysis_of(kLostBlade, {"force[1].on=0.0"});
  EXPECT_EQ(result::json_of(modes_result("", analysis))["speeds"][0]["response"]["before_loss"],
            nullptr);
  EXPECT_TRUE(contains(result::text_of(modes_result("whole", analysis)),
                       "free orbit at the contact: radius 413 µm"));
}

}  // namespace
}  // namespace rotorub
