// A rotor that is deeper in its ring than any start would put it is reported once, and its contact
// is no longer active.
#include <gtest/gtest.h>

#include <string>

#include "mjcf/writer.h"
#include "plugin/contact/contact_status.h"
#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

int escapes = 0;
std::string last_escape;
void count_escape(const char* text) {
  ++escapes;
  last_escape = text;
}

class Escape : public HookedTest {
 protected:
  Escape() {
    mju_user_warning = count_escape;
    escapes = 0;
  }
};

TEST(ContactStatus, TellsOnceAndKnowsStarts) {
  mjtNum status = 0.0;
  plugin::ContactStatus guard(status);
  void (*const before)(const char*) = mju_user_warning;
  mju_user_warning = count_escape;
  escapes = 0;
  guard.watch_escape(-1e-4, 5e-4, 0.0);  // a start in the wall
  EXPECT_FALSE(guard.has(plugin::kIsOutside));
  guard.watch_escape(1e-6, 5e-4, 0.1);
  guard.set_status(Status::kAmbiguous);
  for (int k = 0; k < 3; ++k) {
    guard.watch_escape(-6e-6, 5e-4, 0.2);
    EXPECT_TRUE(guard.has(plugin::kIsOutside));
  }
  EXPECT_EQ(guard.status(), Status::kAmbiguous);
  EXPECT_EQ(escapes, 1);
  guard.watch_escape(-4e-6, 5e-4, 0.3);  // 1 % is a step's matter
  EXPECT_FALSE(guard.has(plugin::kIsOutside));
  guard.begin();
  guard.watch_escape(-1e-3, 5e-4, 0.4);
  EXPECT_FALSE(guard.has(plugin::kIsOutside));
  mju_user_warning = before;
}

TEST(ContactStatus, TellsOnceOfAStartFarOutside) {
  mjtNum status = 0.0;
  plugin::ContactStatus guard(status);
  void (*const before)(const char*) = mju_user_warning;
  mju_user_warning = count_escape;
  escapes = 0;
  guard.watch_escape(-6e-4, 5e-4, 0.0);
  EXPECT_EQ(escapes, 0) << "a step of MuJoCo's compiler";
  guard.watch_escape(-4e-4, 5e-4, 0.05);
  EXPECT_EQ(escapes, 0) << "in the wall";
  for (int k = 0; k < 3; ++k) guard.watch_escape(-6e-4, 5e-4, 0.1);
  EXPECT_EQ(escapes, 1);
  EXPECT_NE(last_escape.find("starts 600 um outside its ring"), std::string::npos) << last_escape;
  EXPECT_FALSE(guard.has(plugin::kIsOutside));
  guard.watch_escape(1e-5, 5e-4, 0.2);
  guard.watch_escape(-6e-4, 5e-4, 0.3);
  EXPECT_EQ(escapes, 2) << "an escape is another fault";
  mju_user_warning = before;
}

// A rotor that is moved during the run in a way that no force does.
TEST_F(Escape, OfAModelOfOnesOwn) {
  const ModelPointer m = load(replaced(document(Machine{}), "<sensor>", R"(<sensor>
    <user name="rotorub_active" objtype="geom" objname="disc" datatype="real" needstage="pos" dim="1"/>)"));
  const DataPointer d = start(m.get());
  for (int k = 0; k < 5; ++k) mj_step(m.get(), d.get());
  EXPECT_EQ(sensor(m.get(), d.get(), "rotorub_active"), 1.0);
  d->qpos[0] = 8e-4;
  mj_forward(m.get(), d.get());
  EXPECT_EQ(sensor(m.get(), d.get(), "rotorub_active"), 0.0);
  EXPECT_EQ(escapes, 1) << last_escape;
  EXPECT_NE(last_escape.find("deep in its ring"), std::string::npos) << last_escape;
}

// No shipped scene is reported, at its own step and at ten times that.
TEST_F(Escape, IsNotReportedInARub) {
  for (const char* name :
       {"bench_ring", "bench_whip", "bench_billiard", "touchdown_ball_bearing", "blade_loss"}) {
    for (const char* step : {"run.step=1e-5", "run.step=1e-4"}) {
      const ModelPointer m = load(mjcf(shipped(name, {step})));
      const DataPointer d = start(m.get());
      for (int k = 0; k < 3000; ++k) mj_step(m.get(), d.get());
      EXPECT_EQ(escapes, 0) << name << " " << step << ": " << last_escape;
      EXPECT_EQ(sensor(m.get(), d.get(), "rotorub_active"), 1.0) << name << " " << step;
      escapes = 0;
    }
  }
}

}  // namespace
}  // namespace rotorub::test
