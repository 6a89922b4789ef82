// LQR and LQG of a ring about a rotor in magnetic bearings in MuJoCo, where filters, amplifiers and
// sampled controls are joints: the native run, to the order of its step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "compare/engine/engine.h"
#include "tests/support/hung_rotors.h"
#include "tests/support/native_run.h"
#include "tests/support/order.h"

namespace rotorub::test {
namespace {

TEST(QuadraticEngine, MuJoCoComesToTheNativeRun) {
  for (const Hanging& hanging : hung_rotors()) {
    for (const char* kind : {"lqr", "lqg"}) {
      SCOPED_TRACE(hanging.name + ", " + kind);
      scene::Scene s = levitated(hanging, kind);
      const Trajectory exact = run_event(s);
      ASSERT_EQ(exact.status, Status::kOk) << exact.message;
      const Convergence c = convergence({1e-5, 5e-6, 2.5e-6}, [&](double step) {
        s.run.step = step;
        const Trajectory t = mujoco_engine(scene::ContactModel::kCoulomb)->run(s, {});
        EXPECT_EQ(t.status, Status::kOk) << t.message;
        EXPECT_EQ(t.rows(), exact.rows());
        double most = 0.0;
        for (std::size_t k = 0; k < std::min(t.rows(), exact.rows()); ++k)
          most = std::max(most, std::abs(t.column("stator_x")[k] - exact.column("stator_x")[k]));
        return most;
      });
      EXPECT_NEAR(c.order(), 1.0, 0.1) << c.text();
      EXPECT_LT(c.errors.back(), 2e-7) << c.text() << ": of 0.1 mm";
    }
  }
}

}  // namespace
}  // namespace rotorub::test
