// A user's controller in MuJoCo: the same library and the same commands as natively, with its state
// in mjData.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "mjcf/writer.h"
#include "native_model/control/library.h"
#include "native_model/prepare/prepare.h"
#include "plugin/make_config.h"
#include "plugin/model/config.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

const std::string kLibraries = ROTORUB_LIBRARIES;

class LibraryControllerTest : public HookedTest {
 protected:
  LibraryControllerTest() { setenv("ROTORUB_CONTROLLER_PATH", kLibraries.c_str(), 1); }
  ~LibraryControllerTest() override { unsetenv("ROTORUB_CONTROLLER_PATH"); }

  static scene::Scene scene(const std::string& library, std::vector<std::string> more = {}) {
    std::vector<std::string> overrides{"rotor.modes=2",
                                       "run.end=0.02",
                                       "run.step=1e-5",
                                       "controller.kind=library",
                                       "controller.library=" + library,
                                       "controller.on=0",
                                       "controller.sample_time=1e-4",
                                       "force[0].on=0",
                                       "initial.steady=false",
                                       "actuator.force_limit=none"};
    overrides.insert(overrides.end(), more.begin(), more.end());
    scene::Scene s = shipped("paper_sliding", overrides);
    s.folder.reset();  // as in a model
    return s;
  }
};

// The values that the recording library stores
// (tests/native_model/control/libraries/recording_controller.c).
constexpr std::size_t kShown = 5, kTold = kShown + 13, kRecordingState = kTold + 2;

Measurement shown_of(const double* state) {
  const double* s = state + kShown;
  Measurement m;
  m.t = s[0];
  m.rotor = {s[1], s[2]};
  m.rotor_velocity = {s[3], s[4]};
  m.stator = {s[5], s[6]};
  m.stator_velocity = {s[7], s[8]};
  m.spin_angle = s[9];
  m.spin_speed = s[10];
  m.current = {s[11], s[12]};
  return m;
}

// With noise, delay and rounding the measurements of MuJoCo's law, sample by sample, give a native
// law the same commands and the same state, to the bit.
TEST_F(LibraryControllerTest, TheSameMeasurementsGiveTheSameCommandsToTheBit) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const scene::Scene s =
        scene("recording_controller.so",
              {std::string("mujoco.contact=") + contact,
               "controller.sensors={delay=2e-4, position_noise=1e-6, velocity_noise=1e-3, "
               "position_resolution=1e-7}"});
    const Model model = prepare(s);
    const ModelPointer m = load(mjcf(s));
    const DataPointer d = start(m.get());
    const plugin::Config config = plugin::make_config(m.get());
    ASSERT_EQ(model.first().controller->state_size(), kRecordingState);
    // The law's state is the end of the loop's memory.
    std::vector<double> native(kRecordingState, 0.0);
    double counted = 0.0;
    int samples = 0;
    for (int k = 0; k < 1500; ++k) {
      mj_step(m.get(), d.get());
      const mjtNum* state =
          d->userdata + config.loop_data + model.first().loop->memory_size() - kRecordingState;
      if (state[0] == counted) continue;
      counted = state[0];
      ++samples;
      const Eigen::Vector2d told =
          model.first().controller->command(shown_of(state), {}, native.data());
      ASSERT_EQ(told.x(), state[kTold]) << contact << " " << k;
      ASSERT_EQ(told.y(), state[kTold + 1]) << contact << " " << k;
      for (std::size_t i = 0; i < kRecordingState; ++i)
        ASSERT_EQ(native[i], state[i]) << contact << " " << i;
    }
    EXPECT_EQ(samples, 150) << contact;
  }
}

// This fixture throws mju_error.
TEST_F(LibraryControllerTest, AFailureIsAnErrorWithNameAndTime) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const scene::Scene s =
        scene("faulty_controller.so", {"controller.config={fault=\"throw\", at=0.004}",
                                       std::string("mujoco.contact=") + contact});
    const ModelPointer m = load(mjcf(s));
    const DataPointer d = start(m.get());
    const std::string said = message_of([&] {
      for (int k = 0; k < 1000; ++k) mj_step(m.get(), d.get());
    });
    EXPECT_TRUE(contains(said, {"faulty", "0.004", "thrown in step"})) << contact;
    EXPECT_NEAR(d->time, 0.004, 2e-5);
  }
}

TEST_F(LibraryControllerTest, AModelDoesNotLoadCodeByItself) {
  const ModelPointer m = load(mjcf(scene("recording_controller.so")));
  unsetenv("ROTORUB_CONTROLLER_PATH");
  EXPECT_TRUE(contains(message_of<plugin::ConfigError>([&] { plugin::make_config(m.get()); }),
                       "ROTORUB_CONTROLLER_PATH"));
}

// An MJCF of magnetic bearings under a library, written with it and without opening it: the second
// has room for more states, and moves as the first.
TEST_F(LibraryControllerTest, AModelThatIsWrittenUnopenedRunsWithTheLibrary) {
  scene::Scene s =
      shipped("relevitation",
              {"run.end=0.02", "run.step=1e-5", "mujoco.rotor=modal", "contact=none",
               "magnetic_bearing[0].control={kind='shared',proportional=22e3}",
               "magnetic_bearing[1].control={kind='shared',proportional=22e3}",
               "magnetic_control={kind='library',library='magnetic_controller.so',sample_time=1e-4,"
               "config={a='0.5',b='1 0 0 0',c='1e4 0 0 0',"
               "d='2.2e4 0 0 0 0 2.2e4 0 0 0 0 2.2e4 0 0 0 0 2.2e4'}}"});
  s.folder.reset();
  const auto end_of = [](const std::string& model, int* states) {
    const ModelPointer m = load(model);
    const DataPointer d = start(m.get());
    const plugin::Config config = plugin::make_config(m.get());
    for (int k = 0; k < 500; ++k) mj_step(m.get(), d.get());
    *states = m->nv;
    std::vector<double> q;
    for (int i = 0; i < config.model.layout.coil(); ++i)
      q.push_back(d->qpos[config.qpos_address[static_cast<std::size_t>(i)]]);
    return q;
  };
  int opened = 0, unopened = 0;
  const std::vector<double> q = end_of(mjcf(s), &opened);
  set_scene_libraries(SceneLibraries::kLeftOut);
  const std::string blind = mjcf(s);
  set_scene_libraries(SceneLibraries::kAsked);
  const std::vector<double> other = end_of(blind, &unopened);
  EXPECT_EQ(unopened - opened, 64 - 2) << "of the states, in pairs";
  ASSERT_EQ(q.size(), other.size());
  double most = 0.0, apart = 0.0;
  for (std::size_t i = 0; i < q.size(); ++i) {
    most = std::max(most, std::abs(q[i]));
    apart = std::max(apart, std::abs(q[i] - other[i]));
  }
  EXPECT_GT(most, 1e-6);
  EXPECT_LT(apart, 1e-12 * most);
}

}  // namespace
}  // namespace rotorub::test
