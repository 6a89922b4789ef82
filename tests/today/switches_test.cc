// Differences of a step in recent versions of MuJoCo: mjcb_control left out, its own threads,
// sleep, islands, the exact diagonal; and the plugin in a program that loads it as Python does.
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <cmath>
#include <cstdlib>

#include "mjcf/names.h"
#include "mjcf/writer.h"
#include "plugin/hooks.h"
#include "plugin/model/mujoco_versions.h"
#include "tests/plugin/scenes.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

namespace names = mjcf_names;

std::string bench(const std::string& contact, const std::string& name = "bench_ring") {
  return mjcf(shipped(name, {"mujoco.contact=" + contact}));
}

constexpr int kSteps = 4000;  // of bench_ring: in lasting contact

class Switches : public MujocoTest {
 protected:
  plugin::Hooks hooks_;
};

// mj_forward then does not call mjcb_control; this model has no actuator, so nothing may change.
TEST_F(Switches, DisabledActuationChangesNothing) {
  for (const char* contact : {"rigid", "coulomb", "cone", "cone-coulomb"}) {
    const ModelPointer m = load(bench(contact));
    const std::vector<double> wanted = state_after(m.get(), kSteps);
    m->opt.disableflags |= mjDSBL_ACTUATION;
    const std::vector<double> found = state_after(m.get(), kSteps);
    for (std::size_t i = 0; i < found.size(); ++i) {
      // The reference of a soft contact is passed on in another variable.
      const double bound =
          std::string(contact) == "rigid" ? 0.0 : 1e-9 * (1.0 + std::abs(wanted[i]));
      EXPECT_NEAR(found[i], wanted[i], bound) << contact << " " << i;
    }
    const DataPointer d = start(m.get());
    for (int k = 0; k < kSteps; ++k) mj_step(m.get(), d.get());
    EXPECT_EQ(sensor(m.get(), d.get(), names::kActive), 1.0) << contact;
  }
}

// `cone` of a speed that is held puts the slip into the reference of a friction row.
TEST_F(Switches, DisabledActuationKeepsTheSlipOfAHeldSpeed) {
  const ModelPointer m = load(mjcf(shipped("bench_ring", {"drive=none", "mujoco.contact=cone"})));
  const std::vector<double> wanted = state_after(m.get(), 1000);
  m->opt.disableflags |= mjDSBL_ACTUATION;
  const std::vector<double> found = state_after(m.get(), 1000);
  for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-8) << i;
}

TEST_F(Switches, AnOwnModelRunsWithoutActuation) {
  for (const char* contact : {"rigid", "coulomb"}) {
    std::string document = own_model_example();
    if (std::string(contact) == "coulomb") {
      document.replace(document.find("data=\"rigid\""), 12, "data=\"coulomb\"");
      document.replace(document.find("margin=\"5e-6\" gap=\"1\""), 21,
                       "margin=\"5e-7\" gap=\"0\" solref=\"-4e8 -10211.0255\"");
    }
    const ModelPointer m = load(document);
    m->opt.disableflags |= mjDSBL_ACTUATION;
    const DataPointer d = start(m.get());
    d->qvel[0] = 1.0;
    double depth = 0.0;
    for (int k = 0; k < 5000; ++k) {
      mj_step(m.get(), d.get());
      depth = std::max(depth, -sensor(m.get(), d.get(), names::kGap));
    }
    EXPECT_LT(depth, 5e-5) << contact;
  }
}

TEST_F(Switches, NothingLeftToCallIsRefused) {
  const ModelPointer m = load(bench("rigid"));
  m->opt.disableflags |= mjDSBL_ACTUATION | mjDSBL_SPRING | mjDSBL_DAMPER;
  const DataPointer d = start(m.get());
  EXPECT_THROW(mj_step(m.get(), d.get()), std::runtime_error);
}

// M + h D of the step is M then: the native step, put into it, is the same but for round-off.
TEST_F(Switches, ExplicitDampersGiveTheSameMotion) {
  const ModelPointer m = load(bench("rigid"));
  const std::vector<double> wanted = state_after(m.get(), kSteps);
  m->opt.disableflags |= mjDSBL_EULERDAMP;
  const std::vector<double> found = state_after(m.get(), kSteps);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], wanted[i], 1e-10 * (1.0 + std::abs(wanted[i]))) << i;
  }
}

TEST_F(Switches, SleepIsRefusedWhereItWouldTakeTheRotor) {
  const ModelPointer m = load(bench("rigid"));
  const std::vector<double> wanted = state_after(m.get(), 1000);
  m->opt.enableflags |= mjENBL_SLEEP;
  const DataPointer d = start(m.get());
  EXPECT_THROW(mj_step(m.get(), d.get()), std::runtime_error);
  for (int i = 0; i < m->ntree; ++i) m->tree_sleep_policy[i] = mjSLEEP_NEVER;
  EXPECT_EQ(state_after(m.get(), 1000), wanted);
}

// Islands, MuJoCo's own threads and the exact diagonal: the answer is the same, to the bit with
// `rigid`.
TEST_F(Switches, IslandsThreadsAndDiagonal) {
  for (const char* contact : {"rigid", "coulomb"}) {
    const ModelPointer m = load(bench(contact));
    const auto run = [&m](int threads) {
      const DataPointer d = start(m.get());
      if (threads > 0) mju_threadpool(d.get(), threads);
      for (int k = 0; k < kSteps; ++k) mj_step(m.get(), d.get());
      return state_of(m.get(), d.get());
    };
    const std::vector<double> wanted = run(0);
    EXPECT_EQ(run(3), wanted) << contact;
    const auto near = [&](const std::vector<double>& found, const char* what) {
      for (std::size_t i = 0; i < found.size(); ++i) {
        const double bound =
            std::string(contact) == "rigid" ? 0.0 : 1e-7 * (1.0 + std::abs(wanted[i]));
        EXPECT_NEAR(found[i], wanted[i], bound) << contact << " " << what << " " << i;
      }
    };
    m->opt.disableflags |= mjDSBL_ISLAND;
    near(run(0), "no islands");
    m->opt.disableflags &= ~mjDSBL_ISLAND;
    m->opt.enableflags |= mjENBL_DIAGEXACT;
    near(run(0), "exact diagonal");
  }
}

// 0: the contact is there, also after mj_resetCallbacks (mujoco.set_mjcb_control(None) and the
// like).
int run_as_python() {
  const char* file = ROTORUB_PLUGIN;
  mj_loadPluginLibrary(file);
  char error[1000] = "";
  mjModel* m =
      mj_loadXML(ROTORUB_SOURCE_DIR "/mjcf/examples/own_model.xml", nullptr, error, sizeof error);
  if (!m) return 2;
  mjData* d = mj_makeData(m);
  d->qvel[0] = 1.0;
  double force = 0.0, depth = 0.0;
  const auto step = [&](int steps) {
    for (int k = 0; k < steps; ++k) {
      mj_step(m, d);
      force = std::max(force, sensor(m, d, names::kNormalForce));
      depth = std::max(depth, -sensor(m, d, names::kGap));
    }
    return sensor(m, d, names::kActive) == 1.0;
  };
  if (!step(2000)) return 3;
  mj_resetCallbacks();
  if (!step(2000)) return 4;
  // A linked plugin beside it leaves the work to it.
  const plugin::Hooks hooks;
  if (!step(2000)) return 5;
  return force > 10.0 && depth < 5e-6 ? 0 : 6;
}

// Python's mujoco calls mj_loadPluginLibrary, and then steps through the C interface.
TEST(Python, LoadsTheLibraryAndHasTheContact) {
  EXPECT_EXIT(std::_Exit(run_as_python()), ::testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace rotorub::test
