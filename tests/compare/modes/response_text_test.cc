#include "compare/modes/response_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <nlohmann/json.hpp>
#include <string>

#include "compare/modes/result.h"
#include "compare/modes/rotor_analysis.h"
#include "compare/optimise/goal.h"
#include "native_model/scene/reader.h"

namespace rotorub {
namespace {

using nlohmann::json;
using Complex = std::complex<double>;

// One mode under 30 N that turn at 200 rad/s; at the second contact it is three times as large.
constexpr const char* kTwoContacts = R"(
[run]
end = 0.01
[rotor]
speed = 250.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
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

RotorAnalysis analysis_of(const char* text) {
  return analyse_rotor(scene::parse_scene(text, "scene.toml", {}), {});
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
  const RotorAnalysis analysis = analysis_of(one.c_str());
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
    const RotorAnalysis analysis = analysis_of(text.c_str());
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
    return result::json_of(
        modes_result("", analysis_of(scene.c_str())))["speeds"][0]["response"]["orbit"];
  };
  const json always = orbit("");
  EXPECT_NEAR(always.get<double>(), 2.0 * 9.81 / 2e5, kExact * always.get<double>());
  EXPECT_EQ(orbit("on = 0.001"), always);
  EXPECT_EQ(orbit("fails_at = 0.002\nreturns_at = 0.004"), always);
  EXPECT_EQ(orbit("on = 0.01\nfails_at = 0.01"), nullptr) << "it never works";
}

}  // namespace
}  // namespace rotorub
