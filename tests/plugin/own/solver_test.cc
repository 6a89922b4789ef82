// MuJoCo's solver stopped before its end in a step with a contact of ours.
#include <gtest/gtest.h>

#include <string>

#include "tests/plugin/own/machine.h"
#include "tests/support/mujoco_fixture.h"

namespace rotorub::test {
namespace {

int solver_warnings = 0;
std::string last_solver_warning;
void count_solver_warning(const char* text) {
  ++solver_warnings;
  last_solver_warning = text;
}

class SolverLimit : public HookedTest {
 protected:
  SolverLimit() {
    mju_user_warning = count_solver_warning;
    solver_warnings = 0;
  }
  // Pressed into its ring, the ring held by friction loss: PGS takes the two rows in turns.
  static int warnings(const std::string& option) {
    Machine x;
    x.contact = "cone";
    x.friction = 0.3;
    x.option = "cone=\"elliptic\" " + option;
    x.ring_joint = "frictionloss=\"1000\" solimpfriction=\"0.9999 0.9999 0.001\"";
    const ModelPointer m = load(
        replaced(replaced(document(x), "condim=\"1\"", "condim=\"3\" friction=\"0.3 0.3 0 0 0\""),
                 "margin=\"5e-7\"", ""));
    const DataPointer d = start(m.get());
    d->qpos[0] = 5e-4;
    d->qvel[2] = 50.0;
    solver_warnings = 0;
    for (int k = 0; k < 100; ++k) {
      d->qfrc_applied[0] = 100.0;
      mj_step(m.get(), d.get());
    }
    return solver_warnings;
  }
};

TEST_F(SolverLimit, IsSaidOnce) {
  EXPECT_EQ(warnings("solver=\"PGS\" iterations=\"3\""), 1);
  EXPECT_NE(last_solver_warning.find("solver stopped at iterations=\"3\""), std::string::npos)
      << last_solver_warning;
  EXPECT_EQ(warnings("solver=\"Newton\" iterations=\"100\""), 0) << last_solver_warning;
}

}  // namespace
}  // namespace rotorub::test
