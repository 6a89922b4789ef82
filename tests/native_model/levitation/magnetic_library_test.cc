// A user's law for magnetic bearings from a library: the bits of the same law by matrices, its
// measurements, failures and refusals.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "native_model/control/library.h"
#include "native_model/linear/levitation.h"
#include "native_model/prepare/prepare.h"
#include "native_model/run/run_native.h"
#include "native_model/scene/reader.h"
#include "tests/support/native_run.h"
#include "tests/support/refusal.h"
#include "tests/support/said.h"
#include "tests/support/temporary_folder.h"

namespace rotorub {
namespace {

using scene::Integrator;
constexpr Integrator kAll[] = {Integrator::kEvent, Integrator::kVerlet, Integrator::kEuler};

// The tests open only their own libraries.
class TrustingMagnets : public testing::Environment {
 public:
  void SetUp() override { set_scene_libraries(SceneLibraries::kAllowed); }
};
[[maybe_unused]] const auto* const magnets_trust =
    testing::AddGlobalTestEnvironment(new TrustingMagnets);

// Two modes in two bearings, one behind an amplifier, one of two magnets sensed elsewhere; the
// limit of the first is reached.
std::string text(const std::string& control) {
  return R"([run]
end = 0.02
step = 1e-5
output_step = 0.2e-3
[rotor]
speed = 200.0
[rotor.modal]
mass = [2.0, 0.7]
stiffness = [1e5, 9e5]
damping = [30.0, 20.0]
gyroscopic = [0.05, 0.02]
[magnetic_control]
sample_time = 2e-4
)" + control +
         R"(
[[magnetic_bearing]]
shape = [0.9, 0.4]
negative_stiffness = 3e4
[magnetic_bearing.control]
kind = "shared"
force_per_current = 40.0
current_limit = 0.3
[magnetic_bearing.amplifier]
bandwidth = 4000.0
[[magnetic_bearing]]
kind = "electromagnet"
shape = [0.5, -0.6]
sensor_shape = [0.4, -0.7]
force_constant = 1e-5
bias_current = 2.0
air_gap = 1e-3
[magnetic_bearing.control]
kind = "shared"
[initial]
x = [1e-4, -2e-5]
vy = [0.05, 0.02]
)";
}
const std::string kDelay = "delay = 2e-4\n";
const std::string kMatrices = R"(state_matrix = [0.5, 0.1, -0.2, 0.3]
input_matrix = [1.0, 0.2, 0.0, -0.4, 0.1, 1.0, 0.3, 0.0]
output_matrix = [150.0, -40.0, 30.0, 160.0, -120.0, 20.0, 50.0, 60.0]
feedthrough = [2500.0, 0.0, 200.0, 30.0, 0.0, 2500.0, -30.0, 200.0,
               150.0, 0.0, 1800.0, 0.0, 0.0, 150.0, 0.0, 1800.0]
)";
std::string by_library(const std::string& more = {},
                       const std::string& library = "magnetic_controller.so") {
  return "kind = \"library\"\nlibrary = \"" + library + "\"\n[magnetic_control.config]\n" +
         R"(a = "0.5 0.1 -0.2 0.3"
b = "1.0 0.2 0.0 -0.4 0.1 1.0 0.3 0.0"
c = "150.0 -40.0 30.0 160.0 -120.0 20.0 50.0 60.0"
d = "2500.0 0.0 200.0 30.0 0.0 2500.0 -30.0 200.0 150.0 0.0 1800.0 0.0 0.0 150.0 0.0 1800.0"
)" + more;
}

scene::Scene read(const std::string& control) {
  scene::Scene s = scene::parse_scene(text(control), "magnets.toml", {});
  s.folder = ROTORUB_LIBRARIES;
  return s;
}

TEST(MagneticLibrary, TheSameLawGivesTheSameBits) {
  for (const std::string& delay : {std::string(), kDelay}) {
    for (const Integrator integrator : kAll) {
      const Trajectory a = test::run_with(read(delay + kMatrices), integrator),
                       b = test::run_with(read(delay + by_library()), integrator);
      ASSERT_EQ(a.series.size(), b.series.size());
      for (std::size_t c = 0; c < a.series.size(); ++c) {
        EXPECT_EQ(a.series[c].values, b.series[c].values)
            << a.integrator << " " << a.series[c].name;
      }
      EXPECT_GT(test::largest_size(a, "bearing_current_x"), 0.1) << "and it does something";
    }
  }
}

TEST(MagneticLibrary, TheSameLawInPythonGivesTheSameBits) {
  const test::TemporaryFolder folder;
  const std::string file = folder
                               .write("magnets.py", R"(
def create(setup):
    law = {key: [float(x) for x in text.split()] for key, text in setup["config"].items()}
    assert setup["ports"] == 4 and setup["delay"] == 2e-4 and setup["sample_time"] == 2e-4
    assert setup["bearings"][0]["bandwidth"] == 4000.0
    assert setup["bearings"][1]["current_limit"] == 2.0
    assert setup["bearings"][1]["bandwidth"] == float("inf")
    return law
def state_size(law):
    return 2
def row(matrix, i, of):
    total = 0.0
    for j, value in enumerate(of):
        total += matrix[i * len(of) + j] * value
    return total
def step(law, now, state):
    r = now["deflection"]
    current = [-(row(law["c"], i, state) + row(law["d"], i, r)) for i in range(4)]
    state[0], state[1] = [row(law["a"], i, state) + row(law["b"], i, r) for i in range(2)]
    return current
)")
                               .string();
  for (const Integrator integrator : kAll) {
    const Trajectory a = test::run_with(read(kDelay + kMatrices), integrator),
                     b = test::run_with(read(kDelay + by_library("", file)), integrator);
    ASSERT_EQ(a.series.size(), b.series.size());
    for (std::size_t c = 0; c < a.series.size(); ++c)
      EXPECT_EQ(a.series[c].values, b.series[c].values) << a.integrator << " " << a.series[c].name;
  }
}

// The currents are the law's measurements, as far as they are within the limit of 2 A of the
// second.
TEST(MagneticLibrary, IsShownTimeSpinAndCurrents) {
  const auto current = [](const std::string& what, Integrator integrator) {
    scene::Scene s = read(by_library("show = \"" + what + "\"\n"));
    s.run.end = 1.1e-3;
    s.run.output_times = {0.1e-3, 0.3e-3, 0.5e-3, 0.7e-3, 0.9e-3};
    s.run.output_step.reset();
    s.rotor.speed = 1.5;
    s.magnetic_bearings[0].amplifier.reset();
    s.magnetic_bearings[0].control->current_limit = 1.9;
    NativeOptions options;
    options.integrator = integrator;
    options.output_times = s.run.output_times;
    const Trajectory t = test::complete(run_native(s, options));
    return t.column("bearing_current_y");
  };
  for (const Integrator integrator : kAll) {
    const auto near = [&](const std::string& what, const std::vector<double>& expected) {
      const std::vector<double> got = current(what, integrator);
      ASSERT_EQ(got.size(), expected.size());
      for (std::size_t k = 0; k < got.size(); ++k)
        EXPECT_NEAR(got[k], expected[k], 1e-12) << what << " " << k;
    };
    near("t", {0.0, 2e-4, 4e-4, 6e-4, 8e-4});
    near("sample", {0.0, 1.0, 1.9, 1.9, 1.9});
    near("spin_speed", {1.5, 1.5, 1.5, 1.5, 1.5});
    near("spin_angle", {0.0, 3e-4, 6e-4, 9e-4, 12e-4});
    near("current", {1.0, 1.5, 1.75, 1.875, 1.9});
  }
}

TEST(MagneticLibrary, IsToldItsBearings) {
  const std::string said =
      to_string(test::refusal(read(kDelay + by_library("fault = \"create\"\n"))));
  // k_i = 4 k_m i_0/s_0^2, k_s = 4 k_m i_0^2/s_0^3.
  EXPECT_TRUE(
      test::contains(said, {"magnetic refuses: 1 4 0.0002 0.0002: 80 160000 2 1e-05 2 0.001 inf",
                            "magnetic_control.config", "magnets.toml:"}));
}

TEST(MagneticLibrary, AFailureEndsTheRunWithNameAndTime) {
  const std::pair<std::string, const char*> faults[] = {{"step", "the encoder is lost"},
                                                        {"nan", "its command is not finite"},
                                                        {"nan state", "its state is not finite"},
                                                        {"throw", "thrown in step"}};
  for (const auto& [fault, word] : faults) {
    for (const double at : {0.0, 0.004}) {
      for (const Integrator integrator : kAll) {
        const scene::Scene s =
            read(by_library("fault = \"" + fault + "\"\nat = " + std::to_string(at) + "\n"));
        const Trajectory t = test::attempt_with(s, integrator);
        EXPECT_EQ(t.status, Status::kControllerFailed) << t.integrator << " " << t.message;
        EXPECT_TRUE(
            test::contains(t.message, {"controller magnetic", at > 0.0 ? "0.004" : "0.000", word}));
        EXPECT_NEAR(t.end, at, 1.1e-5) << t.integrator;
        EXPECT_GE(t.rows(), 1u);
      }
    }
  }
}

TEST(MagneticLibrary, RefusalsNameKeyAndReason) {
  const struct {
    std::string control;
    std::vector<std::string> words;
  } cases[] = {
      {by_library("", "nowhere.so"), {"magnetic_control.library", "not found", "magnets.toml:"}},
      {by_library("", "recording_controller.so"),
       {"magnetic_control.library",
        "recording_controller.so commands a ring (rotorub_controller_get)",
        "Set [controller] kind = \"library\""}},
      {by_library("", "librotorub_final_state.so"),
       {"librotorub_final_state.so does not export rotorub_magnetic_controller_get"}},
      {by_library("", "other_abi_magnetic_controller.so"),
       {"magnetic_control.library", "4712", "needs ABI 1", "Rebuild it"}},
      {by_library("fault = \"huge\"\n"),
       {"magnetic_control.library", "a state of 65 numbers is too large; the limit is 64"}}};
  for (const auto& c : cases) {
    const std::string said = to_string(test::refusal(read(c.control)));
    for (const std::string& word : c.words) EXPECT_TRUE(test::contains(said, word));
  }
  const auto parsed = [](const std::string& control) -> std::string {
    const auto wrong = test::refusals([&] { read(control); });
    return wrong.empty() ? "" : to_string(wrong.front());
  };
  EXPECT_TRUE(test::contains(parsed("kind = \"library\"\n"), "magnetic_control.library"));
  EXPECT_NE(parsed(by_library() + "[rotor.torsion]\n[magnetic_control]\n"), "");
  EXPECT_TRUE(test::contains(parsed("kind = \"library\"\nlibrary = \"a.so\"\nfeedthrough = [1]\n"),
                             "belongs to kind = \"matrices\""));
  EXPECT_TRUE(test::contains(parsed(kMatrices + "[magnetic_control.config]\nx = 1\n"),
                             "belongs to kind = \"library\""));
}

TEST(MagneticLibrary, IsNotOpenedUnaskedNorByWhatShowsAScene) {
  const scene::Scene s = read(by_library());
  set_scene_libraries(SceneLibraries::kAsked);
  EXPECT_TRUE(test::contains(to_string(test::refusal(s)), "--allow-library"));
  scene::Scene in_model = s;
  in_model.folder.reset();
  EXPECT_TRUE(test::contains(to_string(test::refusal(in_model)), "ROTORUB_CONTROLLER_PATH"));
  set_scene_libraries(SceneLibraries::kLeftOut);
  const Model shown = prepare(read(by_library("", "nowhere.so")));
  set_scene_libraries(SceneLibraries::kAllowed);
  const Levitation levitation = rotorub::levitation(shown, 200.0);
  EXPECT_TRUE(levitation.loops.empty());
  EXPECT_TRUE(test::contains(levitation.poles_refused, "magnetic_control.library"));
}

}  // namespace
}  // namespace rotorub
