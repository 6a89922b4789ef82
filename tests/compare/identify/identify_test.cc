// Known values, found again from noisy records of twins.
#include "compare/identify/identify.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "compare/identify/output.h"
#include "native_model/scene/diagnostic.h"
#include "tests/compare/measurement.h"
#include "tests/support/native_run.h"

namespace rotorub::identify {
namespace {

// A rotor thrown at an elastic ring under a rotating load: some impacts, then a rub.
constexpr const char* kThrownAtTheRing = R"(
[run]
end = 0.06
[rotor]
speed = 310.0
[rotor.modal]
mass = [2.0]
stiffness = [2e5]
damping = [40.0]
[contact]
radius = 0.02
clearance = 0.5e-3
friction = 0.2
restitution = 0.4
[stator]
mass = 1.5
damping = 300.0
stiffness = 2e5
[[force]]
kind = "rotating"
amplitude = 180.0
frequency = 290.0
phase = 0.4
[initial]
x = [0.2e-3]
y = [-0.1e-3]
vx = [0.25]
vy = [0.05]
)";

// The engineer's scene, whose values differ from those of the machine.
ReadScene scene_with(const std::vector<std::string>& always = {}) {
  return [always](const std::vector<std::string>& further) {
    std::vector<std::string> all = always;
    all.insert(all.end(), further.begin(), further.end());
    return scene::parse_scene(kThrownAtTheRing, "thrown.toml", all);
  };
}

// The record of a machine with these values.
MeasuredRecord record_with(const std::vector<std::string>& machine, const test::Sensors& sensors) {
  return test::record_of(test::run_at(scene_with(machine)({}), test::instants(sensors)), sensors);
}

test::Sensors sensors(unsigned seed, double noise = 2e-6) {
  return {.from = 1e-3,
          .to = 0.059,
          .rate = 20e3,
          .shift = 0.4e-3,
          .angle = 0.3,
          .noise = noise,
          .seed = seed};
}

Parameters looking_for(std::vector<Wanted> wanted) {
  Parameters parameters;
  parameters.wanted = std::move(wanted);
  return parameters;
}

double pull(const Found& f, double truth) { return (f.value - truth) / f.error.value(); }

// Friction, restitution, clearance and the ring's mount are fitted together.
const std::vector<std::string> kMachine{"contact.friction=0.23", "contact.restitution=0.52",
                                        "contact.clearance=0.47e-3", "stator.stiffness=2.4e5"};
const std::vector<double> kTruth{0.23, 0.52, 0.47e-3, 2.4e5};
std::vector<Wanted> wanted() {
  return {{"contact.friction", "", 0.1, 0.4},
          {"contact.restitution", "", 0.2, 0.8},
          {"contact.clearance", "m", 0.4e-3, 0.6e-3},
          {"stator.stiffness", "N/m", 1e5, 4e5}};
}

TEST(Identify, WithoutNoiseFindsTheValuesThemselves) {
  const Result r =
      identify(scene_with(), record_with(kMachine, sensors(1, 0.0)), looking_for(wanted()));
  ASSERT_EQ(r.found.size(), 4u);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_NEAR(r.found[k].value / kTruth[k], 1.0, 1e-5) << r.found[k].wanted.key;
    EXPECT_FALSE(r.found[k].at_edge);
  }
  EXPECT_NEAR(r.alignment.shift, 0.4e-3, 1e-9);
  EXPECT_NEAR(r.alignment.angle, 0.3, 1e-6);
  EXPECT_LT(r.alignment.residual.value(), 1e-5);
  EXPECT_GT(r.left_before.value(), 0.02) << "the scene as it stood is another machine";
}

// Over records of different noise the error that is stated is the one that is made: its squares
// follow chi^2, of which 99.9 % lie between the bounds; and 95 % intervals hold the truth.
TEST(IdentifyNightly, StatesTheErrorsThatNoiseMakes) {
  constexpr int kSeeds = 20;
  std::vector<double> square(4, 0.0);
  int inside = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const Result r =
        identify(scene_with(), record_with(kMachine, sensors(seed)), looking_for(wanted()));
    for (std::size_t k = 0; k < 4; ++k) {
      square[k] += std::pow(pull(r.found[k], kTruth[k]), 2);
      inside += r.found[k].low() <= kTruth[k] && kTruth[k] <= r.found[k].high() ? 1 : 0;
      EXPECT_LT(r.found[k].error.value(), 0.05 * kTruth[k]) << r.found[k].wanted.key;
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_GT(square[k], 5.4) << "0.1 % of chi^2 with 20: too cautious, " << wanted()[k].key;
    EXPECT_LT(square[k], 45.3) << "99.9 %: too sure, " << wanted()[k].key;
  }
  EXPECT_GE(inside, 69) << "of 80, of which 76 are expected";
}

// The residual before and after the fit is the same measure: if the machine equals the scene, the
// residual before the fit is not smaller than after it, whichever part of the record is aligned
// with the run.
TEST(Identify, LeavesNoMoreThanTheSceneAsItStood) {
  for (const double noise : {2e-6, 20e-6}) {
    const Result r = identify(scene_with({"run.end=0.04"}), record_with({}, sensors(4, noise)),
                              looking_for({{"contact.friction", "", 0.05, 0.4}}));
    ASSERT_TRUE(r.left_before);
    EXPECT_LE(r.alignment.residual.value(), *r.left_before * (1.0 + 1e-9)) << noise;
    EXPECT_GT(r.alignment.residual.value(), 0.9 * *r.left_before) << "friction explains no noise";
    EXPECT_LT(std::abs(pull(r.found[0], 0.2)), 4.0) << r.found[0].value;
    EXPECT_FALSE(r.no_better());
  }
}

// The record is the scene's own run, so both residuals are round-off, and either may be smaller.
TEST(Identify, APerfectFitIsNotWorseThanTheScene) {
  Result r;
  r.left_before = 1e-16;
  r.alignment.residual = 1e-14;
  EXPECT_TRUE(r.is_exact());
  EXPECT_FALSE(r.no_better());
  const std::string text = text_of(result_of("record.csv", r));
  EXPECT_NE(text.find("fit the record to round-off"), std::string::npos) << text;
  r.alignment.residual = 1e-3;
  r.left_before = 1e-4;
  EXPECT_FALSE(r.is_exact());
  EXPECT_TRUE(r.no_better());
}

// If a fit is worse than its start, the output says so; here the range excludes the true value.
TEST(Identify, SaysWhenTheSceneAsItStoodIsBetter) {
  const Result r = identify(scene_with(), record_with({}, sensors(4)),
                            looking_for({{"contact.friction", "", 0.3, 0.4}}));
  EXPECT_TRUE(r.no_better());
  EXPECT_NE(text_of(result_of("record.csv", r)).find("the original scene has a smaller residual"),
            std::string::npos);
}

// A compliant contact: its stiffness follows from the depth.
TEST(Identify, FindsTheStiffnessOfAContact) {
  const std::vector<std::string> soft{"contact.compliance={stiffness=5e6,hunt_crossley=0.7}"};
  std::vector<std::string> machine = soft;
  machine.push_back("contact.compliance.stiffness=3.3e6");
  machine.push_back("contact.friction=0.25");
  const Result r = identify(scene_with(soft), record_with(machine, sensors(3)),
                            looking_for({{"contact.compliance.stiffness", "N/m", 1e6, 2e7},
                                         {"contact.friction", "", 0.1, 0.4}}));
  EXPECT_LT(std::abs(pull(r.found[0], 3.3e6)), 4.0) << r.found[0].value;
  EXPECT_LT(std::abs(pull(r.found[1], 0.25)), 4.0) << r.found[1].value;
  EXPECT_LT(r.found[0].error.value(), 0.05 * 3.3e6);
}

// A value without effect has no error, and a value at the end of its range is marked.
TEST(Identify, SaysWhatTheRecordDoesNotTell) {
  const MeasuredRecord record = record_with({"contact.friction=0.3"}, sensors(5));
  const Result r = identify(
      scene_with({"gravity={acceleration=[0.0,0.0]}"}), record,
      looking_for({{"contact.friction", "", 0.1, 0.25}, {"initial.spin_angle", "rad", 0.1, 3.0}}));
  EXPECT_TRUE(r.found[0].at_edge);
  EXPECT_NEAR(r.found[0].value, 0.25, 1e-3);
  EXPECT_FALSE(r.found[1].error);
}

TEST(Identify, IsTheSameEveryTime) {
  const MeasuredRecord record = record_with(kMachine, sensors(2));
  const Parameters parameters = looking_for({{"contact.friction", "", 0.1, 0.4}});
  const Result first = identify(scene_with(), record, parameters);
  const Result second = identify(scene_with(), record, parameters);
  EXPECT_EQ(first.found[0].value, second.found[0].value);
  EXPECT_EQ(first.found[0].error, second.found[0].error);
  EXPECT_EQ(first.runs, second.runs);
}

// Columns are aligned however long a key is.
TEST(Identify, ATableOfLongKeysIsATable) {
  Result r;
  Found f;
  f.value = f.wanted.from = 1.0;
  f.wanted.to = 2.0;
  f.error = 0.1;
  for (const auto& [key, unit] : {std::pair{"contact.friction", ""},
                                  {"contact.offset[1]", "m"},
                                  {"contact[1].stator.mount.friction_stiffness", "N/m^1.5"}}) {
    f.wanted.key = key;
    f.wanted.unit = unit;
    r.found.push_back(f);
  }
  r.alignment.residual = 0.0;
  std::istringstream table(text_of(result_of("record.csv", r)));
  std::vector<std::size_t> ends;  // of the values, which stand to the right
  for (std::string line; std::getline(table, line);) {
    if (line.find("  value  ") != line.npos) ends.push_back(line.find("value") + 5);
    if (line.find(" ± ") != line.npos) ends.push_back(line.find("  ±"));
  }
  EXPECT_EQ(ends, std::vector<std::size_t>(4, ends.at(0)));
}

}  // namespace
}  // namespace rotorub::identify
