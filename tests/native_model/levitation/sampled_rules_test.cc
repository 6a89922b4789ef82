// What sampled controls of magnetic bearings need, and what is refused beside them.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "native_model/model/model.h"
#include "native_model/prepare/prepare.h"
#include "native_model/scene/diagnostic.h"
#include "native_model/scene/reader.h"
#include "tests/support/jeffcott.h"
#include "tests/support/native_run.h"
#include "tests/support/said.h"

namespace rotorub {
namespace {

using test::run_with;

// Every 0.1 ms.
scene::Scene every_tenth() {
  scene::Scene s = test::make_scene({});
  s.magnetic_bearings = {scene::MagneticBearing{0.0, {1.0}, 1e5}};
  s.magnetic_bearings[0].control = scene::BearingControl{
      .force_per_current = 80.0, .proportional = 4000.0, .derivative = 2.0, .sample_time = 1e-4};
  s.run.end = 0.01;
  return s;
}

TEST(SampledMagneticControl, StepsMeetItsSamples) {
  const Trajectory t = run_with(every_tenth(), scene::Integrator::kVerlet, 3e-5);
  EXPECT_EQ(t.status, Status::kStepTooLarge);
  EXPECT_TRUE(test::contains(t.message, "does not meet the samples"));
  scene::Scene s = every_tenth();
  s.initial.steady = true;
  EXPECT_THROW(prepare(s), scene::SceneError);
}

TEST(SampledMagneticControl, SaysWhatItNeeds) {
  const std::string text = R"(
[run]
end = 0.01
[rotor.modal]
mass = [2.0]
stiffness = [1e5]
[[magnetic_bearing]]
negative_stiffness = 3e4
control = {force_per_current = 40.0, proportional = 3000.0, sample_time = "0.1 ms"}
)";
  const auto reason = [&](const std::string& control, const std::string& shared) {
    std::vector<std::string> overrides{"magnetic_bearing[0].control={force_per_current=40.0," +
                                       control + "}"};
    if (!shared.empty()) overrides.push_back("magnetic_control={" + shared + "}");
    return test::message_of<scene::SceneError>(
        [&] { scene::parse_scene(text, "bad.toml", overrides); });
  };
  const std::string four = "input_matrix=[1,0],output_matrix=[1,0],feedthrough=[3e3,0,0,3e3]";
  EXPECT_EQ(reason("kind='shared'", "sample_time=1e-4,state_matrix=[0.5]," + four), "");
  EXPECT_EQ(reason("kind='transfer_function',sample_time=1e-4,numerator=[3e3],denominator=[1]", ""),
            "");
  const struct {
    std::string control, shared;
    const char* expected;
  } cases[] = {
      {"kind='shared'", "", "needs [magnetic_control]"},
      {"proportional=3e3", "sample_time=1e-4,state_matrix=[0.5]," + four,
       "no magnetic bearing has a control of kind \"shared\""},
      {"kind='shared'", "sample_time=1e-4,state_matrix=[0.5,1]," + four,
       "expected n times n values"},
      {"kind='shared'", "sample_time=1e-4,state_matrix=[1,2,3,4]," + four,
       "expected 4 values, 2 times 2"},
      {"kind='shared'", "sample_time=1e-4,delay=1.5e-4,state_matrix=[0.5]," + four,
       "a whole number of them"},
      {"derivative=1", "", "missing: expected a current per length"},
      {"proportional=3e3,delay=1e-4", "", "needs magnetic_bearing[0].control.sample_time"},
      {"kind='transfer_function',numerator=[3e3],denominator=[1]", "",
       "missing: expected a time in s, > 0"},
      {"kind='transfer_function',sample_time=1e-4,numerator=[3e3],denominator=[0,1]", "",
       "a first value that is not 0"},
      {"kind='state_space',sample_time=1e-4,state_matrix=[0.5],input_matrix=[1,2],"
       "output_matrix=[1],feedthrough=[3e3]",
       "", "expected 1 values, 1 times 1"},
      {"kind='state_space',sample_time=1e-4,state_matrix=[0.5],input_matrix=[1],output_matrix=[1],"
       "feedthrough=[3e3],derivative=1",
       "", "derivative"},
  };
  for (const auto& c : cases) {
    EXPECT_TRUE(test::contains(reason(c.control, c.shared), c.expected)) << c.control;
  }
}

}  // namespace
}  // namespace rotorub
