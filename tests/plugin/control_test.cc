// Control of rings in MuJoCo: built-in laws, the passive bearing, and a user's library.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "native_model/control/library.h"
#include "native_model/model/actuation.h"
#include "native_model/model/dynamics.h"
#include "native_model/numerics/matrix_functions.h"
#include "native_model/prepare/prepare.h"
#include "plugin/make_config.h"
#include "plugin/model/config.h"
#include "plugin/model/control.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"
#include "tests/support/said.h"

namespace rotorub::test {
namespace {

using ControlTest = HookedTest;
using PassiveForces = HookedTest;

Eigen::Vector2d force_on_ring(const mjModel* m, const mjData* d) {
  const int id = mj_name2id(m, mjOBJ_SENSOR, mjcf_names::kControlForce);
  const mjtNum* f = d->sensordata + m->sensor_adr[id];
  return {f[0], f[1]};
}

// MuJoCo's velocities are those of half a step before. The law gets the velocity at the time of the
// positions, extended from the last two.
TEST_F(ControlTest, CommandIsThatOfTheVelocityAtItsTime) {
  const scene::Scene scene =
      shipped("paper_sliding", {"controller.on=0.0", "rotor.modes=2", "mujoco.contact=cone"});
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  // At 1e6 s the round-off of the time is larger than a millionth of the step.
  for (const double begin : {0.0, 1e6}) {
    const DataPointer d = start(m.get());
    d->time = begin;
    d->qpos[0] = 2e-4;
    mj_forward(m.get(), d.get());
    std::vector<double> now(d->qvel, d->qvel + m->nv);
    const double change = 0.02;  // m/s
    d->time += m->opt.timestep;
    d->qvel[0] += change;
    now[0] += 1.5 * change;
    mj_forward(m.get(), d.get());
    const Eigen::Vector2d wanted = control_command(model, d->time, d->qpos, now.data());
    EXPECT_GT((wanted - control_command(model, d->time, d->qpos, d->qvel)).norm(),
              1e-3 * wanted.norm());
    EXPECT_NEAR((force_on_ring(m.get(), d.get()) - wanted).norm(), 0.0, 1e-12 * wanted.norm());
  }
}

TEST_F(ControlTest, NothingBeforeItIsOn) {
  const ModelPointer m = load(mjcf(shipped("paper_sliding")));
  const DataPointer d = start(m.get());
  d->qpos[0] = 2e-4;
  d->ctrl[0] = 5.0;  // the controller's, not the user's
  mj_forward(m.get(), d.get());
  EXPECT_EQ(force_on_ring(m.get(), d.get()).norm(), 0.0);
}

TEST_F(ControlTest, PassiveBearingObeysTheUser) {
  const ModelPointer m = load(mjcf(shipped("paper_passive")));
  ASSERT_EQ(m->nu, 2);
  const DataPointer d = start(m.get());
  d->ctrl[0] = 100.0;
  mj_step(m.get(), d.get());
  const double h = std::sqrt(0.5);
  EXPECT_NEAR((force_on_ring(m.get(), d.get()) - Eigen::Vector2d(100.0 * h, 100.0 * h)).norm(), 0.0,
              1e-12);
}

TEST_F(ControlTest, KeepsToTheForceLimit) {
  const ModelPointer m = load(mjcf(shipped(
      "paper_sliding", {"controller.on=0.0", "actuator.force_limit=10.0", "rotor.modes=2"})));
  const DataPointer d = start(m.get());
  d->qpos[0] = 3e-4;
  mj_forward(m.get(), d.get());
  EXPECT_LE(std::abs(d->actuator_force[0]), 10.0);
  EXPECT_LE(std::abs(d->actuator_force[1]), 10.0);
  EXPECT_GT(force_on_ring(m.get(), d.get()).norm(), 9.9);
}

// ---------------------------------------------------------------- passive
// Position of the disc at the end of the scene, MuJoCo at `step`. Its semi-implicit velocity is
// that of half a step before its position, and so is the one it is started with.
Eigen::Vector2d mujoco_end(const scene::Scene& given, double step) {
  scene::Scene scene = given;
  scene.run.step = step;
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  Eigen::VectorXd a(model.nq());
  smooth_force(model, 0.0, model.q0.data(), model.v0.data(), {0.0, 0.0}, a.data());
  solve_mass(model, 0.0, model.q0.data(), a.data(), a.data());
  for (int i = 0; i < model.nq(); ++i) d->qvel[i] -= 0.5 * step * a[i];
  const auto steps = static_cast<int>(std::lround(scene.run.end / step));
  for (int k = 0; k < steps; ++k) mj_step(m.get(), d.get());
  return rotor_point(model, d->qpos);
}

// The native model's own: its loads are linear in the state at a constant speed, so exp(A t) is
// exact.
Eigen::Vector2d native_end(const scene::Scene& scene) {
  const Model model = prepare(scene);
  const int n = model.nq();
  Eigen::MatrixXd a(2 * n, 2 * n);
  for (int j = 0; j < 2 * n; ++j) {
    Eigen::VectorXd s = Eigen::VectorXd::Unit(2 * n, j), f(n);
    smooth_force(model, 0.0, s.data(), s.data() + n, {0.0, 0.0}, f.data());
    solve_mass(model, 0.0, s.data(), f.data(), f.data());
    a.col(j) << s.tail(n), f;
  }
  Eigen::VectorXd begin(2 * n);
  begin << model.q0, model.v0;
  const Eigen::VectorXd end = matrix_exp(a * scene.run.end) * begin;
  return rotor_point(model, end.data());
}

TEST_F(PassiveForces, FreeWhirlIsTheNativeOne) {
  const scene::Scene scene = parsed(kWhirl);
  const Eigen::Vector2d exact = native_end(scene);
  // MuJoCo's implicit damping is of first order: h (d + d_i)/m t, 1e-7 * 6/2 * 0.02 and what
  // internal damping adds.
  const double coarse = (mujoco_end(scene, 2e-6) - exact).norm() / exact.norm();
  const double fine = (mujoco_end(scene, 2e-7) - exact).norm() / exact.norm();
  EXPECT_LT(fine, 1e-6);
  EXPECT_LT(fine, 0.2 * coarse) << "the error must fall with the step";
}

// The same over a million steps: what swings stays within the same bounds at the end as at the
// begin.
TEST_F(PassiveForces, LongWhirlKeepsItsEnergy) {
  const scene::Scene scene = parsed(kUndampedWhirl);
  const Model model = prepare(scene);
  const ModelPointer m = load(mjcf(scene));
  const DataPointer d = start(m.get());
  constexpr int kBlocks = 100, kBlock = 10000;
  double highest[kBlocks] = {}, mean[kBlocks] = {};
  for (int block = 0; block < kBlocks; ++block) {
    for (int k = 0; k < kBlock; ++k) {
      mj_step(m.get(), d.get());
      const double e = energy(model, 0.0, d->qpos, d->qvel);
      highest[block] = std::max(highest[block], e);
      mean[block] += e / kBlock;
    }
  }
  for (int block = 0; block < kBlocks; ++block) {
    EXPECT_LT(highest[block], highest[0] * 1.01) << block;
    EXPECT_NEAR(mean[block], mean[0], 1e-3 * mean[0]) << block;
  }
}

// ---------------------------------------------------------------- a library
// A user's controller in MuJoCo: the same library and the same commands as natively, with its state
// in mjData.

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
