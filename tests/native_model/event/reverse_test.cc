// Slip that changes its sign without sticking is an event of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/native_model/hard/rules.h"
#include "tests/support/jeffcott.h"

namespace rotorub {
namespace {

// A mass that swings to and fro at the bottom of the ring: where it turns it slips back at once as
// long as its weight along the ring is more than friction holds.
TEST(Reverse, OfAMassThatSwingsOnTheRing) {
  const double mu = 0.1, weight = 20.0, angle = 1.0;
  scene::Scene scene = test::make_scene({.mass = 2.0, .friction = mu});
  const double delta = scene.first().contact->clearance;
  test::add_constant_force(scene, {0.0, -weight});
  scene.initial.x = {delta * std::sin(angle)};
  scene.initial.y = {-delta * std::cos(angle)};
  scene.run.end = 0.5;
  scene.run.output_step = 1e-4;
  const Trajectory t = test::run_event(scene);
  test::expect_sound_event(scene, t);

  const auto& slip = t.column("slip");
  const auto& mode = t.column("mode");
  const auto& time = t.column("t");
  std::vector<double> expected;  // instants, to the spacing of the rows
  for (std::size_t k = 1; k + 1 < t.rows(); ++k) {
    const bool slides = mode[k] == 1.0 && mode[k - 1] == 1.0;
    if (slides && slip[k] * slip[k - 1] < 0.0) expected.push_back(time[k]);
  }
  std::vector<double> found;
  for (const Event& event : t.events) {
    if (event.kind == EventKind::kReverse) found.push_back(event.t);
  }
  ASSERT_GE(expected.size(), 2u);
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t k = 0; k < found.size(); ++k) EXPECT_NEAR(found[k], expected[k], 1e-4);
  EXPECT_EQ(t.events.back().kind, EventKind::kStick) << "it comes to rest within the cone";
}

}  // namespace
}  // namespace rotorub
