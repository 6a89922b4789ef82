// Whatever a user may write: always finite, or a status with its reason; the laws on every row.
#include <gtest/gtest.h>

#include "tests/native_model/hard/random_scenes.h"
#include "tests/native_model/hard/rules.h"

namespace rotorub {
namespace {

constexpr int kScenes = 200;

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

TEST(HardRandom, VerletKeepsEveryRule) {
  test::RandomScenes scenes(21);
  int solved = 0;
  for (int k = 0; k < kScenes; ++k) {
    const scene::Scene scene = scenes.next();
    const Trajectory t = test::run_verlet(scene, 1e-5);
    SCOPED_TRACE("scene " + std::to_string(k));
    if (t.status != Status::kOk) {
      // A flight of more than the clearance in a step may end outside, with a word.
      EXPECT_TRUE(
          t.status == Status::kOutOfRange ||
          (may_jam(scene) && (t.status == Status::kNoSolution || t.status == Status::kAmbiguous)))
          << t.message;
      test::expect_refused_or_finite(t);
      continue;
    }
    const double speed =
        2.0 *
        std::max({1.0, test::largest(t.column("rotor_vx")), test::largest(t.column("rotor_vy")),
                  test::largest(t.column("stator_vx")), test::largest(t.column("stator_vy"))});
    test::expect_sound_verlet(scene, t, 1e-5, speed);
    ++solved;
  }
  EXPECT_GT(solved, kScenes * 9 / 10);
}

}  // namespace
}  // namespace rotorub
