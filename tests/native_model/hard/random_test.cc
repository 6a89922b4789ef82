// Whatever a user may write: always finite, or a status with its reason; the laws on every row.
#include <gtest/gtest.h>

#include "tests/native_model/hard/random_scenes.h"
#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

// Sliding that pushes itself in needs mu |G_NT| >= G_NN.
bool may_jam(const scene::Scene& s) { return s.first().contact->friction.coefficient > 0.5; }

void expect_event_keeps_every_rule(int count) {
  test::RandomScenes scenes(20);
  int touched = 0;
  for (int k = 0; k < count; ++k) {
    const scene::Scene scene = scenes.next();
    const Trajectory t = test::run_event(scene);
    SCOPED_TRACE("scene " + std::to_string(k));
    if (t.status != Status::kOk) {
      EXPECT_TRUE(may_jam(scene) &&
                  (t.status == Status::kNoSolution || t.status == Status::kAmbiguous))
          << t.message;
      test::expect_refused_or_finite(t);
    } else {
      test::expect_sound_event(scene, t);
    }
    touched += t.statistics.first_touch >= 0.0 ? 1 : 0;
  }
  EXPECT_GT(touched, count / 2) << "the scenes must reach the ring";
}

TEST(HardRandom, EventKeepsEveryRule) { expect_event_keeps_every_rule(50); }

TEST(HardRandomNightly, EventKeepsEveryRule) { expect_event_keeps_every_rule(1000); }

}  // namespace
}  // namespace rotorub
